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

void requireMap(const OutputTriangles& output, const FlowResult& flow, bool bent)
{
	const double tolerance = kCheckedGap + openCurvature(flow);
	const MapCheck check = checkMap(output.triangles, output.plane, output.reversed, tolerance);
	if (!check.finite || !(check.seamGap <= tolerance) || (check.turned > 0 && !bent))
		failCheck(
			"seams " + numberText(check.seamGap, 3) + " of the chart apart, " +
			std::to_string(check.turned) + " faces turned round");
}

void requireDisk(
	const OutputTriangles& output,
	const PlanarLayout& layout,
	const FlowResult& flow,
	bool bent)
{
	// The gap that an open angle leaves grows like sinh of the distance across the layout.
	double radius = 0.0;
	bool finite = true;
	for (const Point2& p : layout.points) {
		const double r = std::hypot(p[0], p[1]);
		finite = finite && std::isfinite(r);
		radius = std::max(radius, 2.0 * std::atanh(std::min(1.0, r)));
	}
	const double tolerance = kCheckedGap + openCurvature(flow) * std::sinh(2.0 * radius);
	const DiskCheck check =
		checkDisk(output.triangles, output.plane, output.reversed, tolerance);
	if (check.outside > 0 && finite) // the doubles of the disk end at a distance of about 37
		throw NotConverged(NotConverged::OutsideDisk, check.outside);
	if (check.outside > 0)
		failCheck(std::to_string(check.outside) + " points lie outside the disk");
	if (!(check.seamGap <= tolerance) || (check.turned > 0 && !bent))
		failCheck(
			"seams " + numberText(check.seamGap, 3) + " apart in the disk, " +
			std::to_string(check.turned) + " faces turned round");
}

namespace {

double extentOf(const std::vector<int>& triangles, const std::vector<Triangle2>& uv)
{
	Box2 box;
	for (const int i : triangles)
		for (const Point2& p : uv[positionOf(i)])
			box.add(p);
	return box.extent();
}

} // namespace

void requireSeparateCharts(const SurfaceMesh& mesh, const Parametrization& map)
{
	const bool refined = map.isRefined();
	const std::vector<Triangle>& all = refined ? map.refined.triangles : mesh.triangles;
	const std::vector<Triangle2>& uv = refined ? map.refined.uv : map.uv;
	std::vector<const std::vector<int>*> parts;
	int crossings = 0;
	// Charts are drawn beside each other on one scale.
	double extent = 0.0;
	for (const Chart& chart : map.charts)
		extent = std::max(extent, extentOf(refined ? chart.refined : chart.faces, uv));
	for (const Chart& chart : map.charts) {
		parts.push_back(refined ? &chart.refined : &chart.faces);
		checkpoint();
		std::vector<Triangle> triangles;
		std::vector<Triangle2> plane;
		bool turned = false;
		for (const int i : *parts.back()) {
			const std::size_t f = positionOf(i);
			const std::size_t input = refined ? positionOf(map.refined.inputFace[f]) : f;
			const Triangle2& p = uv[f];
			const int wanted = map.reversed[input] ? -1 : 1;
			turned = turned || orientation(p[0], p[1], p[2]) != wanted;
			triangles.push_back(all[f]);
			plane.push_back(p);
		}
		if (!turned)
			crossings += borderCrossings(triangles, plane, kCheckedGap * extent);
	}
	if (crossings > 0 || !isPartition(parts, all.size()))
		failCheck(
			std::to_string(crossings) +
			" crossings of the borders of charts that should not overlap");
}

} // namespace ricci
