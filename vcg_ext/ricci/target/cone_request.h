// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_REQUEST_H
#define RICCI_CONE_REQUEST_H

#include "../options.h"

namespace ricci {

/// The largest curvature of a placed cone, 3 pi / 2 in radians: its angle is at least a right one.
constexpr double kMaxConeCurvature = 4.71238898038468985769;

/// By this factor the distortion of a given number of cones may grow for shorter seams.
constexpr double kSeamAllowance = 1.05;

/// Where the distortion decides how many cones are placed, there are at most this many.
constexpr int kMaxPlacedCones = 64;

/// What the boundary does while cones are placed. A closed surface has none.
enum class ConeBoundary {
	Fixed,     ///< u = 0 on the boundary
	Prescribed ///< the boundary takes what Gauss-Bonnet leaves, in proportion to its length
};

/// Which cones placeCones() looks for.
struct ConeRequest
{
	int count = 0;           ///< of cones; 0: the fewest found that reach the distortion
	double distortion = 0.5; ///< wanted if count is 0; see PlacedCones::distortion
	ConeRounding rounding = ConeRounding::Free;
	ConeBoundary boundary = ConeBoundary::Fixed;
	int vertices = -1; ///< cones lie at vertices with a number below this; -1: at any
	/// On a sphere, move cones towards each other where that shortens the tree that joins them more
	/// than it raises the distortion: up to the wanted distortion, or by kSeamAllowance for a given
	/// count.
	bool shortSeams = true;
};

} // namespace ricci

#endif
