// SPDX-License-Identifier: GPL-3.0-or-later
#include "min_area_rectangle.h"

#include "convex_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace ricci {

namespace {

/// The rectangle whose lower side is that of a convex polygon from corner \p i, without min and max.
OrientedRectangle frameAlong(const std::vector<Point2>& hull, std::size_t i)
{
	const Point2& p = hull[i];
	const Point2& q = hull[(i + 1) % hull.size()];
	const double length = distance(p, q);
	OrientedRectangle r;
	if (length > 0.0) {
		r.cosine = (q[0] - p[0]) / length;
		r.sine = (q[1] - p[1]) / length;
	}
	return r;
}

/// Round all points.
void measure(const std::vector<Point2>& hull, OrientedRectangle& r)
{
	r.min = r.max = r.inFrame(hull.front());
	for (const Point2& p : hull) {
		const Point2 x = r.inFrame(p);
		for (std::size_t k = 0; k < 2; ++k) {
			r.min[k] = std::min(r.min[k], x[k]);
			r.max[k] = std::max(r.max[k], x[k]);
		}
	}
}

/// The corner of a convex polygon where \p height is largest, searched uphill from \p from.
template<class Height>
std::size_t
uphill(const std::vector<Point2>& hull, std::size_t from, double& highest, const Height& height)
{
	highest = height(hull[from]);
	for (std::size_t steps = 0; steps < hull.size(); ++steps) {
		const std::size_t next = (from + 1) % hull.size();
		const double there = height(hull[next]);
		if (there < highest)
			break;
		from = next;
		highest = there;
	}
	return from;
}

/// The corner from which the side of a convex polygon starts along which the rectangle round it has
/// the least area. Its right, upper and left corners go round once with the side [Toussaint 1983].
std::size_t bestSide(const std::vector<Point2>& hull)
{
	std::size_t best = 0, right = 0, upper = 0, left = 0;
	double minArea = std::numeric_limits<double>::infinity();
	for (std::size_t i = 0; i < hull.size(); ++i) {
		const OrientedRectangle r = frameAlong(hull, i);
		const auto x = [&](const Point2& p) { return r.inFrame(p)[0]; };
		const auto y = [&](const Point2& p) { return r.inFrame(p)[1]; };
		double maxX = 0.0, maxY = 0.0, maxMinusX = 0.0;
		right = uphill(hull, i == 0 ? 0 : right, maxX, x);
		upper = uphill(hull, i == 0 ? right : upper, maxY, y);
		left =
			uphill(hull, i == 0 ? upper : left, maxMinusX, [&](const Point2& p) { return -x(p); });
		const double minY = std::min(y(hull[i]), y(hull[(i + 1) % hull.size()]));
		const double area = (maxX + maxMinusX) * (maxY - minY);
		if (area < minArea) {
			minArea = area;
			best = i;
		}
	}
	return best;
}

} // namespace

OrientedRectangle minAreaRectangle(std::vector<Point2> points)
{
	const std::vector<Point2> hull = convexHull(std::move(points));
	OrientedRectangle best = frameAlong(hull, bestSide(hull));
	measure(hull, best);
	if (best.height() > best.width()) { // a quarter turn
		const OrientedRectangle r = best;
		best.cosine = -r.sine;
		best.sine = r.cosine;
		best.min = {r.min[1], -r.max[0]};
		best.max = {r.max[1], -r.min[0]};
	}
	return best;
}

OrientedRectangle minExtentRectangle(std::vector<Point2> points)
{
	const std::vector<Point2> hull = convexHull(std::move(points));
	const auto extent = [](const OrientedRectangle& r) { return std::max(r.width(), r.height()); };
	OrientedRectangle best;
	measure(hull, best);
	double bestAt = 0.0;
	// Tangent of half the angle, 0 to 1. Between two steps an extent changes by less than their angle.
	const auto look = [&](double at) {
		OrientedRectangle r;
		r.cosine = (1.0 - at * at) / (1.0 + at * at);
		r.sine = 2.0 * at / (1.0 + at * at);
		measure(hull, r);
		if (extent(r) < extent(best)) {
			best = r;
			bestAt = at;
		}
	};
	constexpr int steps = 256, finer = 16;
	double step = 1.0 / steps;
	for (int k = 1; k < steps; ++k)
		look(k * step);
	for (; step > 0.5 * kSquareAccuracy; step /= finer) {
		const double from = bestAt;
		for (int k = 1 - finer; k < finer; ++k)
			look(std::clamp(from + k * step / finer, 0.0, 1.0));
	}
	return best;
}

} // namespace ricci
