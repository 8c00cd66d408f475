// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FACE_GLUING_H
#define RICCI_FACE_GLUING_H

#include "surface_mesh.h"

namespace ricci {

/// Which sides of triangles are glued to each other.
struct FaceGluing
{
	CornerArray<Corner> glued; ///< [side] the side that is glued to it; none on a boundary
	int cutEdges = 0;          ///< edges with more than two sides, or with two of equal vertices
	int duplicateFaces = 0;    ///< triangles with the vertices of one before them
};

/// Glues triangles to surfaces in which no edge has more than two sides.
///
/// The two sides of an ordinary edge are glued, whatever their directions. Where more meet, they are
/// paired along the smoothest continuation, where their orientation is coherent and no surface becomes
/// one-sided by it; what is left over becomes boundary. Triangles with the same
/// three vertices are never glued to each other: they belong to different sheets, in the order of
/// their numbers.
/// \pre no triangle uses a vertex twice
FaceGluing glueFaces(const Array<Point3>& positions, const Array<Triangle>& triangles);

} // namespace ricci

#endif
