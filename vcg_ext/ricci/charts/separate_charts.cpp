// SPDX-License-Identifier: GPL-3.0-or-later
#include "separate_charts.h"

#include "../base/task.h"
#include "../math/min_area_rectangle.h"
#include "../math/min_cut.h"
#include "../measure/distortion.h"
#include "chart_division.h"
#include "chart_overlap.h"
#include "chart_sides.h"
#include "join_parts.h"
#include "part_graph.h"
#include "simple_border.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace ricci {

namespace {

/// Numbers of the output's triangles in a chart.
const std::vector<int>& trianglesOf(const Parametrization& map, const Chart& chart)
{
	return map.isRefined() ? chart.refined : chart.faces;
}

/// A face's or triangle's corners, with two of them swapped if it is reversed: then those that are
/// counter-clockwise in the plane are properly oriented.
template<class Corners>
Corners inOrder(const Parametrization& map, int triangle, Corners corners)
{
	const std::size_t i = positionOf(triangle);
	if (map.reversed[map.isRefined() ? positionOf(map.refined.inputFace[i]) : i])
		std::swap(corners[1], corners[2]);
	return corners;
}

std::vector<Triangle2>& planeOf(Parametrization& map)
{
	return map.isRefined() ? map.refined.uv : map.uv;
}

const std::vector<Triangle2>& planeOf(const Parametrization& map)
{
	return map.isRefined() ? map.refined.uv : map.uv;
}

/// The output's triangles of one chart, in the order of their component.
DrawnChart drawnChart(const SurfaceMesh& mesh, const Parametrization& map, const Chart& chart)
{
	const std::vector<Triangle>& all = map.isRefined() ? map.refined.triangles : mesh.triangles;
	DrawnChart drawn;
	const std::vector<int>& triangles = trianglesOf(map, chart);
	drawn.triangles.reserve(triangles.size());
	drawn.plane.reserve(triangles.size());
	for (const int f : triangles) {
		drawn.triangles.push_back(inOrder(map, f, all[positionOf(f)]));
		drawn.plane.push_back(inOrder(map, f, planeOf(map)[positionOf(f)]));
	}
	return drawn;
}

/// The lengths of its sides in space.
Array<std::array<double, 3>>
lengthsOf(const SurfaceMesh& mesh, const Parametrization& map, const DrawnChart& drawn)
{
	const auto place = [&](int point) {
		const std::size_t v = positionOf(point);
		return map.isRefined() ? placeOnSurface(map.refined.points[v], mesh.positions)
							   : mesh.positions[v];
	};
	Array<std::array<double, 3>> lengths;
	lengths.reserve(drawn.triangles.size());
	for (const Triangle& t : drawn.triangles) {
		const std::array<Point3, 3> p{place(t[0]), place(t[1]), place(t[2])};
		lengths.push_back({distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])});
	}
	return lengths;
}

/// [triangle] the number of its part.
Array<int> numbersOf(const std::vector<std::vector<int>>& parts, int triangleCount)
{
	Array<int> part(triangleCount);
	for (std::size_t p = 0; p < parts.size(); ++p)
		for (const int i : parts[p])
			part[i] = static_cast<int>(p);
	return part;
}

/// Divides the chart so that no part covers itself. A fold may hide an overlap and then go to another
/// part than the triangles that it hides: what appears in the parts is added to the pairs, and the
/// chart is divided anew.
std::vector<std::vector<int>> separateParts(
	const DrawnChart& chart,
	const ChartSides& sides,
	const OverlapSearch& overlaps,
	ChartCuts& cuts)
{
	std::vector<TrianglePair> pairs = overlaps.pairs();
	for (;;) {
		std::vector<std::vector<int>> parts = divideChart(chart, pairs, sides, cuts);
		const auto more = overlaps.uncovered(numbersOf(parts, chart.triangles.size()));
		if (more.empty())
			return parts;
		pairs.insert(pairs.end(), more.begin(), more.end());
	}
}

/// Joins the parts of a chart across seams where they have room there, and moves them in \p map.
std::vector<std::vector<int>> join(
	DrawnChart& drawn,
	const ChartSides& sides,
	const BoxTree& tree,
	const Chart& whole,
	const std::vector<std::vector<int>>& parts,
	Parametrization& map)
{
	JoinedParts joined = joinParts(drawn, sides, tree, parts);
	map.report.overlapCuts += joined.seams.edges;
	map.report.seamLength += joined.seams.length;
	const std::vector<int>& triangles = trianglesOf(map, whole);
	std::vector<char> faceDone(map.isRefined() ? map.uv.size() : 0, 0);
	for (const int i : joined.motion.indices()) {
		const int f = triangles[positionOf(i)];
		planeOf(map)[positionOf(f)] = inOrder(map, f, drawn.plane[i]);
		if (!map.isRefined())
			continue;
		const std::size_t face = positionOf(map.refined.inputFace[positionOf(f)]);
		if (!faceDone[face])
			map.uv[face] = joined.motion[i](map.uv[face]);
		faceDone[face] = 1;
	}
	return std::move(joined.parts);
}

/// Moves a part of a chart to the origin, and where \p turns turns it so that its smallest bounding
/// rectangle lies along the axes.
void place(Parametrization& map, const Chart& chart, bool turns)
{
	std::vector<Point2> points;
	for (int f : trianglesOf(map, chart))
		for (const Point2& p :
			 map.isRefined() ? map.refined.uv[positionOf(f)] : map.uv[positionOf(f)])
			points.push_back(p);
	OrientedRectangle r;
	if (turns)
		r = minAreaRectangle(std::move(points));
	else {
		Box2 box;
		for (const Point2& p : points)
			box.add(p);
		r.min = box.min;
	}
	const auto move = [&](Triangle2& corners) {
		for (Point2& p : corners) {
			const Point2 q = r.inFrame(p);
			p = {q[0] - r.min[0], q[1] - r.min[1]};
		}
	};
	for (int f : chart.faces)
		move(map.uv[positionOf(f)]);
	for (int f : chart.refined)
		move(map.refined.uv[positionOf(f)]);
}

/// The chart of each part: its output triangles, and the input's faces whose first piece is there.
/// \p faceDone: [face] 1 if it is in a chart already.
std::vector<Chart> chartsOf(
	const Parametrization& map,
	const Chart& whole,
	const std::vector<std::vector<int>>& parts,
	std::vector<char>& faceDone)
{
	const std::vector<int>& triangles = trianglesOf(map, whole);
	const Array<int> partOf = numbersOf(parts, static_cast<int>(triangles.size()));
	std::vector<Chart> charts(parts.size());
	for (const int i : partOf.indices()) {
		Chart& chart = charts[positionOf(partOf[i])];
		int f = triangles[positionOf(i)];
		if (map.isRefined()) {
			chart.refined.push_back(f);
			f = map.refined.inputFace[positionOf(f)];
		}
		if (!faceDone[positionOf(f)])
			chart.faces.push_back(f);
		faceDone[positionOf(f)] = 1;
	}
	return charts;
}

/// The area of the plane that a chart covers.
double areaOf(const Parametrization& map, const Chart& chart)
{
	double doubled = 0.0;
	for (const int f : trianglesOf(map, chart)) {
		const Triangle2& t = planeOf(map)[positionOf(f)];
		doubled += std::abs(doubledArea(t[0], t[1], t[2]));
	}
	return 0.5 * doubled;
}

/// Part 1 on one side of the least cut across a chart, 0 on the other; empty for a chart that is no
/// strip.
Array<int> halves(const DrawnChart& drawn, const PartGraph& graph)
{
	std::vector<Point2> points;
	for (const Triangle2& triangle : drawn.plane)
		points.insert(points.end(), triangle.begin(), triangle.end());
	const OrientedRectangle r = minAreaRectangle(std::move(points));
	if (!(r.width() > kStripLength * r.height()))
		return {};
	std::vector<int> left, right;
	Array<char> end(drawn.plane.size(), 0);
	for (const int i : drawn.plane.indices()) {
		double along = 0.0;
		for (const Point2& p : drawn.plane[i])
			along += (r.inFrame(p)[0] - r.min[0]) / (3.0 * r.width());
		if (along < 0.4)
			left.push_back(i);
		else if (along > 0.6)
			right.push_back(i);
		end[i] = along < 0.4 ? 1 : along > 0.6 ? 2 : 0;
	}
	const MinCut::Side side =
		MinCut(drawn.plane.size())
			.run(
				left,
				right,
				[&](int i, const MinCut::AddEdge& add) {
					for (int own = 3 * i; own < 3 * i + 3; ++own)
						if (const int other = graph.joined(own); other >= 0)
							if (end[i] == 0 || end[i] != end[other / 3])
								add(other / 3, graph.weight(own), graph.weight(own));
				});
	Array<int> part(drawn.plane.size(), 0);
	for (const int i : side.nodes)
		part[i] = 1;
	return part;
}

/// The connected parts of a division.
std::vector<std::vector<int>> connectedParts(const PartGraph& graph)
{
	Array<char> isDone(graph.part.size(), 0);
	std::vector<std::vector<int>> parts;
	for (const int first : graph.part.indices()) {
		if (isDone[first])
			continue;
		isDone[first] = 1;
		std::vector<int> part{first};
		for (std::size_t head = 0; head < part.size(); ++head)
			for (int side = 3 * part[head]; side < 3 * part[head] + 3; ++side)
				if (const int other = graph.neighbour(side); other >= 0 && !isDone[other / 3]) {
					isDone[other / 3] = 1;
					part.push_back(other / 3);
				}
		std::sort(part.begin(), part.end());
		parts.push_back(std::move(part));
	}
	return parts;
}

/// Puts the connected parts of a chart in its place, the first where it was, the others last; the report
/// counts the sides between them.
void divide(
	std::size_t number,
	const PartGraph& graph,
	const ChartSides& sides,
	bool turns,
	Parametrization& map)
{
	const SurfaceMesh& mesh = map.opened.mesh;
	double length = 0.0;
	for (const int side : sides.across.indices())
		if (const int other = graph.joined(side);
			other > side && graph.part[other / 3] != graph.part[side / 3]) {
			++map.report.overlapCuts;
			length += sides.lengthOf(side);
		}
	map.report.seamLength += length;
	map.report.seamLengthRelative +=
		length / std::sqrt(surfaceArea(mesh.positions, mesh.triangles));
	std::vector<char> faceDone(mesh.triangles.size(), 1); // by other charts
	for (const int f : map.charts[number].faces)
		faceDone[positionOf(f)] = 0;
	std::vector<Chart> charts = chartsOf(map, map.charts[number], connectedParts(graph), faceDone);
	for (const Chart& chart : charts)
		place(map, chart, turns);
	map.charts[number] = std::move(charts.front());
	std::move(charts.begin() + 1, charts.end(), std::back_inserter(map.charts));
	map.report.charts = static_cast<int>(map.charts.size());
}

} // namespace

void separateCharts(
	const SurfaceMesh& mesh, bool resolve, bool turns, Parametrization& map)
{
	std::vector<Chart> charts;
	std::vector<char> faceDone(mesh.triangles.size(), 0);
	for (Chart& chart : map.charts) {
		DrawnChart drawn = drawnChart(mesh, map, chart);
		Array<int> across = sidesAcross(drawn);
		if (hasSimpleBorder(drawn, across)) {
			charts.push_back(std::move(chart));
			continue;
		}
		checkpoint();
		const OverlapSearch overlaps(drawn);
		checkpoint();
		const std::vector<TrianglePair>& pairs = overlaps.pairs();
		if (!pairs.empty() && !resolve) {
			Array<char> isCovered(drawn.triangles.size(), 0);
			for (const TrianglePair& pair : pairs)
				for (int i : pair)
					isCovered[i] = 1;
			++map.report.overlappingCharts;
			for (char c : isCovered)
				map.report.overlappingFaces += c;
		}
		if (pairs.empty() || !resolve) {
			charts.push_back(std::move(chart));
			continue;
		}
		const ChartSides sides{std::move(across), lengthsOf(mesh, map, drawn)};
		ChartCuts cuts;
		auto parts = separateParts(drawn, sides, overlaps, cuts);
		parts = join(drawn, sides, overlaps.tree(), chart, parts, map);
		map.report.overlapCuts += cuts.edges;
		map.report.seamLength += cuts.length;
		for (Chart& part : chartsOf(map, chart, parts, faceDone)) {
			place(map, part, turns);
			charts.push_back(std::move(part));
		}
	}
	map.charts = std::move(charts);
	map.report.charts = static_cast<int>(map.charts.size());
}

std::optional<Parametrization> cutStrip(const Parametrization& map, bool turns)
{
	if (map.charts.empty())
		return std::nullopt;
	const SurfaceMesh& mesh = map.opened.mesh;
	std::vector<double> area;
	for (const Chart& chart : map.charts)
		area.push_back(areaOf(map, chart));
	const auto largest =
		static_cast<std::size_t>(std::max_element(area.begin(), area.end()) - area.begin());
	const Chart& whole = map.charts[largest];
	const DrawnChart drawn = drawnChart(mesh, map, whole);
	Array<int> across = sidesAcross(drawn);
	const ChartSides sides{std::move(across), lengthsOf(mesh, map, drawn)};
	PartGraph graph(drawn, sides);
	Array<int> part = halves(drawn, graph);
	if (part.empty())
		return std::nullopt;
	graph.part = std::move(part);
	if (connectedParts(graph).size() != 2)
		return std::nullopt;
	Parametrization cut = map;
	divide(largest, graph, sides, turns, cut);
	return cut;
}

bool cutOff(const std::vector<char>& isOff, Parametrization& map)
{
	const std::size_t charts = map.charts.size();
	for (std::size_t c = 0; c < charts; ++c) {
		const std::vector<int>& triangles = trianglesOf(map, map.charts[c]);
		const auto off = std::count_if(
			triangles.begin(), triangles.end(), [&](int f) { return isOff[positionOf(f)] != 0; });
		if (off == 0 || off == static_cast<std::ptrdiff_t>(triangles.size()))
			continue;
		const SurfaceMesh& mesh = map.opened.mesh;
		const DrawnChart drawn = drawnChart(mesh, map, map.charts[c]);
		Array<int> across = sidesAcross(drawn);
		const ChartSides sides{std::move(across), lengthsOf(mesh, map, drawn)};
		PartGraph graph(drawn, sides);
		for (const int i : graph.part.indices())
			graph.part[i] = isOff[positionOf(triangles[positionOf(i)])] != 0 ? 1 : 0;
		divide(c, graph, sides, false, map);
	}
	return map.charts.size() > charts;
}

} // namespace ricci
