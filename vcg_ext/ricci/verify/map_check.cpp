// SPDX-License-Identifier: GPL-3.0-or-later
#include "map_check.h"

#include "../math/orientation.h"
#include "shared_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ricci {

namespace {

double lengthOf(const PlaneSide& s)
{
	return distance(s.atHigh, s.atLow);
}

/// Over the longest side.
double heightOf(const Triangle2& p)
{
	double longest = 0.0;
	for (std::size_t k = 0; k < 3; ++k)
		longest = std::max(longest, distance(p[(k + 1) % 3], p[k]));
	return longest > 0.0 ? std::abs(doubledArea(p[0], p[1], p[2])) / longest : 0.0;
}

} // namespace

MapCheck checkMap(
	const std::vector<Triangle>& triangles,
	const std::vector<Triangle2>& plane,
	const std::vector<char>& reversed,
	double tolerance)
{
	MapCheck check;
	Box2 box;
	for (const Triangle2& triangle : plane)
		for (const Point2& p : triangle) {
			check.finite = check.finite && std::isfinite(p[0]) && std::isfinite(p[1]);
			box.add(p);
		}
	if (!check.finite || plane.empty())
		return check;
	const double extent = box.extent();

	for (std::size_t f = 0; f < triangles.size(); ++f) {
		const int wanted = reversed[f] ? -1 : 1;
		check.turned += orientation(plane[f][0], plane[f][1], plane[f][2]) != wanted &&
						heightOf(plane[f]) > tolerance * extent;
	}
	std::vector<PlaneSide> sides = planeSides(triangles, plane);
	forSharedEdges(sides, [&](const PlaneSide& a, const PlaneSide& b) {
		if (extent > 0.0 && (a.atLow != b.atLow || a.atHigh != b.atHigh))
			check.seamGap = std::max(check.seamGap, std::abs(lengthOf(a) - lengthOf(b)) / extent);
	});
	return check;
}

} // namespace ricci
