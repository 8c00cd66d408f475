// SPDX-License-Identifier: GPL-3.0-or-later
#include "map_check.h"

#include "../math/orientation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ricci {

namespace {

/// Over the longest side.
double heightOf(const Triangle2& p)
{
	double longest = 0.0;
	for (std::size_t k = 0; k < 3; ++k)
		longest = std::max(longest, distance(p[(k + 1) % 3], p[k]));
	return longest > 0.0 ? std::abs(doubledArea(p[0], p[1], p[2])) / longest : 0.0;
}

} // namespace

MapCheck checkMap(const FlatMesh& chart, double tolerance)
{
	MapCheck check;
	Box2 box;
	for (const Point2& p : chart.place) {
		check.finite = check.finite && std::isfinite(p[0]) && std::isfinite(p[1]);
		box.add(p);
	}
	if (!check.finite || chart.size() == 0)
		return check;
	const double extent = box.extent();
	const Sides sides(chart.vertices.values());
	const auto lengthOf = [&](Corner side) {
		return distance(chart.at(side), chart.at(side.next()));
	};
	for (const int f : chart.points.indices()) {
		const Triangle2 p = chart.at(f);
		check.flipped += orientation(p[0], p[1], p[2]) <= 0 && heightOf(p) > tolerance * extent;
		for (const Corner side : cornersOf(f))
			if (const Corner other = sides.across(side); other > side && extent > 0.0)
				check.seamGap =
					std::max(check.seamGap, std::abs(lengthOf(side) - lengthOf(other)) / extent);
	}
	return check;
}

} // namespace ricci
