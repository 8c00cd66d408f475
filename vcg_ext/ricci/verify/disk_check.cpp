// SPDX-License-Identifier: GPL-3.0-or-later
#include "disk_check.h"

#include "../base/tolerances.h"
#include "shared_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace ricci {

namespace {

using Real = long double;

/// 1 - |p|^2.
Real gap(const Point2& p)
{
	const Real r = std::hypot(Real(p[0]), Real(p[1]));
	return (1 - r) * (1 + r);
}

/// Distance by which rounding may have moved \p p.
Real rounding(const Point2& p)
{
	return 2 * kDiskRounding / std::max(gap(p), kDiskRounding);
}

Real distanceOf(const Point2& p, const Point2& q)
{
	const Real chord = std::hypot(Real(p[0]) - q[0], Real(p[1]) - q[1]);
	return 2 *
		   std::asinh(chord / std::sqrt(std::max(gap(p) * gap(q), kDiskRounding * kDiskRounding)));
}

/// det(X, Y, Z) of the points on the hyperboloid, X = (1 + |p|^2, 2 p) / (1 - |p|^2). X is
/// subtracted from Y and Z first, in terms of the differences of the points, which are exact where
/// these are near each other.
Real determinant(const Point2& p, const Point2& q, const Point2& r)
{
	const auto square = [](const Point2& x) { return Real(x[0]) * x[0] + Real(x[1]) * x[1]; };
	const Real ax = Real(q[0]) - p[0], ay = Real(q[1]) - p[1];
	const Real bx = Real(r[0]) - p[0], by = Real(r[1]) - p[1];
	const Real a0 = ax * (Real(q[0]) + p[0]) + ay * (Real(q[1]) + p[1]);
	const Real b0 = bx * (Real(r[0]) + p[0]) + by * (Real(r[1]) + p[1]);
	const Real minor = (1 + square(p)) * (ax * by - ay * bx) - Real(p[0]) * (a0 * by - ay * b0) +
					   Real(p[1]) * (a0 * bx - ax * b0);
	return 4 * minor / (gap(p) * gap(q) * gap(r));
}

struct DiskSide
{
	int low, high;
	Real length, rounding;
};

} // namespace

DiskCheck checkDisk(
	const std::vector<Triangle>& triangles,
	const std::vector<Triangle2>& plane,
	const std::vector<char>& reversed,
	double tolerance,
	const Tick& tick)
{
	DiskCheck check;
	Point2 farthest{0.0, 0.0};
	Real leastGap = 1;
	for (const Triangle2& triangle : plane)
		for (const Point2& p : triangle) {
			const Real own = gap(p);
			check.outside += !(own > 0);
			if (own < leastGap) {
				leastGap = own;
				farthest = p;
			}
		}
	if (check.outside > 0)
		return check;
	check.radius = static_cast<double>(distanceOf(farthest, Point2{0.0, 0.0}));
	std::vector<DiskSide> sides;
	sides.reserve(3 * triangles.size());
	for (std::size_t f = 0; f < triangles.size(); ++f) {
		tickNowAndThen(tick, f);
		const Triangle& t = triangles[f];
		const Triangle2& p = plane[f];
		Real longest = 0, allowed = tolerance;
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t next = (k + 1) % 3;
			const Real length = distanceOf(p[k], p[next]);
			sides.push_back(
				{std::min(t[k], t[next]),
				 std::max(t[k], t[next]),
				 length,
				 rounding(p[k]) + rounding(p[next])});
			longest = std::max(longest, length);
			allowed += rounding(p[k]);
		}
		const Real det = determinant(p[0], p[1], p[2]);
		const bool right = reversed[f] ? det < 0 : det > 0;
		check.turned += !right && std::abs(det) > std::sinh(allowed) * std::sinh(longest);
	}
	forSharedEdges(sides, [&](const DiskSide& a, const DiskSide& b) {
		const Real error = std::abs(a.length - b.length) - a.rounding - b.rounding;
		check.seamGap = std::max(check.seamGap, static_cast<double>(error));
	});
	return check;
}

} // namespace ricci
