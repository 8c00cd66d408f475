// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish_in_floats.h"

#include "../base/tolerances.h"
#include "../finish/repair.h"
#include "../math/orientation.h"
#include "../measure/hyperbolic_distortion.h"
#include "measure_result.h"
#include "pack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ricci {

namespace {

/// The step of floats just below \p x > 0.
double floatStep(double x)
{
	const auto above = static_cast<float>(x);
	return static_cast<double>(above) - static_cast<double>(std::nextafter(above, 0.0F));
}

/// The output's triangles, with what the repair wants to know of them.
class Output
{
public:
	explicit Output(Parametrization& map) :
			m_map(map), m_uv(map.isRefined() ? map.refined.uv : map.uv)
	{
		double largest = 0.0;
		for (const Triangle2& triangle : m_uv)
			for (const Point2& p : triangle)
				for (const double x : p)
					largest = std::max(largest, std::abs(x));
		const double height = kLeastFloatSteps * floatStep(largest);
		soundness = {height, kWantedHeights * height, true};
		inText = soundness;
		if (!map.isRefined() && largest > 0.5 && largest <= 1.0)
			inText = {height, kWantedHeights * kTextStep, true, kTextStep};
	}

	bool isSound(const Soundness& wanted) const
	{
		for (std::size_t f = 0; f < m_uv.size(); ++f)
			if (!wanted.isSound(inOrder(f, m_uv[f])))
				return false;
		return true;
	}

	/// Draws the triangles, counter-clockwise.
	void draw(const SurfaceMesh& mesh)
	{
		std::vector<Point3> places;
		for (const SurfacePoint& p : m_map.refined.points)
			places.push_back(placeOnSurface(p, mesh.positions));
		const std::vector<Point3>& positions = m_map.isRefined() ? places : mesh.positions;
		const std::vector<Triangle>& triangles =
			m_map.isRefined() ? m_map.refined.triangles : mesh.triangles;
		Array<Triangle> vertices;
		Array<Triangle2> plane;
		Array<std::array<double, 3>> sides;
		for (std::size_t f = 0; f < triangles.size(); ++f) {
			const Triangle t = inOrder(f, triangles[f]);
			const auto length = [&](std::size_t i, std::size_t j) {
				return distance(positions[positionOf(t[i])], positions[positionOf(t[j])]);
			};
			vertices.push_back(t);
			plane.push_back(inOrder(f, m_uv[f]));
			sides.push_back({length(0, 1), length(1, 2), length(2, 0)});
		}
		m_chartOf.assign(triangles.size(), 0);
		int number = 0;
		for (const Chart& chart : m_map.charts) {
			for (const int f : m_map.isRefined() ? chart.refined : chart.faces)
				m_chartOf[f] = number;
			++number;
		}
		drawn = drawingOf(std::move(vertices), plane, m_chartOf, std::move(sides));
		m_chartOfPoint.assign(drawn.points.size(), 0);
		for (const int f : drawn.corners.indices())
			for (const int p : drawn.corners[f])
				m_chartOfPoint[p] = m_chartOf[f];
	}

	int chartOf(int point) const { return m_chartOfPoint[point]; }
	int chartCount() const { return static_cast<int>(m_map.charts.size()); }

	/// Writes the points that were moved back.
	/// \return whether there are any
	bool takeOver(const Repair& repair)
	{
		if (repair.movedCount() == 0)
			return false;
		for (const int f : drawn.corners.indices()) {
			Triangle2 uv = inOrder(positionOf(f), m_uv[positionOf(f)]);
			for (std::size_t k = 0; k < 3; ++k)
				if (const int p = drawn.corners[f][k]; repair.moved[p])
					uv[k] = drawn.points[p];
			m_uv[positionOf(f)] = inOrder(positionOf(f), uv);
		}
		m_map.report.finishMoved += repair.movedCount();
		return true;
	}

	DrawnTriangles drawn;
	Soundness soundness;
	Soundness inText; ///< for coordinates with six decimals, in the unit square

private:
	/// The corners of a triangle with two of them swapped if it is reversed.
	template<class Corners>
	Corners inOrder(std::size_t f, Corners corners) const
	{
		const std::size_t face = m_map.isRefined() ? positionOf(m_map.refined.inputFace[f]) : f;
		if (m_map.reversed[face])
			std::swap(corners[1], corners[2]);
		return corners;
	}

	Parametrization& m_map;
	std::vector<Triangle2>& m_uv;
	Array<int> m_chartOf, m_chartOfPoint;
};

/// Tests patches that move borders of charts in the plane.
class BorderTest
{
public:
	explicit BorderTest(const Output& output) :
			m_output(output), m_box(output.chartCount()), m_border(output.chartCount()),
			m_moves(output.drawn.points.size(), 0)
	{
		for (const int p : output.drawn.points.indices())
			m_box[output.chartOf(p)].add(output.drawn.points[p]);
		forEdges(sidesByEdge(output.drawn), [&](const DrawnSide* side, int count) {
			if (!isInside(side, count))
				for (int i = 0; i < count; ++i)
					m_border[output.chartOf(side[i].atLow)].push_back(
						{side[i].atLow, side[i].atHigh});
		});
	}

	/// Whether the patch stays in the boxes of its charts, and its moved border sides cross none.
	bool operator()(const DrawnTriangles& drawn, const Patch& patch)
	{
		for (const int p : patch.points)
			if (!m_box[m_output.chartOf(p)].contains(drawn.points[p]))
				return false;
		std::vector<int> charts;
		for (std::size_t i = 0; i < patch.points.size(); ++i) {
			m_moves[patch.points[i]] = patch.variable[static_cast<int>(i)] >= 0;
			charts.push_back(m_output.chartOf(patch.points[i]));
		}
		std::sort(charts.begin(), charts.end());
		charts.erase(std::unique(charts.begin(), charts.end()), charts.end());
		bool crosses = false;
		for (const int chart : charts)
			for (const BorderSide& side : m_border[chart])
				if (m_moves[side[0]] || m_moves[side[1]])
					for (const BorderSide& other : m_border[chart])
						crosses = crosses || cross(drawn, side, other);
		for (const int p : patch.points)
			m_moves[p] = 0;
		return !crosses;
	}

private:
	using BorderSide = std::array<int, 2>; // points

	static bool cross(const DrawnTriangles& drawn, const BorderSide& s, const BorderSide& t)
	{
		const Point2 &a = drawn.points[s[0]], &b = drawn.points[s[1]];
		const Point2 &c = drawn.points[t[0]], &d = drawn.points[t[1]];
		Box2 first, second;
		first.add(a);
		first.add(b);
		second.add(c);
		second.add(d);
		return first.meets(second) && orientation(a, b, c) * orientation(a, b, d) < 0 &&
			   orientation(c, d, a) * orientation(c, d, b) < 0;
	}

	const Output& m_output;
	Array<Box2> m_box;                       // [chart] before
	Array<std::vector<BorderSide>> m_border; // [chart]
	Array<char> m_moves;                     // [point] scratch, 0 between calls
};

Point2 centreOf(const Box2& square)
{
	return {(square.min[0] + square.max[0]) / 2, (square.min[1] + square.max[1]) / 2};
}

/// measureResult() of charts that fill \p disks, in the unit disk.
void measureInDisk(const SurfaceMesh& mesh, const std::vector<Box2>& disks, Parametrization& map)
{
	std::vector<Triangle2> uv = map.uv, refined = map.refined.uv;
	for (std::size_t i = 0; i < map.charts.size(); ++i) {
		const double scale = 2.0 / disks[i].width();
		const Point2 centre = centreOf(disks[i]);
		transformChart(map, map.charts[i], scale, {-scale * centre[0], -scale * centre[1]});
	}
	measureResult(mesh, measureHyperbolicDistortion, map);
	map.uv = std::move(uv);
	map.refined.uv = std::move(refined);
}

} // namespace

void finishInFloats(const SurfaceMesh& mesh, const Tick& tick, Parametrization& map)
{
	Output output(map);
	if (output.isSound(output.inText))
		return;
	output.draw(mesh);
	BorderTest test(output);
	const PatchTest accepts = [&](const DrawnTriangles& drawn, const Patch& patch) {
		return test(drawn, patch);
	};
	const BorderMoves moves{SeamGeometry::Plane, [](int) { return false; }, accepts};
	Repair result = repairInStages(output.drawn, moves, RestShapes::OfDrawing, output.inText, tick);
	// Where there is no room for that, floats have to do.
	result.add(repairInStages(output.drawn, moves, RestShapes::OfDrawing, output.soundness, tick));
	if (result.left > 0)
		result.add(
			repairFreely(output.drawn, accepts, RestShapes::OfDrawing, output.soundness, tick));
	if (output.takeOver(result))
		measureResult(mesh, measureDistortion, map);
}

void finishInFloats(
	const SurfaceMesh& mesh, const std::vector<Box2>& disks, const Tick& tick, Parametrization& map)
{
	Output output(map);
	if (output.isSound(output.soundness))
		return;
	output.draw(mesh);
	const auto isInDisk = [&](const DrawnTriangles& drawn, const Patch& patch) {
		for (const int p : patch.points) {
			const Box2& square = disks[positionOf(output.chartOf(p))];
			if (!(distance(drawn.points[p], centreOf(square)) < 0.5 * square.width()))
				return false;
		}
		return true;
	};
	const bool moved = output.takeOver(
		repairFreely(output.drawn, isInDisk, RestShapes::OfDrawing, output.soundness, tick));
	if (moved)
		measureInDisk(mesh, disks, map);
}

} // namespace ricci
