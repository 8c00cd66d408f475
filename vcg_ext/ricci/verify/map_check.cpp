// SPDX-License-Identifier: GPL-3.0-or-later
#include "map_check.h"

#include "../layout/orientation.h"
#include "../numbers.h"
#include "shared_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ricci {

namespace {

struct Side
{
	int low, high;
	Point2 atLow, atHigh;
};

double length(const Side& s)
{
	return std::hypot(s.atHigh[0] - s.atLow[0], s.atHigh[1] - s.atLow[1]);
}

/// Over the longest side.
double heightOf(const std::array<Point2, 3>& p)
{
	double longest = 0.0;
	for (std::size_t k = 0; k < 3; ++k)
		longest =
			std::max(longest, std::hypot(p[(k + 1) % 3][0] - p[k][0], p[(k + 1) % 3][1] - p[k][1]));
	const double area =
		(p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
	return longest > 0.0 ? std::abs(area) / longest : 0.0;
}

} // namespace

MapCheck checkMap(
	const std::vector<Triangle>& triangles,
	const std::vector<std::array<Point2, 3>>& plane,
	const std::vector<char>& reversed,
	double tolerance)
{
	MapCheck check;
	const double far = std::numeric_limits<double>::infinity();
	Point2 low{far, far}, high{-far, -far};
	for (const auto& triangle : plane)
		for (const Point2& p : triangle)
			for (std::size_t k = 0; k < 2; ++k) {
				check.finite &= std::isfinite(p[k]);
				low[k] = std::min(low[k], p[k]);
				high[k] = std::max(high[k], p[k]);
			}
	if (!check.finite || plane.empty())
		return check;
	const double extent = std::max(high[0] - low[0], high[1] - low[1]);

	std::vector<Side> sides;
	sides.reserve(3 * triangles.size());
	for (std::size_t f = 0; f < triangles.size(); ++f) {
		const Triangle& t = triangles[f];
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t next = (k + 1) % 3;
			sides.push_back(
				t[k] < t[next] ? Side{t[k], t[next], plane[f][k], plane[f][next]}
							   : Side{t[next], t[k], plane[f][next], plane[f][k]});
		}
		const int wanted = reversed[f] ? -1 : 1;
		check.turned += orientation(plane[f][0], plane[f][1], plane[f][2]) != wanted &&
						heightOf(plane[f]) > tolerance * extent;
	}
	forSharedEdges(sides, [&](const Side& a, const Side& b) {
		if (extent > 0.0)
			check.seamGap = std::max(check.seamGap, std::abs(length(a) - length(b)) / extent);
	});
	return check;
}

} // namespace ricci
