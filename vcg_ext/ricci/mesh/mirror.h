// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MIRROR_H
#define RICCI_MIRROR_H

#include "flow_domain.h"

#include <memory>

namespace ricci {

/// A reflection of space that takes nearly all vertices of a surface to vertices, and whose plane divides the surface
/// along edges into two connected halves.
struct MirrorSymmetry
{
	VertexArray<Vertex> image; ///< in the plane the vertex itself; none where there is none
	EdgeArray<Edge>
		edgeImage; ///< in the plane the edge itself; none for diagonals that are not mirrored
	VertexArray<char> isAbove; ///< 1 on one side of the plane

	/// The half of a face: no face has vertices on both sides.
	bool isAboveFace(const Triangulation& t, Face f) const
	{
		const auto [a, b, c] = t.vertices(f);
		return isAbove[a] || isAbove[b] || isAbove[c];
	}
};

/// Finds one of a surface in space: across the planes normal to the axes of the coordinates, x first, through 0, the
/// middle of the extent and the centroid of the vertices; and across those normal to the vertices' principal axes.
/// \return null if there is none
std::shared_ptr<const MirrorSymmetry> findMirror(const EmbeddedSurface& surface);

} // namespace ricci

#endif
