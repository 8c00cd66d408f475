// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_REQUEST_H
#define RICCI_CONE_REQUEST_H

#include "../options.h"

namespace ricci {

/// The largest curvature of a placed cone, 3 pi / 2 in radians: its angle is at least a right one.
constexpr double kMaxConeCurvature = 4.71238898038468985769;

/// What cones are to lower: the symmetric Dirichlet energy of the map, by area and at its best scale, and
/// the price of its seams. A conformal map with area factors exp(2 u) has the energy
/// 4 sqrt(mean exp(2 u) mean exp(-2 u)), which is 4 and kEnergyPrice times the mean square of u where that
/// is small. A seam as long as the square root of the area costs kSeamPrice.
constexpr double kEnergyPrice = 8.0, kSeamPrice = 0.05;

/// What one more cone must save beyond the price of its seam: charts with more cones overlap themselves
/// more often, and are divided there by seams that no tree of cones foretells.
constexpr double kConePrice = 0.001;

/// The energy to be expected where the standard deviation of 2 u is \p spread.
inline double expectedEnergy(double spread)
{
	return 4.0 + 0.25 * kEnergyPrice * spread * spread;
}

/// By this factor the distortion of a given number of cones may grow for shorter seams.
constexpr double kSeamAllowance = 1.05;

/// Where the distortion decides how many cones are placed, there are at most this many, or as many as
/// lower energy and price of seams, if those are more, up to the second number and while there are no
/// more than so many numbers to keep, one for each cone and vertex.
constexpr int kMaxPlacedCones = 64, kMaxNeededCones = 512, kMaxConeNumbers = 64000000;

/// Cones that moreCones() adds at a time.
constexpr int kMaxMoreCones = 64;

/// What the boundary does while cones are placed. A closed surface has none.
enum class ConeBoundary {
	Fixed,     ///< u = 0 on the boundary
	Prescribed ///< the boundary takes what Gauss-Bonnet leaves, in proportion to its length
};

/// Which cones placeCones() looks for, and where.
struct ConeRequest : ConeOptions
{
	ConeBoundary boundary = ConeBoundary::Fixed;
	int vertices = -1; ///< cones lie at vertices with a number below this; -1: at any

	/// Move cones towards the tree of their seams where that lowers energy and price of seams together:
	/// up to the wanted distortion, or by kSeamAllowance for a given count.
	bool shortSeams = true;
};

} // namespace ricci

#endif
