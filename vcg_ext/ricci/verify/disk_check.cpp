// SPDX-License-Identifier: GPL-3.0-or-later
#include "disk_check.h"

#include "../base/task.h"
#include "../base/tolerances.h"
#include "../math/double_double.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace ricci {

namespace {

// What cancels is computed exactly, the rest in double.

/// |p|^2.
DoubleDouble square(const Point2& p)
{
	return DoubleDouble::product(p[0], p[0]) + DoubleDouble::product(p[1], p[1]);
}

/// 1 - |p|^2.
double gap(const Point2& p)
{
	return static_cast<double>(1 - square(p));
}

/// Distance by which rounding may have moved \p p.
double rounding(const Point2& p)
{
	return 2 * kDiskRounding / std::max(gap(p), kDiskRounding);
}

double distanceOf(const Point2& p, const Point2& q)
{
	const double chord = std::hypot(p[0] - q[0], p[1] - q[1]);
	return 2 *
		   std::asinh(chord / std::sqrt(std::max(gap(p) * gap(q), kDiskRounding * kDiskRounding)));
}

/// det(X, Y, Z) of the points on the hyperboloid, X = (1 + |p|^2, 2 p) / (1 - |p|^2). X is
/// subtracted from Y and Z first, in terms of the differences of the points, which are exact where
/// these are near each other.
double determinant(const Point2& p, const Point2& q, const Point2& r)
{
	const auto difference = [&](const Point2& x, std::size_t k) {
		return DoubleDouble::sum(x[k], -p[k]);
	};
	const DoubleDouble ax = difference(q, 0), ay = difference(q, 1);
	const DoubleDouble bx = difference(r, 0), by = difference(r, 1);
	const DoubleDouble a0 = ax * DoubleDouble::sum(q[0], p[0]) + ay * DoubleDouble::sum(q[1], p[1]);
	const DoubleDouble b0 = bx * DoubleDouble::sum(r[0], p[0]) + by * DoubleDouble::sum(r[1], p[1]);
	const DoubleDouble minor = (1 + square(p)) * (ax * by - ay * bx) - p[0] * (a0 * by - ay * b0) +
							   p[1] * (a0 * bx - ax * b0);
	return 4.0 * static_cast<double>(minor) / (gap(p) * gap(q) * gap(r));
}

} // namespace

DiskCheck checkDisk(const FlatMesh& chart, double tolerance)
{
	DiskCheck check;
	Point2 farthest{0.0, 0.0};
	double minGap = 1.0;
	for (const Triangle& triangle : chart.points)
		for (const int point : triangle) {
			const Point2& p = chart.place[point];
			const double own = gap(p);
			check.outside += !(own > 0);
			if (own < minGap) {
				minGap = own;
				farthest = p;
			}
		}
	if (check.outside > 0)
		return check;
	check.radius = distanceOf(farthest, Point2{0.0, 0.0});
	CornerArray<double> length(3 * chart.size()); // of the side
	for (const Corner side : length.indices())
		length[side] = distanceOf(chart.at(side), chart.at(side.next()));
	const auto roundingOf = [&](Corner side) {
		return rounding(chart.at(side)) + rounding(chart.at(side.next()));
	};
	const Sides sides(chart.vertices.values());
	for (const int f : chart.points.indices()) {
		checkpointNowAndThen(positionOf(f));
		const Triangle2 p = chart.at(f);
		double longest = 0.0, allowed = tolerance;
		for (const Corner side : cornersOf(f)) {
			longest = std::max(longest, length[side]);
			allowed += rounding(chart.at(side));
			if (const Corner other = sides.across(side); other > side)
				check.seamGap = std::max(
					check.seamGap,
					std::abs(length[side] - length[other]) - roundingOf(side) - roundingOf(other));
		}
		const double det = determinant(p[0], p[1], p[2]);
		check.flipped += det <= 0 && -det > std::sinh(allowed) * std::sinh(longest);
	}
	return check;
}

} // namespace ricci
