// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CANONICAL_POLYGON_H
#define RICCI_CANONICAL_POLYGON_H

#include "fuchsian_group.h"

#include <complex>
#include <vector>

namespace ricci {

/// A fundamental polygon with geodesic sides whose corners are all one point of the surface. Side k
/// runs from corner k to corner k + 1 and is a copy of the closed way of letter k of the canonical
/// relation a1 b1 a1^-1 b1^-1 ... e1 ... en: a surface of genus g without ends has 4 g sides, paired
/// like the letters, and the sides of the ends e_i have no partner.
struct CanonicalPolygon
{
	std::vector<std::complex<double>>
		corners;           ///< in the Poincaré disk, in the order of the relation
	double angleSum = 0.0; ///< radians; 2 pi for a fundamental polygon of a surface without ends
	bool isSimple = false; ///< no side crosses another
	double gap = 0.0;      ///< hyperbolic distance by which the last side misses the first corner
};

/// Above this distance the sides do not close up to a polygon.
inline constexpr double kMostGap = 1e-2;

/// Computes the polygon whose base point makes the sum of cosh d(p, g p) over the canonical
/// generators g least: that is a quadratic form on the hyperboloid, and the point its timelike
/// eigenvector. The polygon is the copy that has the base point, of those in the disk, for its middle
/// corner, so that no corner is a product of more than half of the letters.
///
/// Where generators move points so far that rounding leaves a gap above kMostGap, or takes corners
/// out of the disk, the polygon has no corners.
CanonicalPolygon canonicalPolygon(const FuchsianGroup& group);

} // namespace ricci

#endif
