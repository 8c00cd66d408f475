// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_rectangle.h"

#include "orientation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ricci {

namespace {

/// Corners of the convex hull, counter-clockwise (monotone chain).
std::vector<Point2> convexHull(std::vector<Point2> points)
{
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

OrientedRectangle leastRectangle(std::vector<Point2> points)
{
	const std::vector<Point2> hull = convexHull(std::move(points));
	OrientedRectangle best;
	double leastArea = std::numeric_limits<double>::infinity();
	for (std::size_t i = 0; i < hull.size(); ++i) {
		const Point2& p = hull[i];
		const Point2& q = hull[(i + 1) % hull.size()];
		const double length = std::hypot(q[0] - p[0], q[1] - p[1]);
		OrientedRectangle r;
		if (length > 0.0) {
			r.cosine = (q[0] - p[0]) / length;
			r.sine = (q[1] - p[1]) / length;
		}
		r.low = r.high = r.inFrame(p);
		for (const Point2& other : hull) {
			const Point2 x = r.inFrame(other);
			for (std::size_t k = 0; k < 2; ++k) {
				r.low[k] = std::min(r.low[k], x[k]);
				r.high[k] = std::max(r.high[k], x[k]);
			}
		}
		const double area = (r.high[0] - r.low[0]) * (r.high[1] - r.low[1]);
		if (area < leastArea) {
			leastArea = area;
			best = r;
		}
	}
	if (best.high[1] - best.low[1] > best.high[0] - best.low[0]) { // a quarter turn
		const OrientedRectangle r = best;
		best.cosine = -r.sine;
		best.sine = r.cosine;
		best.low = {r.low[1], -r.high[0]};
		best.high = {r.high[1], -r.low[0]};
	}
	return best;
}

} // namespace ricci
