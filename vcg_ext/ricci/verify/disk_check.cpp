// SPDX-License-Identifier: GPL-3.0-or-later
#include "disk_check.h"

#include "../numbers.h"
#include "shared_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ricci {

namespace {

using Real = long double;

/// Units of rounding that the layout may have left in a coordinate.
constexpr Real kRounding = 8 * std::numeric_limits<double>::epsilon();

/// 1 - |p|^2.
Real gap(const Point2& p)
{
	const Real r = std::hypot(Real(p[0]), Real(p[1]));
	return (1 - r) * (1 + r);
}

/// What rounding of \p p moves it by.
Real rounding(const Point2& p)
{
	return 2 * kRounding / std::max(gap(p), kRounding);
}

Real distanceOf(const Point2& p, const Point2& q)
{
	const Real chord = std::hypot(Real(p[0]) - q[0], Real(p[1]) - q[1]);
	return 2 * std::asinh(chord / std::sqrt(std::max(gap(p) * gap(q), kRounding * kRounding)));
}

/// det(X, Y, Z) of the points on the hyperboloid, X = (1 + |p|^2, 2 p) / (1 - |p|^2). The first row is
/// taken from the others before, where the points are near each other.
Real determinant(const Point2& p, const Point2& q, const Point2& r)
{
	const auto square = [](const Point2& x) { return Real(x[0]) * x[0] + Real(x[1]) * x[1]; };
	const Real ax = Real(q[0]) - p[0], ay = Real(q[1]) - p[1];
	const Real bx = Real(r[0]) - p[0], by = Real(r[1]) - p[1];
	const Real at = ax * (Real(q[0]) + p[0]) + ay * (Real(q[1]) + p[1]);
	const Real bt = bx * (Real(r[0]) + p[0]) + by * (Real(r[1]) + p[1]);
	const Real minor = (1 + square(p)) * (ax * by - ay * bx) - Real(p[0]) * (at * by - ay * bt) +
					   Real(p[1]) * (at * bx - ax * bt);
	return 4 * minor / (gap(p) * gap(q) * gap(r));
}

struct Side
{
	int low, high;
	Real length, rounding;
};

} // namespace

DiskCheck checkDisk(
	const std::vector<Triangle>& triangles,
	const std::vector<std::array<Point2, 3>>& plane,
	const std::vector<char>& reversed,
	double tolerance)
{
	DiskCheck check;
	for (const auto& triangle : plane)
		for (const Point2& p : triangle)
			check.outside += !(gap(p) > 0);
	if (check.outside > 0)
		return check;
	std::vector<Side> sides;
	sides.reserve(3 * triangles.size());
	for (std::size_t f = 0; f < triangles.size(); ++f) {
		const Triangle& t = triangles[f];
		const std::array<Point2, 3>& p = plane[f];
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
			check.radius =
				std::max(check.radius, static_cast<double>(distanceOf(p[k], Point2{0.0, 0.0})));
		}
		const Real det = determinant(p[0], p[1], p[2]);
		const bool right = reversed[f] ? det < 0 : det > 0;
		check.turned += !right && std::abs(det) > std::sinh(allowed) * std::sinh(longest);
	}
	forSharedEdges(sides, [&](const Side& a, const Side& b) {
		const Real error = std::abs(a.length - b.length) - a.rounding - b.rounding;
		check.seamGap = std::max(check.seamGap, static_cast<double>(error));
	});
	return check;
}

} // namespace ricci
