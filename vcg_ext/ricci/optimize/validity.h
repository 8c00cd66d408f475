// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_VALIDITY_H
#define RICCI_VALIDITY_H

#include "../base/floating_point.h"
#include "../base/orientation.h"
#include "../base/points.h"

#include <algorithm>
#include <cmath>

namespace ricci {

/// What a triangle must be in the plane.
struct Validity
{
	double height = 0.0;   ///< its least height is above this
	double wanted = 0.0;   ///< and should be this at least where it is mended
	bool asFloats = false; ///< with its coordinates rounded to float
	double step = 0.0;     ///< and these to multiples of it, if it is not 0

	/// The point as it is stored.
	Point2 stored(const Point2& p) const
	{
		const Point2 rounded = inSteps(p);
		return step > 0.0 ? Point2{rounded[0] * step, rounded[1] * step} : rounded;
	}

	/// Whether it is counter-clockwise, exactly.
	bool isUpright(const Triangle2& p) const
	{
		return orientation(inSteps(p[0]), inSteps(p[1]), inSteps(p[2])) > 0;
	}

	/// Whether it is counter-clockwise, exactly, and high enough.
	bool isValid(const Triangle2& p) const
	{
		const Point2 a = inMemory(p[0]), b = inMemory(p[1]), c = inMemory(p[2]);
		const auto square = [](const Point2& from, const Point2& to) {
			return std::norm(asComplex(to) - asComplex(from));
		};
		const double longest = std::sqrt(std::max({square(a, b), square(b, c), square(c, a)}));
		return orientation(a, b, c) > 0 && doubledArea(a, b, c) > height * longest &&
			   (step == 0.0 || isUpright(p));
	}

private:
	/// The point as it is stored, in steps if there are any: decimal fractions are no doubles.
	Point2 inSteps(const Point2& p) const
	{
		Point2 rounded = inMemory(p);
		if (step > 0.0)
			for (double& x : rounded)
				x = std::nearbyint(x / step);
		return rounded;
	}

	Point2 inMemory(const Point2& p) const
	{
		return asFloats ? Point2{roundedToFloat(p[0]), roundedToFloat(p[1])} : p;
	}
};

} // namespace ricci

#endif
