// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SOUNDNESS_H
#define RICCI_SOUNDNESS_H

#include "../base/floating_point.h"
#include "../math/orientation.h"
#include "../math/points.h"

#include <algorithm>

namespace ricci {

/// What a triangle must be in the plane.
struct Soundness
{
	double height = 0.0;   ///< its least height is above this
	double wanted = 0.0;   ///< and should be this at least where it is mended
	bool asFloats = false; ///< with its coordinates rounded to float

	/// The point as it is stored.
	Point2 stored(const Point2& p) const
	{
		return asFloats ? Point2{roundedToFloat(p[0]), roundedToFloat(p[1])} : p;
	}

	/// Whether it is counter-clockwise, exactly.
	bool isUpright(const Triangle2& p) const
	{
		return orientation(stored(p[0]), stored(p[1]), stored(p[2])) > 0;
	}

	/// Whether it is counter-clockwise, exactly, and high enough.
	bool isSound(const Triangle2& p) const
	{
		const Point2 a = stored(p[0]), b = stored(p[1]), c = stored(p[2]);
		const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
		return orientation(a, b, c) > 0 && doubledArea(a, b, c) > height * longest;
	}
};

} // namespace ricci

#endif
