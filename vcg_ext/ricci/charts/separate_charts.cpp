// SPDX-License-Identifier: GPL-3.0-or-later
#include "separate_charts.h"

#include "../base/task.h"
#include "../math/min_area_rectangle.h"
#include "../math/min_cut.h"
#include "../metric/area.h"
#include "chart_division.h"
#include "chart_overlap.h"
#include "dual_graph.h"
#include "join_parts.h"
#include "simple_border.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

namespace ricci {

namespace {

using Parts = std::vector<std::vector<int>>; // triangles of each

/// Divides the chart so that no part covers itself. A fold may hide an overlap and then go to another
/// part than the triangles that it hides: what appears in the parts is added to the pairs, and the
/// chart is divided anew.
Parts separateParts(const FlatMesh& chart, const Sides& sides, const OverlapSearch& overlaps)
{
	std::vector<TrianglePair> pairs = overlaps.pairs();
	for (;;) {
		Parts parts = divideChart(chart, sides, pairs);
		Array<int> partOf(chart.size());
		for (std::size_t p = 0; p < parts.size(); ++p)
			for (const int i : parts[p])
				partOf[i] = static_cast<int>(p);
		const auto more = overlaps.uncovered(partOf);
		if (more.empty())
			return parts;
		pairs.insert(pairs.end(), more.begin(), more.end());
	}
}

/// Gives new charts points of their own, and moves each to the origin; where \p turns turns it so that
/// its smallest bounding rectangle lies along the axes.
void settle(const std::vector<int>& charts, bool turns, Parametrization& map)
{
	FlatMesh& mesh = map.mesh;
	splitPoints(mesh);
	const Parts triangles = mesh.trianglesByChart(map.charts.size());
	for (const int chart : charts) {
		const std::vector<int> points = mesh.pointsOf(triangles[positionOf(chart)]);
		std::vector<Point2> places;
		Box2 box;
		for (const int p : points) {
			places.push_back(mesh.place[p]);
			box.add(places.back());
		}
		OrientedRectangle r;
		r.min = box.min;
		if (turns)
			r = minAreaRectangle(std::move(places));
		for (const int p : points)
			mesh.place[p] = r.inFrame(mesh.place[p]) - r.min;
	}
}

/// Lays the charts out in rows, so that they do not lie on each other.
void setApart(Parametrization& map)
{
	std::vector<Box2> boxes(map.charts.size());
	for (const int f : map.mesh.points.indices())
		for (const Point2& p : map.mesh.at(f))
			boxes[positionOf(map.mesh.chart[f])].add(p);
	double area = 0.0, width = 0.0;
	for (const Box2& box : boxes) {
		area += box.width() * box.height();
		width = std::max(width, box.width());
	}
	width = std::max(width, std::sqrt(area));
	std::vector<Point2> shifts;
	Point2 corner{0.0, 0.0};
	double height = 0.0; // of the row
	for (const Box2& box : boxes) {
		if (corner[0] > width) {
			corner = {0.0, corner[1] + height};
			height = 0.0;
		}
		shifts.push_back(corner - box.min);
		corner[0] += box.width();
		height = std::max(height, box.height());
	}
	const Array<int> chart = map.mesh.chartOfPoints();
	for (const int p : map.mesh.place.indices())
		if (chart[p] >= 0)
			map.mesh.place[p] += shifts[positionOf(chart[p])];
}

/// Part 1 on one side of the least cut across the middle of a chart's smallest bounding rectangle, 0 on the
/// other.
Array<int> halves(const FlatMesh& chart, const OrientedRectangle& r, const DualGraph& graph)
{
	std::vector<int> left, right;
	Array<char> end(chart.size(), 0);
	for (const int i : end.indices()) {
		double along = 0.0;
		for (const Point2& p : chart.at(i))
			along += (r.inFrame(p)[0] - r.min[0]) / (3.0 * r.width());
		if (along < 0.4)
			left.push_back(i);
		else if (along > 0.6)
			right.push_back(i);
		end[i] = along < 0.4 ? 1 : along > 0.6 ? 2 : 0;
	}
	const MinCut::Side side =
		MinCut(chart.size()).run(left, right, [&](int i, const MinCut::AddEdge& add) {
			for (const Corner own : cornersOf(i))
				if (const Corner other = graph.joined(own); other.isValid())
					if (end[i] == 0 || end[i] != end[other.face()])
						add(other.face(), graph.weight(own), graph.weight(own));
		});
	Array<int> part(chart.size(), 0);
	for (const int i : side.nodes)
		part[i] = 1;
	return part;
}

/// Puts the connected pieces of the parts of a chart in its place, the first where it was, the others
/// last.
/// \param triangles of the chart \p number of \p map
/// \param graph of that chart
/// \return the numbers of the pieces, which settle() has to be called for
std::vector<int>
divide(int number, const std::vector<int>& triangles, const DualGraph& graph, Parametrization& map)
{
	std::vector<int> charts;
	for (const std::vector<int>& piece : graph.connectedPieces()) {
		charts.push_back(charts.empty() ? number : static_cast<int>(map.charts.size()));
		if (charts.size() > 1)
			map.charts.emplace_back();
		for (const int i : piece)
			map.mesh.chart[triangles[positionOf(i)]] = charts.back();
	}
	map.charts[positionOf(number)] = {};
	map.report.charts = static_cast<int>(map.charts.size());
	return charts;
}

} // namespace

void countCuts(const Seams& before, const Sides& sides, Parametrization& map)
{
	const Seams after = seams(map.mesh, sides);
	const std::set<Corner> old(before.edges.begin(), before.edges.end());
	int cut = 0;
	for (const Corner side : after.edges)
		cut += old.count(side) == 0;
	const int joined = static_cast<int>(before.edges.size() - after.edges.size()) + cut;
	map.report.overlapCuts += cut;
	map.report.seamEdges = std::max(0, map.report.seamEdges - joined);
	map.report.seamLength += after.length - before.length;
}

void separateCharts(bool resolve, bool turns, Parametrization& map)
{
	std::vector<Chart> charts;
	std::vector<int> divided;      // numbers of the parts
	std::optional<Sides> allSides; // once there are such
	Seams before;
	const auto add = [&](const std::vector<int>& triangles, Chart chart) {
		for (const int f : triangles)
			map.mesh.chart[f] = static_cast<int>(charts.size());
		charts.push_back(std::move(chart));
	};
	const Parts byChart = map.mesh.trianglesByChart(map.charts.size());
	for (std::size_t c = 0; c < byChart.size(); ++c) {
		const std::vector<int>& triangles = byChart[c];
		FlatMesh chart = map.mesh.part(triangles);
		const Sides sides(chart.vertices.values());
		if (hasSimpleBorder(chart, sides)) {
			add(triangles, std::move(map.charts[c]));
			continue;
		}
		checkpoint();
		const OverlapSearch overlaps(chart.corners());
		checkpoint();
		const std::vector<TrianglePair>& pairs = overlaps.pairs();
		if (!pairs.empty() && !resolve) {
			Array<char> isCovered(chart.size(), 0);
			for (const TrianglePair& pair : pairs)
				for (int i : pair)
					isCovered[i] = 1;
			++map.report.overlappingCharts;
			for (char covered : isCovered)
				map.report.overlappingFaces += covered;
		}
		if (pairs.empty() || !resolve) {
			add(triangles, std::move(map.charts[c]));
			continue;
		}
		if (divided.empty()) {
			allSides.emplace(map.mesh.vertices.values());
			before = seams(map.mesh, *allSides);
		}
		Parts joined = joinParts(chart, sides, separateParts(chart, sides, overlaps));
		const int first = map.mesh.place.size();
		for (const Point2& p : chart.place)
			map.mesh.place.push_back(p);
		for (std::size_t i = 0; i < triangles.size(); ++i)
			for (std::size_t k = 0; k < 3; ++k)
				map.mesh.points[triangles[i]][k] = first + chart.points[static_cast<int>(i)][k];
		for (std::vector<int>& part : joined) {
			for (int& i : part)
				i = triangles[positionOf(i)];
			divided.push_back(static_cast<int>(charts.size()));
			add(part, {});
		}
	}
	map.charts = std::move(charts);
	map.report.charts = static_cast<int>(map.charts.size());
	if (divided.empty())
		return;
	settle(divided, turns, map);
	countCuts(before, *allSides, map);
}

void joinCharts(Parametrization& map)
{
	FlatMesh& mesh = map.mesh;
	setApart(map);
	const Sides sides(mesh.vertices.values());
	const Parts parts = joinParts(mesh, sides, mesh.trianglesByChart(map.charts.size()));
	map.charts.assign(parts.size(), {});
	std::vector<int> charts;
	for (const std::vector<int>& part : parts) {
		for (const int f : part)
			mesh.chart[f] = static_cast<int>(charts.size());
		charts.push_back(static_cast<int>(charts.size()));
	}
	map.report.charts = static_cast<int>(charts.size());
	settle(charts, true, map);
}

std::optional<Parametrization> cutForRoom(const Parametrization& map, bool turns)
{
	const Parts byChart = map.mesh.trianglesByChart(map.charts.size());
	double mostRoom = 0.0; // area in the rectangle beside the chart
	std::size_t widest = byChart.size();
	OrientedRectangle rectangle;
	for (std::size_t c = 0; c < byChart.size(); ++c) {
		std::vector<Point2> places;
		double area = 0.0;
		for (const int p : map.mesh.pointsOf(byChart[c]))
			places.push_back(map.mesh.place[p]);
		for (const int f : byChart[c]) {
			const Triangle2 p = map.mesh.at(f);
			area += 0.5 * std::abs(doubledArea(p[0], p[1], p[2]));
		}
		const OrientedRectangle r = minAreaRectangle(std::move(places));
		// Beside a strip there is room in the square, too.
		const double room = r.width() * std::max(r.height(), 0.5 * r.width()) - area;
		if (room > mostRoom) {
			mostRoom = room;
			widest = c;
			rectangle = r;
		}
	}
	if (widest == byChart.size())
		return std::nullopt;
	const FlatMesh chart = map.mesh.part(byChart[widest]);
	const Sides sides(chart.vertices.values());
	DualGraph graph(chart, sides);
	graph.part = halves(chart, rectangle, graph);
	const auto areaOf = [&](const std::vector<int>& triangles) {
		double area = 0.0;
		for (const int i : triangles)
			area += euclideanArea(chart.lengths[i]);
		return area;
	};
	double least = 0.0, whole = 0.0; // of the pieces
	for (const std::vector<int>& piece : graph.connectedPieces()) {
		const double area = areaOf(piece);
		least = whole == 0.0 ? area : std::min(least, area);
		whole += area;
	}
	if (least < kCrumb * whole)
		return std::nullopt;
	Parametrization cut = map;
	const Sides allSides(map.mesh.vertices.values());
	const Seams before = seams(map.mesh, allSides);
	settle(divide(static_cast<int>(widest), byChart[widest], graph, cut), turns, cut);
	countCuts(before, allSides, cut);
	return cut;
}

bool cutOff(const std::vector<char>& isOff, Parametrization& map)
{
	std::vector<int> divided;
	const Parts byChart = map.mesh.trianglesByChart(map.charts.size());
	for (std::size_t c = 0; c < byChart.size(); ++c) {
		const std::vector<int>& triangles = byChart[c];
		const auto off = std::count_if(
			triangles.begin(), triangles.end(), [&](int f) { return isOff[positionOf(f)] != 0; });
		if (off == 0 || off == static_cast<std::ptrdiff_t>(triangles.size()))
			continue;
		const FlatMesh chart = map.mesh.part(triangles);
		const Sides sides(chart.vertices.values());
		DualGraph graph(chart, sides);
		for (const int i : graph.part.indices())
			graph.part[i] = isOff[positionOf(triangles[positionOf(i)])] != 0 ? 1 : 0;
		for (const int piece : divide(static_cast<int>(c), triangles, graph, map))
			divided.push_back(piece);
	}
	if (divided.empty())
		return false;
	const Sides sides(map.mesh.vertices.values());
	const Seams before = seams(map.mesh, sides);
	settle(divided, false, map);
	countCuts(before, sides, map);
	return true;
}

} // namespace ricci
