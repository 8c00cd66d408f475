// SPDX-License-Identifier: GPL-3.0-or-later
#include "overlap_check.h"

#include "../base/floating_point.h"
#include "../charts/chart_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace ricci {

namespace {

/// Coordinates rounded to float. \param step receives that of the largest one
Array<Point2> inFloats(Array<Point2> places, double& step)
{
	double largest = 0.0;
	for (Point2& p : places)
		for (double& x : p) {
			x = roundedToFloat(x);
			largest = std::max(largest, std::abs(x));
		}
	step = floatStep(largest);
	return places;
}

} // namespace

void countOverlaps(Parametrization& map)
{
	double step = 0.0;
	FlatMesh stored = map.mesh;
	stored.place = inFloats(std::move(stored.place), step);
	map.report.overlappingFaces = map.report.overlappingCharts = 0;
	const OverlapSearch search(stored, kTouchingSteps * step);
	const Array<char> overlaps = search.overlapping();
	std::vector<char> isChart(map.charts.size(), 0);
	for (const int f : overlaps.indices())
		if (overlaps[f]) {
			++map.report.overlappingFaces;
			isChart[positionOf(stored.chart[f])] = 1;
		}
	map.report.overlappingCharts = static_cast<int>(std::count(isChart.begin(), isChart.end(), 1));
}

void countUnequalSeams(Parametrization& map)
{
	double step = 0.0;
	const Array<Point2> stored = inFloats(map.mesh.place, step);
	const auto length = [&](Corner side) {
		return distance(stored[map.mesh.points[side]], stored[map.mesh.points[side.next()]]);
	};
	const std::vector<Corner> edges = seams(map.mesh).edges;
	map.report.unequalSeams =
		static_cast<int>(std::count_if(edges.begin(), edges.end(), [&](Corner side) {
			const double own = length(side), across = length(map.mesh.across[side]);
			return std::abs(own - across) >
				   std::max(kUnequalShare * std::max(own, across), kTouchingSteps * step);
		}));
}

} // namespace ricci
