// SPDX-License-Identifier: GPL-3.0-or-later
#include "convex_hull.h"

#include "numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace ricci {

namespace {

/// Drops points inside the polygon of those that are farthest in eight directions, as far as doubles
/// tell: they are not corners of the convex hull.
void dropInside(std::vector<Point2>& points)
{
	static constexpr std::array<Point2, 8> directions{
		{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
	std::array<double, 8> farthest;
	farthest.fill(-kInfinity);
	std::array<Point2, 8> polygon{}; // counter-clockwise
	double largest = 0.0;
	for (const Point2& p : points) {
		largest = std::max({largest, std::abs(p[0]), std::abs(p[1])});
		for (std::size_t k = 0; k < 8; ++k)
			if (const double along = directions[k][0] * p[0] + directions[k][1] * p[1];
				along > farthest[k]) {
				farthest[k] = along;
				polygon[k] = p;
			}
	}
	// More than the rounding error of a doubled area.
	const double minArea = std::max(
		64.0 * std::numeric_limits<double>::epsilon() * largest * largest,
		std::numeric_limits<double>::min());
	// Of a convex polygon whose corners go round counter-clockwise.
	const auto isInside = [&](const Point2& p) {
		for (std::size_t k = 0; k < 8; ++k) {
			const Point2 &a = polygon[k], &b = polygon[(k + 1) % 8];
			if (a != b && !(doubledArea(a, b, p) > minArea))
				return false;
		}
		return true;
	};
	if (polygon.front() != polygon[4] || polygon[2] != polygon[6])
		points.erase(std::remove_if(points.begin(), points.end(), isInside), points.end());
}

/// Leaves out the side of a convex polygon that adds the least area, where its neighbours meet.
/// \return false, and nothing is done, if no neighbours do
bool dropSide(std::vector<Point2>& polygon)
{
	const std::size_t n = polygon.size();
	std::size_t side = 0;
	Point2 corner{0.0, 0.0};
	double least = kInfinity; // twice what is added
	for (std::size_t i = 0; i < n; ++i) {
		const Point2 &o = polygon[(i + n - 1) % n], &p = polygon[i];
		const Point2 &q = polygon[(i + 1) % n], &r = polygon[(i + 2) % n];
		// The line through o and p meets that through r and q in p + t (p - o).
		const double turn = (p[0] - o[0]) * (r[1] - q[1]) - (p[1] - o[1]) * (r[0] - q[0]);
		const double t = doubledArea(q, r, p) / turn;
		if (!(turn > 0.0) || !std::isfinite(t))
			continue;
		const Point2 x{p[0] + t * (p[0] - o[0]), p[1] + t * (p[1] - o[1])};
		if (const double area = std::abs(doubledArea(p, x, q)); area < least) {
			side = i;
			corner = x;
			least = area;
		}
	}
	if (std::isinf(least))
		return false;
	polygon[side] = corner;
	polygon.erase(std::next(polygon.begin(), static_cast<std::ptrdiff_t>((side + 1) % n)));
	return true;
}

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
	for (const Point2& p : hull)
		r.add(r.inFrame(p));
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
	double minArea = kInfinity;
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

std::vector<Point2> convexHull(std::vector<Point2> points)
{
	if (!points.empty())
		dropInside(points);
	std::sort(points.begin(), points.end());
	points.erase(std::unique(points.begin(), points.end()), points.end());
	if (points.size() < 3)
		return points;
	std::vector<Point2> hull;
	for (int pass = 0; pass < 2; ++pass) {
		const std::size_t start = hull.size();
		for (const Point2& p : points) {
			while (hull.size() >= start + 2 &&
				   orientation(hull[hull.size() - 2], hull.back(), p) <= 0)
				hull.pop_back();
			hull.push_back(p);
		}
		hull.pop_back();
		std::reverse(points.begin(), points.end());
	}
	return hull;
}

std::vector<Point2> enclosingPolygon(std::vector<Point2> polygon, std::size_t maxCorners)
{
	while (polygon.size() > maxCorners && dropSide(polygon))
		;
	return polygon;
}

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
	OrientedRectangle best;
	measure(hull, best);
	double bestAt = 0.0;
	// Tangent of half the angle, 0 to 1. Between two steps an extent changes by less than their angle.
	const auto look = [&](double at) {
		OrientedRectangle r;
		r.cosine = (1.0 - at * at) / (1.0 + at * at);
		r.sine = 2.0 * at / (1.0 + at * at);
		measure(hull, r);
		if (r.extent() < best.extent()) {
			best = r;
			bestAt = at;
		}
	};
	constexpr int steps = 256, finer = 16;
	double step = 1.0 / steps;
	for (int k = 1; k < steps; ++k)
		look(k * step);
	for (; step > 0.5 * 1e-4; step /= finer) {
		const double from = bestAt;
		for (int k = 1 - finer; k < finer; ++k)
			look(std::clamp(from + k * step / finer, 0.0, 1.0));
	}
	return best;
}

} // namespace ricci
