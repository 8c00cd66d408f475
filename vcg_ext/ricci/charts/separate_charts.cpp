// SPDX-License-Identifier: GPL-3.0-or-later
#include "separate_charts.h"

#include "../base/convex_hull.h"
#include "../base/graphs.h"
#include "../base/points.h"
#include "../base/task.h"
#include "../metric/area.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <set>
#include <utility>

namespace ricci {

namespace {

/// Moves each of the charts, which have points of their own, to the origin; where \p turns turns it so that
/// its smallest bounding rectangle lies along the axes.
void settle(const std::vector<int>& charts, bool turns, Parametrization& map)
{
	FlatMesh& mesh = map.mesh;
	const std::vector<std::vector<int>> pointsOf = mesh.pointsByChart(map.charts.size());
	for (const int chart : charts) {
		const std::vector<int>& points = pointsOf[positionOf(chart)];
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

/// Gives each connected set of flipped triangles points of their own, and lays it reflected to the right of
/// all others: there it covers nothing but itself.
/// \return whether there are any
bool reflectFlipped(FlatMesh& chart)
{
	const auto isFlipped = [&](int f) { return orientation(chart.at(f)) < 0; };
	for (const int f : chart.points.indices())
		chart.chart[f] = isFlipped(f);
	if (std::find(chart.chart.begin(), chart.chart.end(), 1) == chart.chart.end())
		return false;
	splitPoints(chart);
	DisjointSets sets(chart.place.size());
	for (const Triangle& t : chart.points)
		for (const int p : t)
			sets.merge(t[0], p);
	Array<Box2> boxes(chart.place.size());
	Box2 upright;
	for (const int f : chart.points.indices())
		for (const Point2& p : chart.at(f))
			(chart.chart[f] > 0 ? boxes[sets.find(chart.points[f][0])] : upright).add(p);
	double right = upright.width() > 0.0 ? upright.max[0] : 0.0;
	Array<double> axis(chart.place.size(), 0.0); // [set] doubled
	for (const int p : chart.place.indices())
		if (boxes[p].width() > 0.0) {
			axis[p] = right + boxes[p].max[0];
			right += boxes[p].width();
		}
	const Array<int> isReflected = chart.chartOfPoints();
	for (const int p : chart.place.indices())
		if (isReflected[p] > 0)
			chart.place[p][0] = axis[sets.find(p)] - chart.place[p][0];
	return true;
}

/// Triangles across the band in which a cut is looked for. A wider one would hardly have a shorter cut.
constexpr double kBand = 50.0;

/// The pieces of a chart that is not connected; else the least cut across its smallest bounding rectangle, in a band.
/// Its length is weighed by the square that holds the longer part: an edge at the end of the rectangle costs four times
/// as much as one in the middle. Crumbs go to the other part.
/// \param triangles of the chart
/// \param middle, width where the band is, and how wide to either side, as shares of the rectangle's length from its
/// middle: there edges cost least
/// \param crumb share of the chart that is no part
/// \return none where such a crumb is left, or nothing is cut
std::optional<ChartCut> halves(
	const FlatMesh& mesh,
	const std::vector<int>& triangles,
	const OrientedRectangle& r,
	double middle,
	double width,
	double crumb)
{
	DualGraph graph(mesh);
	ChartCut cut{graph.connectedPieces(triangles)};
	if (cut.pieces.size() > 1)
		return cut;
	// From the middle of the band, along the rectangle: 0 for a triangle that reaches across.
	std::vector<double> along;
	for (const int i : triangles) {
		double first = 0.5, last = -0.5;
		for (const Point2& p : mesh.at(i)) {
			const double at = (r.inFrame(p)[0] - r.min[0]) / r.width() - 0.5 - middle;
			first = std::min(first, at);
			last = std::max(last, at);
		}
		along.push_back(std::max(first, 0.0) + std::min(last, 0.0));
	}
	graph.price.assign(mesh.size(), 1.0);
	for (std::size_t i = 0; i < triangles.size(); ++i)
		graph.price[triangles[i]] = std::pow(1.0 + 2.0 * std::abs(along[i]), 2);
	std::vector<double> apart;
	apart.reserve(along.size());
	for (const double at : along)
		apart.push_back(std::abs(at));
	const auto count = static_cast<double>(apart.size());
	const auto end = apart.begin() +
					 static_cast<std::ptrdiff_t>(std::min(count - 1.0, kBand * std::sqrt(count)));
	std::nth_element(apart.begin(), end, apart.end());
	width = std::min(width, *end);
	std::vector<int> left, right;
	for (std::size_t i = 0; i < triangles.size(); ++i)
		if (std::abs(along[i]) > width)
			(along[i] < 0.0 ? left : right).push_back(triangles[i]);
	graph.part = leastCut(graph, left, right);
	const auto areasOf = [&](const Parts& pieces) {
		std::vector<double> areas;
		for (const std::vector<int>& piece : pieces) {
			areas.push_back(0.0);
			for (const int i : piece)
				areas.back() += euclideanArea(mesh.lengths[i]);
		}
		return areas;
	};
	cut.pieces = graph.connectedPieces(triangles);
	std::vector<double> areas = areasOf(cut.pieces);
	const double least = crumb * std::accumulate(areas.begin(), areas.end(), 0.0);
	const auto isCrumb = [&](double area) { return area < least; };
	if (std::any_of(areas.begin(), areas.end(), isCrumb)) {
		for (std::size_t p = 0; p < areas.size(); ++p)
			if (isCrumb(areas[p]))
				for (const int i : cut.pieces[p])
					graph.part[i] = 1 - graph.part[i];
		cut.pieces = graph.connectedPieces(triangles);
		areas = areasOf(cut.pieces);
	}
	if (cut.pieces.size() < 2 || std::any_of(areas.begin(), areas.end(), isCrumb))
		return std::nullopt;
	for (const int f : triangles)
		for (const Corner own : cornersOf(f))
			if (const Corner other = graph.part[f] > 0 ? graph.joined(own) : Corner();
				other.isValid() && graph.part[other.face()] == 0) {
				++cut.edges;
				cut.length += mesh.lengths[own];
			}
	return cut;
}

std::optional<ChartCut>
acrossRectangle(const FlatMesh& mesh, const std::vector<int>& triangles, const OrientedRectangle& r)
{
	std::optional<ChartCut> cut;
	for (const double from : kCutFrom)
		if (!cut)
			cut = halves(mesh, triangles, r, 0.0, 0.5 - from, kCrumb);
	return cut;
}

/// Puts pieces of the chart \p number in its place, the first where it was, the others last.
/// \return the numbers of the pieces, which need points of their own, and settle()
std::vector<int> divide(int number, const Parts& pieces, Parametrization& map)
{
	Chart unplaced;
	unplaced.isMirrored = map.charts[positionOf(number)].isMirrored;
	map.charts[positionOf(number)] = unplaced;
	std::vector<int> charts;
	for (const std::vector<int>& piece : pieces) {
		charts.push_back(charts.empty() ? number : static_cast<int>(map.charts.size()));
		if (charts.size() > 1)
			map.charts.push_back(unplaced);
		for (const int i : piece)
			map.mesh.chart[i] = charts.back();
	}
	return charts;
}

} // namespace

void countCuts(const EdgeSet& before, Parametrization& map)
{
	const EdgeSet after = seams(map.mesh);
	const std::set<Corner> old(before.sides.begin(), before.sides.end());
	int cut = 0;
	for (const Corner side : after.sides)
		cut += old.count(side) == 0;
	const int joined = static_cast<int>(before.sides.size() - after.sides.size()) + cut;
	map.report.overlapCuts += cut;
	map.report.seamEdges = std::max(0, map.report.seamEdges - joined);
	map.report.seamLength += after.length - before.length;
}

void separateCharts(bool turns, bool reflects, Parametrization& map)
{
	std::vector<Chart> charts;
	std::vector<int> divided; // numbers of the parts
	EdgeSet before;           // once there are parts
	const auto add = [&](const std::vector<int>& triangles, Chart chart) {
		for (const int f : triangles)
			map.mesh.chart[f] = static_cast<int>(charts.size());
		charts.push_back(std::move(chart));
	};
	const Parts byChart = map.mesh.trianglesByChart(map.charts.size());
	for (std::size_t c = 0; c < byChart.size(); ++c) {
		const std::vector<int>& triangles = byChart[c];
		checkpoint();
		FlatMesh chart = map.mesh.part(triangles);
		const bool isReflected = reflects && reflectFlipped(chart);
		const OverlapSearch overlaps(chart);
		checkpoint();
		if (!isReflected && overlaps.pairs().empty()) {
			add(triangles, std::move(map.charts[c]));
			continue;
		}
		if (divided.empty())
			before = seams(map.mesh);
		Parts joined = joinParts(chart, divideChart(chart, overlaps));
		const int first = map.mesh.place.size();
		map.mesh.place.append(std::move(chart.place));
		for (std::size_t i = 0; i < triangles.size(); ++i)
			for (std::size_t k = 0; k < 3; ++k)
				map.mesh.points[triangles[i]][k] = first + chart.points[static_cast<int>(i)][k];
		for (std::vector<int>& part : joined) {
			for (int& i : part)
				i = triangles[positionOf(i)];
			divided.push_back(static_cast<int>(charts.size()));
			add(part, {});
			charts.back().isMirrored = map.charts[c].isMirrored;
		}
	}
	map.charts = std::move(charts);
	if (divided.empty())
		return;
	splitPoints(map.mesh);
	settle(divided, turns, map);
	countCuts(before, map);
}

void joinCharts(Parametrization& map)
{
	FlatMesh& mesh = map.mesh;
	const Parts parts = joinParts(mesh, mesh.trianglesByChart(map.charts.size()));
	map.charts.assign(parts.size(), {});
	std::vector<int> charts;
	for (const std::vector<int>& part : parts) {
		for (const int f : part)
			mesh.chart[f] = static_cast<int>(charts.size());
		charts.push_back(static_cast<int>(charts.size()));
	}
	splitPoints(mesh);
	settle(charts, true, map);
}

std::optional<ChartCut>
findCutToFit(const FlatMesh& mesh, const std::vector<int>& triangles, double longest)
{
	std::vector<Point2> places;
	for (const int f : triangles)
		for (const Point2& p : mesh.at(f))
			places.push_back(p);
	const OrientedRectangle r = minAreaRectangle(std::move(places));
	// Of one part more where there is no room for a cut along edges.
	const double width = r.width(),
				 edge = std::sqrt(width * r.height() / static_cast<double>(triangles.size())),
				 parts = std::ceil((width + edge) / longest), left = std::floor(0.5 * parts);
	const double last = left * longest / width, first = 1.0 - (parts - left) * longest / width;
	const double middle = 0.5 * (first + last) - 0.5, half = 0.5 * (last - first);
	std::optional<ChartCut> cut = halves(mesh, triangles, r, middle, half, kCrumb);
	if (!cut)
		cut = acrossRectangle(mesh, triangles, r);
	return cut ? cut : halves(mesh, triangles, r, middle, half, 0.0);
}

std::optional<ChartCut> findCutForPacking(const Parametrization& map, double onSurface)
{
	struct Wide
	{
		double room; ///< area beside the chart in its rectangle
		double area;
		std::size_t chart;
		OrientedRectangle rectangle;
	};
	const Parts byChart = map.mesh.trianglesByChart(map.charts.size());
	const std::vector<std::vector<int>> pointsOf = map.mesh.pointsByChart(byChart.size());
	std::vector<Wide> byRoom;
	double total = 0.0; // area
	for (std::size_t c = 0; c < byChart.size(); ++c) {
		std::vector<Point2> places;
		double area = 0.0;
		for (const int p : pointsOf[c])
			places.push_back(map.mesh.place[p]);
		for (const int f : byChart[c])
			area += 0.5 * std::abs(doubledArea(map.mesh.at(f)));
		total += area;
		const OrientedRectangle r = minAreaRectangle(std::move(places));
		// Beside a strip there is room in the square, too.
		byRoom.push_back({r.width() * std::max(r.height(), 0.5 * r.width()) - area, area, c, r});
	}
	const double square = total / map.report.occupancy;
	std::stable_sort(
		byRoom.begin(), byRoom.end(), [](const Wide& a, const Wide& b) { return a.room > b.room; });
	for (const Wide& wide : byRoom) {
		if (wide.room < kRoomOfChart * square)
			return std::nullopt;
		const std::vector<int>& triangles = byChart[wide.chart];
		std::optional<ChartCut> cut = acrossRectangle(map.mesh, triangles, wide.rectangle);
		// The square loses all that is beside the chart in a square round it at most.
		const double width = wide.rectangle.width();
		const double most = std::log(square / std::max(square - width * width + wide.area, total));
		if (cut &&
			most >= kPackingPrice *
						std::log1p(cut->length / (std::sqrt(onSurface) + map.report.seamLength))) {
			cut->chart = static_cast<int>(wide.chart);
			return cut;
		}
	}
	return std::nullopt;
}

void cutChart(const ChartCut& cut, bool turns, Parametrization& map)
{
	const std::vector<int> parts = divide(cut.chart, cut.pieces, map);
	splitPoints(map.mesh);
	settle(parts, turns, map);
	map.report.overlapCuts += cut.edges;
	map.report.seamLength += cut.length;
}

void cutOff(const std::vector<int>& triangles, Parametrization& map)
{
	DualGraph graph(map.mesh);
	std::set<int> charts;
	int off = 0;
	for (const int f : triangles) {
		graph.part[f] = ++off;
		charts.insert(map.mesh.chart[f]);
	}
	const EdgeSet before = seams(map.mesh);
	std::vector<int> divided;
	const Parts byChart = map.mesh.trianglesByChart(map.charts.size());
	for (const int c : charts)
		for (const int piece : divide(c, graph.connectedPieces(byChart[positionOf(c)]), map))
			divided.push_back(piece);
	splitPoints(map.mesh);
	settle(divided, false, map);
	countCuts(before, map);
}

} // namespace ricci
