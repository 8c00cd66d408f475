// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_check.h"

#include "../base/numbers.h"
#include "../base/orientation.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "../numerics/double_double.h"
#include "metric_check.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ricci {

namespace {

/// Over the longest side.
double heightOf(const Triangle2& p)
{
	double longest = 0.0;
	for (std::size_t k = 0; k < 3; ++k)
		longest = std::max(longest, distance(p[(k + 1) % 3], p[k]));
	return longest > 0.0 ? std::abs(doubledArea(p)) / longest : 0.0;
}

// In the disk, what cancels is computed exactly, the rest in double.

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

ChartCheck checkMap(const FlatMesh& chart, double tolerance)
{
	ChartCheck check;
	Box2 box;
	for (const Point2& p : chart.place) {
		check.outside += !(std::isfinite(p[0]) && std::isfinite(p[1]));
		box.add(p);
	}
	if (check.outside > 0 || chart.size() == 0)
		return check;
	const double extent = box.extent();
	const auto lengthOf = [&](Corner side) {
		return distance(chart.at(side), chart.at(side.next()));
	};
	for (const int f : chart.points.indices()) {
		const Triangle2 p = chart.at(f);
		check.flipped += orientation(p) <= 0 && heightOf(p) > tolerance * extent;
		for (const Corner side : cornersOf(f))
			if (const Corner other = chart.across[side]; other > side && extent > 0.0)
				check.seamGap =
					std::max(check.seamGap, std::abs(lengthOf(side) - lengthOf(other)) / extent);
	}
	return check;
}

ChartCheck checkDisk(const FlatMesh& chart, double tolerance)
{
	ChartCheck check;
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
	for (const int f : chart.points.indices()) {
		checkpointNowAndThen(positionOf(f));
		const Triangle2 p = chart.at(f);
		double longest = 0.0, allowed = tolerance;
		for (const Corner side : cornersOf(f)) {
			longest = std::max(longest, length[side]);
			allowed += rounding(chart.at(side));
			if (const Corner other = chart.across[side]; other > side)
				check.seamGap = std::max(
					check.seamGap,
					std::abs(length[side] - length[other]) - roundingOf(side) - roundingOf(other));
		}
		const double det = determinant(p[0], p[1], p[2]);
		check.flipped += det <= 0 && -det > std::sinh(allowed) * std::sinh(longest);
	}
	return check;
}

void requireMap(const FlatMesh& chart, const FlowResult& flow, bool bent, bool seamsFit)
{
	const double tolerance = kCheckedGap + openCurvature(flow);
	const ChartCheck check = checkMap(chart, tolerance);
	if (check.outside > 0 || (seamsFit && !(check.seamGap <= tolerance)) ||
		(check.flipped > 0 && !bent))
		throw NotConverged(
			"seams " + numberText(check.seamGap, 3) + " of the chart apart, " +
			std::to_string(check.flipped) + " faces flipped");
}

void requireDisk(const FlatMesh& chart, const FlowResult& flow, bool bent)
{
	// The gap that an open angle leaves grows like sinh of the distance across the layout.
	double radius = 0.0;
	bool finite = true;
	for (const Point2& p : chart.place) {
		const double r = std::hypot(p[0], p[1]);
		finite = finite && std::isfinite(r);
		radius = std::max(radius, 2.0 * std::atanh(std::min(1.0, r)));
	}
	const double tolerance = kCheckedGap + openCurvature(flow) * std::sinh(2.0 * radius);
	const ChartCheck check = checkDisk(chart, tolerance);
	if (check.outside > 0 && finite) // the doubles of the disk end at a distance of about 37
		throw NotConverged(NotConverged::OutsideDisk, check.outside);
	if (check.outside > 0)
		throw NotConverged(std::to_string(check.outside) + " points lie outside the disk");
	if (!(check.seamGap <= tolerance) || (check.flipped > 0 && !bent))
		throw NotConverged(
			"seams " + numberText(check.seamGap, 3) + " apart in the disk, " +
			std::to_string(check.flipped) + " faces flipped");
}

} // namespace ricci
