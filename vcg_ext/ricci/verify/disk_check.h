// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DISK_CHECK_H
#define RICCI_DISK_CHECK_H

#include "map_check.h"

#include <cstddef>

namespace ricci {

/// What a chart in the Poincaré disk is worth, seen from its triangles alone, in extended precision.
/// Lengths are hyperbolic. The rounding of the points to doubles is allowed for: near the circle it
/// is a large distance.
struct DiskCheck
{
	std::size_t outside = 0; ///< points that are not in the closed unit disk; NaN counts

	/// Largest difference of the lengths of the two sides of a seam, or of any edge that two
	/// triangles share.
	double seamGap = 0.0;

	/// Geodesic triangles of the wrong orientation, by the sign of det(X, Y, Z) on the hyperboloid,
	/// that are higher than the tolerance: sinh(height) sinh(side) = |det|.
	int turned = 0;

	double radius = 0.0; ///< largest distance of a point from 0
};

/// The parameters are those of checkMap(), \p tolerance is a distance.
DiskCheck checkDisk(
	const std::vector<Triangle>& triangles,
	const std::vector<std::array<Point2, 3>>& plane,
	const std::vector<char>& reversed,
	double tolerance);

} // namespace ricci

#endif
