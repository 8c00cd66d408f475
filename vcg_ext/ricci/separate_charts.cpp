// SPDX-License-Identifier: GPL-3.0-or-later
#include "separate_charts.h"

#include "layout/chart_overlap.h"
#include "layout/least_rectangle.h"
#include "numbers.h"

#include <utility>

namespace ricci {

namespace {

/// The output's triangles of one chart, in the order of their component.
struct OutputChart
{
	DrawnChart drawn;
	std::vector<std::array<double, 3>> edgeLength;

	OutputChart(const SurfaceMesh& mesh, const Parametrization& map, const Chart& chart)
	{
		const bool refined = !map.refined.triangles.empty();
		for (int f : refined ? chart.refined : chart.faces) {
			Triangle t = refined ? map.refined.triangles[at(f)] : mesh.triangles[at(f)];
			auto plane = refined ? map.refined.uv[at(f)] : map.uv[at(f)];
			if (map.reversed[refined ? at(map.refined.inputFace[at(f)]) : at(f)]) {
				std::swap(t[1], t[2]);
				std::swap(plane[1], plane[2]);
			}
			std::array<Point3, 3> place;
			for (std::size_t k = 0; k < 3; ++k)
				place[k] = refined ? placeOnSurface(map.refined.points[at(t[k])], mesh.positions)
								   : mesh.positions[at(t[k])];
			drawn.triangles.push_back(t);
			drawn.plane.push_back(plane);
			edgeLength.push_back(
				{distance(place[0], place[1]),
				 distance(place[1], place[2]),
				 distance(place[2], place[0])});
		}
	}
};

/// Moves a part of a chart so that its least bounding rectangle lies along the axes, from the
/// origin.
void turnUpright(Parametrization& map, const Chart& chart)
{
	const bool refined = !map.refined.triangles.empty();
	std::vector<Point2> points;
	for (int f : refined ? chart.refined : chart.faces)
		for (const Point2& p : refined ? map.refined.uv[at(f)] : map.uv[at(f)])
			points.push_back(p);
	const OrientedRectangle r = leastRectangle(std::move(points));
	const auto move = [&](std::array<Point2, 3>& corners) {
		for (Point2& p : corners) {
			const Point2 q = r.inFrame(p);
			p = {q[0] - r.low[0], q[1] - r.low[1]};
		}
	};
	for (int f : chart.faces)
		move(map.uv[at(f)]);
	for (int f : chart.refined)
		move(map.refined.uv[at(f)]);
}

/// The chart of each part: its output triangles, and the input's faces whose first piece is there.
std::vector<Chart> chartsOf(
	const Parametrization& map,
	const Chart& whole,
	const std::vector<std::vector<int>>& parts,
	std::vector<char>& faceDone)
{
	const bool refined = !map.refined.triangles.empty();
	std::vector<Chart> charts(parts.size());
	std::vector<std::size_t> partOf(refined ? whole.refined.size() : whole.faces.size());
	for (std::size_t p = 0; p < parts.size(); ++p)
		for (int i : parts[p])
			partOf[at(i)] = p;
	for (std::size_t i = 0; i < partOf.size(); ++i) {
		Chart& chart = charts[partOf[i]];
		int f = refined ? whole.refined[i] : whole.faces[i];
		if (refined) {
			chart.refined.push_back(f);
			f = map.refined.inputFace[at(f)];
		}
		if (!faceDone[at(f)])
			chart.faces.push_back(f);
		faceDone[at(f)] = 1;
	}
	return charts;
}

} // namespace

void separateCharts(
	const SurfaceMesh& mesh, bool resolve, const std::function<void()>& tick, Parametrization& map)
{
	std::vector<Chart> charts;
	std::vector<char> faceDone(mesh.triangles.size(), 0);
	for (Chart& chart : map.charts) {
		const OutputChart output(mesh, map, chart);
		const auto pairs = overlappingPairs(output.drawn, tick);
		if (!pairs.empty() && !resolve) {
			std::vector<char> meets(output.drawn.triangles.size(), 0);
			for (const auto& pair : pairs)
				for (int i : pair)
					meets[at(i)] = 1;
			++map.report.overlappingCharts;
			for (char m : meets)
				map.report.overlappingFaces += m;
		}
		if (pairs.empty() || !resolve) {
			charts.push_back(std::move(chart));
			continue;
		}
		ChartCuts cuts;
		const auto parts = divideChart(output.drawn, pairs, output.edgeLength, cuts);
		map.report.overlapCuts += cuts.edges;
		map.report.seamLength += cuts.length;
		for (Chart& part : chartsOf(map, chart, parts, faceDone)) {
			turnUpright(map, part);
			charts.push_back(std::move(part));
		}
	}
	map.charts = std::move(charts);
	map.report.charts = static_cast<int>(map.charts.size());
}

} // namespace ricci
