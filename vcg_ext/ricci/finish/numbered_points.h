// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_NUMBERED_POINTS_H
#define RICCI_NUMBERED_POINTS_H

#include "point_groups.h"

namespace ricci {

/// The points of a flat mesh in the order in which an optimisation takes them: the unknowns, which are
/// the first points of the groups that move, then their images, then the points that stay.
///
/// The unknowns follow a walk over the surface, breadth first from its point farthest from the middle
/// of the mesh, and at every vertex to the farthest neighbours first: what takes them one after another
/// does not depend on the numbers of the mesh, and finds neighbours near in memory.
struct NumberedPoints
{
	Array<int> number; ///< [point of the mesh]
	int unknowns = 0;
	int moving = 0; ///< unknowns and images

	// By number.
	Array<int> unknown;               ///< that moves the point, or -1
	Array<std::complex<double>> turn; ///< the derivative of the point by its unknown

	/// If no group is fixed, two points far from each other stay, which takes away the similarities of
	/// the plane.
	NumberedPoints(const FlatMesh& flat, const PointGroups& groups);
};

} // namespace ricci

#endif
