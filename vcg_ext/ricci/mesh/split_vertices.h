// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SPLIT_VERTICES_H
#define RICCI_SPLIT_VERTICES_H

#include "surface_mesh.h"

#include <array>
#include <vector>

namespace ricci {

/// Vertices that are one vertex of the surface.
struct SplitVertices
{
	std::vector<int> vertex; ///< [vertex] the lowest of those that are one with it
	std::vector<std::array<Corner, 2>> joined; ///< sides that are one edge
};

/// Finds edges of a surface whose two faces have vertices of their own there.
///
/// Two sides of faces that no other face shares by index are one edge if their ends are bit-equal. Where just two
/// lie there they are joined; where more do, each is joined to the one that is met first when one turns round the
/// edge through the inner side of its face, if that one runs the other way. Faces that lie on one another (kSameAngle)
/// are never joined, and vertices become one only through joined edges.
///
/// So solids that touch stay apart, in a soup of faces too, and so do the two sides of a leaf.
/// \param alone sides that no other face shares by index, see FaceGluing
/// \pre no triangle uses a vertex twice; positions are finite
SplitVertices findSplitVertices(
	const Array<Point3>& positions,
	const Array<Triangle>& triangles,
	const std::vector<Corner>& alone);

} // namespace ricci

#endif
