// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_REQUEST_H
#define RICCI_CONE_REQUEST_H

#include "../options.h"

namespace ricci {

/// The largest curvature of a placed cone, 3 pi / 2 in radians: its angle is at least a right one.
constexpr double kMaxConeCurvature = 4.71238898038468985769;

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
	bool hasAlternative =
		false; ///< to the map with cones: then there are no more than kMaxPlacedCones

	/// Move cones towards the tree of their seams where that lowers energy and price of seams together:
	/// up to the wanted distortion, or by kSeamAllowance for a given count.
	bool shortSeams = true;
};

} // namespace ricci

#endif
