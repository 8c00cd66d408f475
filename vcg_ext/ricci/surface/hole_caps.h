// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HOLE_CAPS_H
#define RICCI_HOLE_CAPS_H

#include "triangulation.h"

#include <vector>

namespace ricci {

/// The triangles of a surface whose holes are closed by caps.
struct CappedSurface
{
	std::vector<Triangle> triangles; ///< those of the surface in order, then those of the caps
	VertexArray<Point3> positions;   ///< of the surface's vertices, then the centres of the caps
	VertexArray<char> onHole;        ///< [vertex of the surface] 1 on a loop that is closed
	int holes = 0;                   ///< loops that are closed
};

/// Closes every hole by a fan round its centre of mass. Holes are the boundary loops all of whose
/// edges are marked in \p isHole, or where that is empty, all but the longest. A Triangulation of the
/// result keeps the numbers of the surface's vertices, edges, halfedges and faces.
///
/// Positions serve only to give the edges of the fan a length, and its triangles may be thin: the
/// flow starts from the intrinsic Delaunay triangulation and makes the fan flat, inside and
/// together with the faces at its rim. A finer filling, by rings of ever fewer vertices, changes
/// the distortion of the surface in the fourth digit only. A plane hole that is star-shaped from
/// its centre is filled by the plane.
CappedSurface capHoles(
	const Triangulation& t,
	const VertexArray<Point3>& positions,
	const EdgeArray<char>& isHole = {});

} // namespace ricci

#endif
