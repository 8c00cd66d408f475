// SPDX-License-Identifier: GPL-3.0-or-later
#include "result_check.h"

#include "../base/task.h"
#include "../base/text.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "../math/orientation.h"
#include "chart_check.h"
#include "disk_check.h"
#include "flow_check.h"
#include "map_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace ricci {

void requireMap(const FlatMesh& chart, const FlowResult& flow, bool bent, bool seamsFit)
{
	const double tolerance = kCheckedGap + openCurvature(flow);
	const MapCheck check = checkMap(chart, tolerance);
	if (!check.finite || (seamsFit && !(check.seamGap <= tolerance)) ||
		(check.flipped > 0 && !bent))
		failCheck(
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
	const DiskCheck check = checkDisk(chart, tolerance);
	if (check.outside > 0 && finite) // the doubles of the disk end at a distance of about 37
		throw NotConverged(NotConverged::OutsideDisk, check.outside);
	if (check.outside > 0)
		failCheck(std::to_string(check.outside) + " points lie outside the disk");
	if (!(check.seamGap <= tolerance) || (check.flipped > 0 && !bent))
		failCheck(
			"seams " + numberText(check.seamGap, 3) + " apart in the disk, " +
			std::to_string(check.flipped) + " faces flipped");
}

void requireSeparateCharts(const Parametrization& map)
{
	std::vector<Box2> boxes(map.charts.size());
	std::vector<char> hasFlipped(map.charts.size(), 0);
	for (const int f : map.mesh.points.indices()) {
		const Triangle2 p = map.mesh.at(f);
		const std::size_t chart = positionOf(map.mesh.chart[f]);
		for (const Point2& corner : p)
			boxes[chart].add(corner);
		if (orientation(p[0], p[1], p[2]) <= 0)
			hasFlipped[chart] = 1;
	}
	// Charts lie beside each other on one scale.
	double extent = 0.0;
	for (const Box2& box : boxes)
		extent = std::max(extent, box.extent());
	int crossings = 0;
	const auto triangles = map.mesh.trianglesByChart(map.charts.size());
	for (std::size_t chart = 0; chart < triangles.size(); ++chart) {
		checkpoint();
		if (!hasFlipped[chart])
			crossings += borderCrossings(map.mesh.part(triangles[chart]), kCheckedGap * extent);
	}
	if (crossings > 0)
		failCheck(
			std::to_string(crossings) +
			" crossings of the borders of charts that should not overlap");
}

} // namespace ricci
