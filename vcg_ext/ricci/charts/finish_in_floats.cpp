// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish_in_floats.h"

#include "../base/tolerances.h"
#include "../finish/repair.h"
#include "../math/box_tree.h"
#include "../math/orientation.h"
#include "../measure/hyperbolic_distortion.h"
#include "measure_result.h"
#include "pack.h"
#include "separate_charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace ricci {

namespace {

/// The step of floats just below \p x > 0.
double floatStep(double x)
{
	const auto above = static_cast<float>(x);
	return static_cast<double>(above) - static_cast<double>(std::nextafter(above, 0.0F));
}

/// Widens a box to floats: points that are rounded may lie on its border.
void widenToFloats(Box2& box)
{
	constexpr float far = std::numeric_limits<float>::infinity();
	for (std::size_t k = 0; k < 2; ++k) {
		auto min = static_cast<float>(box.min[k]), max = static_cast<float>(box.max[k]);
		if (static_cast<double>(min) > box.min[k])
			min = std::nextafter(min, -far);
		if (static_cast<double>(max) < box.max[k])
			max = std::nextafter(max, far);
		box.min[k] = static_cast<double>(min);
		box.max[k] = static_cast<double>(max);
	}
}

/// Charts that need more room are packed so many times in all.
constexpr int kMaxPackings = 4;

/// Rings round bad triangles that are moved at first, of which one is the border of the largest patches.
constexpr int kNearRings = 4;

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
		const double height = kMinFloatSteps * floatStep(largest);
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

	/// The triangles that are not sound, and so many rings round them.
	std::vector<int> near(const SurfaceMesh& mesh, const Soundness& wanted, int rings) const
	{
		const std::vector<Triangle>& triangles = trianglesOf(mesh);
		std::vector<char> isTaken(triangles.size(), 0),
			isNear(m_map.isRefined() ? m_map.refined.points.size() : mesh.positions.size(), 0);
		for (std::size_t f = 0; f < m_uv.size(); ++f)
			if (!wanted.isSound(inOrder(f, m_uv[f])))
				isTaken[f] = 1;
		for (; rings > 0; --rings) {
			for (std::size_t f = 0; f < triangles.size(); ++f)
				if (isTaken[f])
					for (const int v : triangles[f])
						isNear[positionOf(v)] = 1;
			for (std::size_t f = 0; f < triangles.size(); ++f)
				for (const int v : triangles[f])
					if (isNear[positionOf(v)])
						isTaken[f] = 1;
		}
		std::vector<int> taken;
		for (std::size_t f = 0; f < isTaken.size(); ++f)
			if (isTaken[f])
				taken.push_back(static_cast<int>(f));
		return taken;
	}

	std::int64_t size() const { return static_cast<std::int64_t>(m_uv.size()); }

	std::vector<int> all() const
	{
		std::vector<int> faces(m_uv.size());
		std::iota(faces.begin(), faces.end(), 0);
		return faces;
	}

	/// [triangle] 1 for those that are not sound.
	std::vector<char> unsound() const
	{
		std::vector<char> isUnsound(m_uv.size(), 0);
		for (std::size_t f = 0; f < m_uv.size(); ++f)
			isUnsound[f] = !soundness.isSound(inOrder(f, m_uv[f]));
		return isUnsound;
	}

	/// Draws some of the triangles, in increasing order, counter-clockwise.
	void draw(const SurfaceMesh& mesh, std::vector<int> faces)
	{
		m_faces = std::move(faces);
		std::vector<Point3> places;
		for (const SurfacePoint& p : m_map.refined.points)
			places.push_back(placeOnSurface(p, mesh.positions));
		const std::vector<Point3>& positions = m_map.isRefined() ? places : mesh.positions;
		const std::vector<Triangle>& triangles = trianglesOf(mesh);
		Array<Triangle> vertices;
		Array<Triangle2> plane;
		Array<std::array<double, 3>> sides;
		for (const int face : m_faces) {
			const std::size_t f = positionOf(face);
			const Triangle t = inOrder(f, triangles[f]);
			const auto length = [&](std::size_t i, std::size_t j) {
				return distance(positions[positionOf(t[i])], positions[positionOf(t[j])]);
			};
			vertices.push_back(t);
			plane.push_back(inOrder(f, m_uv[f]));
			sides.push_back({length(0, 1), length(1, 2), length(2, 0)});
		}
		Array<int> chartOfFace(static_cast<int>(triangles.size()), 0);
		int number = 0;
		for (const Chart& chart : m_map.charts) {
			for (const int f : m_map.isRefined() ? chart.refined : chart.faces)
				chartOfFace[f] = number;
			++number;
		}
		m_boxes.clear();
		for (const Chart& chart : m_map.charts)
			m_boxes.push_back(chart.box);
		for (const int f : chartOfFace.indices())
			for (const Point2& p : m_uv[positionOf(f)])
				m_boxes[chartOfFace[f]].add(p);
		for (Box2& box : m_boxes)
			widenToFloats(box);
		Array<int> chart;
		for (const int f : m_faces)
			chart.push_back(chartOfFace[f]);
		flat = flatMeshOf(std::move(vertices), plane, chart, std::move(sides));
		m_chartOfPoint.assign(flat.place.size(), 0);
		for (const int i : flat.points.indices())
			for (const int p : flat.points[i])
				m_chartOfPoint[p] = chart[i];
	}

	/// Of all triangles of the charts as they were laid out, and the room that these were given.
	const Array<Box2>& boxes() const { return m_boxes; }

	int chartOf(int point) const { return m_chartOfPoint[point]; }
	int chartCount() const { return static_cast<int>(m_map.charts.size()); }

	/// Writes the points that were moved back.
	/// \return whether there are any
	bool takeOver(const Repair& repair)
	{
		if (repair.movedCount() == 0)
			return false;
		for (const int i : flat.points.indices()) {
			const std::size_t f = positionOf(m_faces[positionOf(i)]);
			Triangle2 uv = inOrder(f, m_uv[f]);
			for (std::size_t k = 0; k < 3; ++k)
				if (const int p = flat.points[i][k]; repair.moved[p])
					uv[k] = flat.place[p];
			m_uv[f] = inOrder(f, uv);
		}
		m_map.report.finishMoved += repair.movedCount();
		return true;
	}

	FlatMesh flat;
	Soundness soundness;
	Soundness inText; ///< for coordinates with six decimals, in the unit square

private:
	const std::vector<Triangle>& trianglesOf(const SurfaceMesh& mesh) const
	{
		return m_map.isRefined() ? m_map.refined.triangles : mesh.triangles;
	}

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
	std::vector<int> m_faces;  // those that are drawn
	Array<int> m_chartOfPoint; // of the drawing
	Array<Box2> m_boxes;       // [chart]
};

/// Tests patches that move borders of charts in the plane.
class BorderTest
{
public:
	BorderTest(const Output& output, bool staysInBox) :
			m_output(output), m_staysInBox(staysInBox), m_border(output.chartCount()),
			m_near(output.chartCount()), m_moves(output.flat.place.size(), 0)
	{
		forEdges(sidesByEdge(output.flat), [&](const FlatSide* side, int count) {
			if (!isInside(side, count))
				for (int i = 0; i < count; ++i)
					m_border[output.chartOf(side[i].atLow)].push_back(
						{side[i].atLow, side[i].atHigh});
		});
		for (const int chart : m_near.indices())
			m_near[chart].push_back(chart);
		if (!m_staysInBox) // the charts' places count for nothing
			return;
		const Array<Box2>& boxes = output.boxes();
		BoxTree({boxes.begin(), boxes.end()}).meetingPairs([&](int i, int j) {
			m_near[i].push_back(j);
			m_near[j].push_back(i);
		});
	}

	/// Whether the moved border sides of the patch cross none of its charts; and where these keep their
	/// room, whether the patch stays in their boxes and crosses none of the charts whose boxes meet them.
	bool operator()(const FlatMesh& flat, const Patch& patch)
	{
		for (const int p : patch.points)
			if (m_staysInBox && !m_output.boxes()[m_output.chartOf(p)].contains(flat.place[p]))
				return false;
		std::vector<int> charts;
		for (std::size_t i = 0; i < patch.points.size(); ++i) {
			m_moves[patch.points[i]] = patch.variable[static_cast<int>(i)] >= 0;
			charts.push_back(m_output.chartOf(patch.points[i]));
		}
		std::sort(charts.begin(), charts.end());
		charts.erase(std::unique(charts.begin(), charts.end()), charts.end());
		const bool crosses = std::any_of(charts.begin(), charts.end(), [&](int chart) {
			const std::vector<BorderSide>& sides = m_border[chart];
			return std::any_of(sides.begin(), sides.end(), [&](const BorderSide& side) {
				return (m_moves[side[0]] || m_moves[side[1]]) && crossesAny(flat, side, chart);
			});
		});
		for (const int p : patch.points)
			m_moves[p] = 0;
		return !crosses;
	}

private:
	using BorderSide = std::array<int, 2>; // points

	static Box2 boxOf(const FlatMesh& flat, const BorderSide& side)
	{
		Box2 box;
		box.add(flat.place[side[0]]);
		box.add(flat.place[side[1]]);
		return box;
	}

	bool crossesAny(const FlatMesh& flat, const BorderSide& side, int chart) const
	{
		const Box2 box = boxOf(flat, side);
		for (const int near : m_near[chart])
			if (near == chart || m_output.boxes()[near].meets(box))
				for (const BorderSide& other : m_border[near])
					if (cross(flat, side, other))
						return true;
		return false;
	}

	static bool cross(const FlatMesh& flat, const BorderSide& s, const BorderSide& t)
	{
		const Point2 &a = flat.place[s[0]], &b = flat.place[s[1]];
		const Point2 &c = flat.place[t[0]], &d = flat.place[t[1]];
		return boxOf(flat, s).meets(boxOf(flat, t)) &&
			   orientation(a, b, c) * orientation(a, b, d) < 0 &&
			   orientation(c, d, a) * orientation(c, d, b) < 0;
	}

	const Output& m_output;
	bool m_staysInBox;
	Array<std::vector<BorderSide>> m_border; // [chart]
	Array<std::vector<int>> m_near;          // [chart] itself, and those whose boxes meet its own
	Array<char> m_moves;                     // [point] scratch, 0 between calls
};

Point2 centreOf(const Box2& square)
{
	return {(square.min[0] + square.max[0]) / 2, (square.min[1] + square.max[1]) / 2};
}

/// What finishEverywhere() does where small patches inside the charts mend all: then all but what is near
/// bad triangles plays no part.
/// \return whether points were moved; none where that does not do, and nothing is changed
std::optional<bool>
finishNear(const SurfaceMesh& mesh, WorkLimit& limit, Output& output)
{
	output.draw(mesh, output.near(mesh, output.inText, kNearRings));
	BorderTest test(output, true);
	const PatchRules rules{kNearRings - 1, [&](const FlatMesh& flat, const Patch& patch) {
							   return test(flat, patch);
						   }};
	const PointGroups groups = insidePoints(output.flat);
	const Repair result =
		repair(output.flat, groups, RestShapes::OfDrawing, output.inText, rules, limit);
	if (result.left > 0)
		return std::nullopt;
	return output.takeOver(result);
}

/// What was moved.
struct Finished
{
	bool points = false;
	bool boxes = false; ///< charts have grown out of theirs
	bool all = true;    ///< every triangle is sound
};

Finished finishEverywhere(
	const SurfaceMesh& mesh, bool mayGrow, WorkLimit& limit, Output& output)
{
	output.draw(mesh, output.all());
	BorderTest test(output, true);
	const PatchTest accepts = [&](const FlatMesh& flat, const Patch& patch) {
		return test(flat, patch);
	};
	const BorderMoves moves{SeamGeometry::Plane, [](int) { return false; }, accepts};
	const auto inStages = [&](const Soundness& wanted) {
		return repairInStages(output.flat, moves, RestShapes::OfDrawing, wanted, limit);
	};
	Repair result = inStages(output.inText);
	// Where there is no room for that, floats have to do.
	result.add(inStages(output.soundness));
	if (result.left > 0)
		result.add(repairFreely(
			output.flat, accepts, RestShapes::OfDrawing, output.soundness, limit));
	Finished finished;
	if (result.left > 0 && mayGrow) {
		BorderTest ofItself(output, false);
		const Repair growth = repairFreely(
			output.flat,
			[&](const FlatMesh& flat, const Patch& patch) { return ofItself(flat, patch); },
			RestShapes::OfDrawing,
			output.soundness,
			limit);
		finished.boxes = growth.movedCount() > 0;
		result.add(growth);
	}
	finished.points = output.takeOver(result);
	finished.all = result.left == 0;
	return finished;
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

void finishInFloats(
	const SurfaceMesh& mesh,
	const std::function<void()>& packAgain,
	bool mayCut,
	Parametrization& map)
{
	WorkLimit limit(Output(map).size());
	for (int packings = 1;; ++packings) {
		Output output(map);
		if (output.isSound(output.inText))
			return;
		const bool mayGrow = packAgain && packings < kMaxPackings;
		const std::optional<bool> moved = finishNear(mesh, limit, output);
		const Finished finished =
			moved ? Finished{*moved} : finishEverywhere(mesh, mayGrow, limit, output);
		if (finished.points)
			measureResult(mesh, measureDistortion, map);
		const bool isCut = !finished.all && mayGrow && mayCut && cutOff(output.unsound(), map);
		if (!finished.boxes && !isCut)
			return;
		mayCut = mayCut && !isCut; // once: what is left then has had its chart
		packAgain();
	}
}

void finishInFloats(
	const SurfaceMesh& mesh, const std::vector<Box2>& disks, Parametrization& map)
{
	Output output(map);
	if (output.isSound(output.soundness))
		return;
	output.draw(mesh, output.all());
	const auto isInDisk = [&](const FlatMesh& flat, const Patch& patch) {
		for (const int p : patch.points) {
			const Box2& square = disks[positionOf(output.chartOf(p))];
			if (!(distance(flat.place[p], centreOf(square)) < 0.5 * square.width()))
				return false;
		}
		return true;
	};
	WorkLimit limit(output.size());
	const bool moved = output.takeOver(
		repairFreely(output.flat, isInDisk, RestShapes::OfDrawing, output.soundness, limit));
	if (moved)
		measureInDisk(mesh, disks, map);
}

} // namespace ricci
