// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DISK_CHECK_H
#define RICCI_DISK_CHECK_H

#include "../layout/flat_mesh.h"

#include <cstddef>

namespace ricci {

/// Errors of a chart in the Poincaré disk, found from its triangles alone.
/// Lengths are hyperbolic. The check allows for the rounding of the points to doubles, which near
/// the circle is a large distance.
struct DiskCheck
{
	std::size_t outside = 0; ///< corners that are not in the open unit disk; NaN counts

	/// Largest difference of the lengths of the two sides of a seam, or of any edge that two
	/// triangles share.
	double seamGap = 0.0;

	/// Geodesic triangles of the wrong orientation, by the sign of det(X, Y, Z) on the hyperboloid,
	/// that are higher than the tolerance: sinh(height) sinh(side) = |det|.
	int flipped = 0;

	double radius = 0.0; ///< largest distance of a point from 0
};

/// \param tolerance hyperbolic distance
/// \return outside alone, if that is not 0
DiskCheck checkDisk(const FlatMesh& chart, double tolerance);

} // namespace ricci

#endif
