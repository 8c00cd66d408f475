// SPDX-License-Identifier: GPL-3.0-or-later
#include "separate_charts.h"

#include "../math/min_area_rectangle.h"
#include "../math/orientation.h"
#include "chart_division.h"
#include "chart_overlap.h"
#include "join_parts.h"

#include <algorithm>
#include <array>
#include <utility>

namespace ricci {

namespace {

/// Numbers of the output's triangles in a chart.
const std::vector<int>& trianglesOf(const Parametrization& map, const Chart& chart)
{
	return map.isRefined() ? chart.refined : chart.faces;
}

/// The output's triangles of one chart, in the order of their component.
struct OutputChart
{
	DrawnChart drawn;
	Array<std::array<double, 3>> edgeLength;

	OutputChart(const SurfaceMesh& mesh, const Parametrization& map, const Chart& chart)
	{
		for (int f : trianglesOf(map, chart)) {
			const std::size_t i = positionOf(f);
			Triangle t = map.isRefined() ? map.refined.triangles[i] : mesh.triangles[i];
			Triangle2 plane = map.isRefined() ? map.refined.uv[i] : map.uv[i];
			if (map.reversed[map.isRefined() ? positionOf(map.refined.inputFace[i]) : i]) {
				std::swap(t[1], t[2]);
				std::swap(plane[1], plane[2]);
			}
			std::array<Point3, 3> place;
			for (std::size_t k = 0; k < 3; ++k) {
				const std::size_t v = positionOf(t[k]);
				place[k] = map.isRefined() ? placeOnSurface(map.refined.points[v], mesh.positions)
										   : mesh.positions[v];
			}
			drawn.triangles.push_back(t);
			drawn.plane.push_back(plane);
			edgeLength.push_back(
				{distance(place[0], place[1]),
				 distance(place[1], place[2]),
				 distance(place[2], place[0])});
		}
	}

	bool hasFolds() const
	{
		return std::any_of(drawn.plane.begin(), drawn.plane.end(), [](const Triangle2& p) {
			return orientation(p[0], p[1], p[2]) <= 0;
		});
	}

	double extent() const
	{
		Box2 box;
		for (const Triangle2& triangle : drawn.plane)
			for (const Point2& p : triangle)
				box.add(p);
		return box.extent();
	}
};

/// Pairs of triangles of one part that overlap, in the chart's numbers.
std::vector<TrianglePair>
pairsWithin(const DrawnChart& chart, const std::vector<int>& part, double extent, const Tick& tick)
{
	DrawnChart own;
	for (const int i : part) {
		own.triangles.push_back(chart.triangles[i]);
		own.plane.push_back(chart.plane[i]);
	}
	std::vector<TrianglePair> pairs = overlappingPairs(own, tick, extent);
	for (TrianglePair& pair : pairs)
		pair = {part[positionOf(pair[0])], part[positionOf(pair[1])]};
	return pairs;
}

/// Divides the chart so that no part covers itself. A fold may hide an overlap from \p pairs and then
/// go to another part than the triangles that it hides: what appears in the parts is added to the
/// pairs, and the chart is divided anew.
std::vector<std::vector<int>> separateParts(
	const OutputChart& chart, std::vector<TrianglePair> pairs, const Tick& tick, ChartCuts& cuts)
{
	const bool hasFolds = chart.hasFolds();
	const double extent = chart.extent();
	for (;;) {
		std::vector<std::vector<int>> parts =
			divideChart(chart.drawn, pairs, chart.edgeLength, cuts);
		const std::size_t known = pairs.size();
		for (std::size_t i = 0; i < parts.size() && hasFolds; ++i) {
			const auto more = pairsWithin(chart.drawn, parts[i], extent, tick);
			pairs.insert(pairs.end(), more.begin(), more.end());
		}
		if (pairs.size() == known)
			return parts;
	}
}

/// Joins the parts of a chart across seams where they have room there, and moves them in \p map.
std::vector<std::vector<int>> join(
	const OutputChart& chart,
	const Chart& whole,
	const std::vector<std::vector<int>>& parts,
	const Tick& tick,
	Parametrization& map)
{
	Array<int> partOf(chart.drawn.triangles.size());
	for (std::size_t p = 0; p < parts.size(); ++p)
		for (const int i : parts[p])
			partOf[i] = static_cast<int>(p);
	DrawnTriangles drawn =
		drawingOf(chart.drawn.triangles, chart.drawn.plane, partOf, chart.edgeLength);
	JoinedParts joined = joinParts(drawn, parts, tick);
	map.report.overlapCuts += joined.seams.edges;
	map.report.seamLength += joined.seams.length;
	const std::vector<int>& triangles = trianglesOf(map, whole);
	std::vector<char> faceDone(map.uv.size(), 0);
	for (const int i : joined.motion.indices()) {
		const std::size_t f = positionOf(triangles[positionOf(i)]);
		const std::size_t face = map.isRefined() ? positionOf(map.refined.inputFace[f]) : f;
		Triangle2 uv = drawn.at(i);
		if (map.reversed[face])
			std::swap(uv[1], uv[2]);
		(map.isRefined() ? map.refined.uv[f] : map.uv[f]) = uv;
		if (map.isRefined() && !faceDone[face])
			for (Point2& p : map.uv[face])
				p = joined.motion[i](p);
		faceDone[face] = 1;
	}
	return std::move(joined.parts);
}

/// Turns and moves a part of a chart so that its smallest bounding rectangle lies along the axes,
/// from the origin.
void turnUpright(Parametrization& map, const Chart& chart)
{
	std::vector<Point2> points;
	for (int f : trianglesOf(map, chart))
		for (const Point2& p :
			 map.isRefined() ? map.refined.uv[positionOf(f)] : map.uv[positionOf(f)])
			points.push_back(p);
	const OrientedRectangle r = minAreaRectangle(std::move(points));
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
	std::vector<std::size_t> partOf(triangles.size());
	for (std::size_t p = 0; p < parts.size(); ++p)
		for (int i : parts[p])
			partOf[positionOf(i)] = p;
	std::vector<Chart> charts(parts.size());
	for (std::size_t i = 0; i < partOf.size(); ++i) {
		Chart& chart = charts[partOf[i]];
		int f = triangles[i];
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

} // namespace

void separateCharts(const SurfaceMesh& mesh, bool resolve, const Tick& tick, Parametrization& map)
{
	std::vector<Chart> charts;
	std::vector<char> faceDone(mesh.triangles.size(), 0);
	for (Chart& chart : map.charts) {
		const OutputChart output(mesh, map, chart);
		const std::vector<TrianglePair> pairs = overlappingPairs(output.drawn, tick);
		if (!pairs.empty() && !resolve) {
			Array<char> overlaps(output.drawn.triangles.size(), 0);
			for (const TrianglePair& pair : pairs)
				for (int i : pair)
					overlaps[i] = 1;
			++map.report.overlappingCharts;
			for (char o : overlaps)
				map.report.overlappingFaces += o;
		}
		if (pairs.empty() || !resolve) {
			charts.push_back(std::move(chart));
			continue;
		}
		ChartCuts cuts;
		const auto parts = join(output, chart, separateParts(output, pairs, tick, cuts), tick, map);
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
