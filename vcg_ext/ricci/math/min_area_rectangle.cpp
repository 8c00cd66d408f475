// SPDX-License-Identifier: GPL-3.0-or-later
#include "min_area_rectangle.h"

#include "orientation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace ricci {

namespace {

/// Takes away points inside the polygon of those that lie farthest in eight directions: most.
void removeInner(std::vector<Point2>& points)
{
	std::array<std::size_t, 8> farthest{};
	const auto along = [&](std::size_t i, std::size_t direction) {
		constexpr double kX[] = {1, 1, 0, -1, -1, -1, 0, 1}, kY[] = {0, 1, 1, 1, 0, -1, -1, -1};
		return kX[direction] * points[i][0] + kY[direction] * points[i][1];
	};
	for (std::size_t i = 0; i < points.size(); ++i)
		for (std::size_t k = 0; k < farthest.size(); ++k)
			if (along(i, k) > along(farthest[k], k))
				farthest[k] = i;
	std::vector<Point2> polygon;
	for (const std::size_t i : farthest)
		if (polygon.empty() || (points[i] != polygon.back() && points[i] != polygon.front()))
			polygon.push_back(points[i]);
	// A box that lies between those in the diagonal directions; and a closed polygon that has a point
	// on the left of all its sides goes round it.
	const Point2 &ne = points[farthest[1]], &nw = points[farthest[3]], &sw = points[farthest[5]],
				 &se = points[farthest[7]];
	const Point2 low{std::max(nw[0], sw[0]), std::max(sw[1], se[1])};
	const Point2 high{std::min(ne[0], se[0]), std::min(ne[1], nw[1])};
	const auto isInside = [&](const Point2& p) {
		if (low[0] < p[0] && p[0] < high[0] && low[1] < p[1] && p[1] < high[1])
			return true;
		for (std::size_t k = 0; k < polygon.size(); ++k)
			if (orientation(polygon[k], polygon[(k + 1) % polygon.size()], p) <= 0)
				return false;
		return true;
	};
	points.erase(std::remove_if(points.begin(), points.end(), isInside), points.end());
}

/// Corners of the convex hull, counter-clockwise (monotone chain
/// [Andrew 1979]).
std::vector<Point2> convexHull(std::vector<Point2> points)
{
	if (!points.empty())
		removeInner(points);
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

} // namespace

OrientedRectangle minAreaRectangle(std::vector<Point2> points)
{
	const std::vector<Point2> hull = convexHull(std::move(points));
	OrientedRectangle best;
	double minArea = std::numeric_limits<double>::infinity();
	for (std::size_t i = 0; i < hull.size(); ++i) {
		const Point2& p = hull[i];
		const Point2& q = hull[(i + 1) % hull.size()];
		const double length = distance(p, q);
		OrientedRectangle r;
		if (length > 0.0) {
			r.cosine = (q[0] - p[0]) / length;
			r.sine = (q[1] - p[1]) / length;
		}
		r.min = r.max = r.inFrame(p);
		for (const Point2& other : hull) {
			const Point2 x = r.inFrame(other);
			for (std::size_t k = 0; k < 2; ++k) {
				r.min[k] = std::min(r.min[k], x[k]);
				r.max[k] = std::max(r.max[k], x[k]);
			}
		}
		const double area = r.width() * r.height();
		if (area < minArea) {
			minArea = area;
			best = r;
		}
	}
	if (best.height() > best.width()) { // a quarter turn
		const OrientedRectangle r = best;
		best.cosine = -r.sine;
		best.sine = r.cosine;
		best.min = {r.min[1], -r.max[0]};
		best.max = {r.max[1], -r.min[0]};
	}
	return best;
}

} // namespace ricci
