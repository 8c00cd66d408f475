// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HOLE_CAPS_H
#define RICCI_HOLE_CAPS_H

#include "triangulation.h"

#include <vector>

namespace ricci {

/// A surface whose boundary loops but the longest are closed by caps. Vertices, edges, halfedges
/// and faces of the surface keep their numbers; those of the caps follow.
struct CappedSurface
{
	Triangulation triangulation;
	std::vector<Point3> positions;
	std::vector<char> onHole; ///< [vertex of the surface] 1 on a loop that is closed
	int holes = 0;
};

/// Closes every boundary loop but the longest by a fan round its centre of mass. Positions serve to
/// give the fan's edges a length alone, and its triangles may be thin: the flow starts from the
/// intrinsic Delaunay triangulation and makes the fan flat, inside and together with the faces at
/// its rim. A finer filling, by rings of ever fewer vertices, changes the distortion of the surface
/// in the fourth digit only. A plane hole that is star-shaped from its centre is filled by the plane.
CappedSurface capInnerLoops(const Triangulation& t, const std::vector<Point3>& positions);

} // namespace ricci

#endif
