// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish_in_floats.h"

#include "../base/floating_point.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../finish/repair.h"
#include "../math/adjacency.h"
#include "../math/box_tree.h"
#include "../math/orientation.h"
#include "divide_disks.h"
#include "pack.h"
#include "separate_charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>

namespace ricci {

namespace {

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

/// A disk that has grown beyond its own is drawn again with this radius at most, of 1.
constexpr double kRedrawnRadius = 0.999;

/// Rings round bad triangles that are moved at first, of which one is the border of the largest patches.
constexpr int kNearRings = 6;

/// What the triangles of a map have to be once they are stored.
struct Wanted
{
	Validity validity;
	Validity inText; ///< also for coordinates with six decimals, in the unit square

	Wanted(const FlatMesh& mesh, bool forText)
	{
		double largest = 0.0;
		for (const Point2& p : mesh.place)
			for (const double x : p)
				largest = std::max(largest, std::abs(x));
		const double height = kMinFloatSteps * floatStep(largest);
		validity = {height, kWantedHeights * height, true};
		inText = validity;
		if (forText && largest > 0.5 && largest <= 1.0)
			inText = {height, kWantedHeights * kTextStep, true, kTextStep};
	}
};

/// The triangles that are not valid, and so many rings round them.
std::vector<int> near(const FlatMesh& mesh, const std::vector<int>& bad, int rings)
{
	std::vector<char> isTaken(positionOf(mesh.size()), 0), isNear(mesh.source.values().size(), 0);
	for (const int f : bad)
		isTaken[positionOf(f)] = 1;
	for (; rings > 0; --rings) {
		for (const int f : mesh.points.indices())
			if (isTaken[positionOf(f)])
				for (const int v : mesh.vertices[f])
					isNear[positionOf(v)] = 1;
		for (const int f : mesh.points.indices())
			for (const int v : mesh.vertices[f])
				if (isNear[positionOf(v)])
					isTaken[positionOf(f)] = 1;
	}
	std::vector<int> taken;
	for (const int f : mesh.points.indices())
		if (isTaken[positionOf(f)])
			taken.push_back(f);
	return taken;
}

/// [chart] what it was given, and all its triangles.
Array<Box2> boxesOf(const Parametrization& map)
{
	Array<Box2> boxes(map.mesh.boxes(map.charts.size()));
	for (const int chart : boxes.indices()) {
		boxes[chart].add(map.charts[positionOf(chart)].box);
		widenToFloats(boxes[chart]);
	}
	return boxes;
}

using BorderSide = std::array<int, 2>; // points

/// Tests patches that move borders of charts in the plane.
class BorderTest
{
public:
	/// \param boxes [chart]
	BorderTest(const FlatMesh& mesh, const Array<Box2>& boxes, bool staysInBox) :
			m_boxes(boxes), m_staysInBox(staysInBox), m_chartOf(mesh.chartOfPoints()),
			m_border(boxes.size()), m_near(boxes.size()),
			m_sidesAt(mesh.place.size(), [&](const auto& add) {
				for (const Corner side : mesh.across.indices())
					if (!mesh.joined(side).isValid())
						for (const Corner end : {side, side.next()})
							add(mesh.points[end],
								BorderSide{mesh.points[side], mesh.points[side.next()]});
			})
	{
		for (const int p : m_chartOf.indices())
			for (const BorderSide& side : m_sidesAt[p])
				if (side[0] == p)
					m_border[m_chartOf[p]].push_back(side);
		for (const int chart : m_near.indices())
			m_near[chart].push_back(chart);
		if (!m_staysInBox) // the charts' places count for nothing
			return;
		BoxTree({boxes.begin(), boxes.end()}).meetingPairs([&](int i, int j) {
			m_near[i].push_back(j);
			m_near[j].push_back(i);
		});
	}

	/// Whether the moved border sides of the patch cross none of its charts; and where these keep their
	/// room, whether the patch stays in their boxes and crosses none of the charts whose boxes meet them.
	bool operator()(const FlatMesh& flat, const Patch& patch) const
	{
		for (const int p : patch.points)
			if (m_staysInBox && !m_boxes[m_chartOf[p]].contains(flat.place[p]))
				return false;
		std::map<int, std::vector<BorderSide>> moved; // of each chart
		for (std::size_t i = 0; i < patch.points.size(); ++i)
			if (patch.variable[static_cast<int>(i)] >= 0)
				for (const BorderSide& side : m_sidesAt[patch.points[i]])
					moved[m_chartOf[patch.points[i]]].push_back(side);
		for (const auto& [chart, sides] : moved)
			if (crossesAny(flat, sides, chart))
				return false;
		return true;
	}

private:
	static Box2 boxOf(const FlatMesh& flat, const BorderSide& side)
	{
		Box2 box;
		box.add(flat.place[side[0]]);
		box.add(flat.place[side[1]]);
		return box;
	}

	bool crossesAny(const FlatMesh& flat, const std::vector<BorderSide>& sides, int chart) const
	{
		std::vector<Box2> boxes;
		Box2 all;
		for (const BorderSide& side : sides) {
			boxes.push_back(boxOf(flat, side));
			all.add(boxes.back());
		}
		const BoxTree tree(boxes);
		for (const int near : m_near[chart])
			if (near == chart || m_boxes[near].meets(all))
				for (const BorderSide& other : m_border[near])
					if (tree.meetsAny(boxOf(flat, other), [&](int i) {
							return cross(flat, sides[positionOf(i)], other);
						}))
						return true;
		return false;
	}

	static bool cross(const FlatMesh& flat, const BorderSide& s, const BorderSide& t)
	{
		const Point2 &a = flat.place[s[0]], &b = flat.place[s[1]];
		const Point2 &c = flat.place[t[0]], &d = flat.place[t[1]];
		return orientation(a, b, c) * orientation(a, b, d) < 0 &&
			   orientation(c, d, a) * orientation(c, d, b) < 0;
	}

	const Array<Box2>& m_boxes; // [chart]
	bool m_staysInBox;
	Array<int> m_chartOf;                    // [point]
	Array<std::vector<BorderSide>> m_border; // [chart]
	Array<std::vector<int>> m_near;          // [chart] itself, and those whose boxes meet its own
	Adjacency<int, BorderSide> m_sidesAt;    // [point]
};

/// What finishEverywhere() does where small patches inside the charts mend all: then all but what is near
/// bad triangles plays no part.
/// \return whether points were moved; none where that does not do, and nothing is changed
std::optional<bool> finishNear(const Validity& validity, WorkLimit& limit, Parametrization& map)
{
	const std::vector<int> taken = near(map.mesh, badTriangles(map.mesh, validity), kNearRings);
	FlatMesh part = map.mesh.part(taken);
	for (const int i : part.chart.indices())
		part.chart[i] = map.mesh.chart[taken[positionOf(i)]];
	splitPoints(part);
	const Array<Box2> boxes = boxesOf(map);
	const BorderTest test(part, boxes, true);
	const PatchTest accepts = [&](const FlatMesh& flat, const Patch& patch) {
		return test(flat, patch);
	};
	const Repair result = repair(
		part,
		insidePoints(part),
		{RestShapes::OfDrawing, validity, accepts},
		limit);
	if (result.left > 0)
		return std::nullopt;
	if (result.movedCount() == 0)
		return false;
	for (const int i : part.points.indices())
		for (const Corner c : cornersOf(i))
			if (const int p = part.points[c]; result.moved[p])
				map.mesh.place[map.mesh.points[Corner(taken[positionOf(i)], int(c.index()))]] =
					part.place[p];
	map.report.finishMoved += result.movedCount();
	return true;
}

/// What was moved.
struct Finished
{
	bool points = false;
	bool boxes = false; ///< charts have grown out of theirs
	bool all = true;    ///< every triangle is valid
};

Finished
finishEverywhere(const Wanted& wanted, bool mayGrow, WorkLimit& limit, Parametrization& map)
{
	const Array<Box2> boxes = boxesOf(map);
	const BorderTest test(map.mesh, boxes, true);
	const PatchTest accepts = [&](const FlatMesh& flat, const Patch& patch) {
		return test(flat, patch);
	};
	const auto inStages = [&](const Validity& validity) {
		return repairInStages(
			map.mesh,
			SeamGeometry::Plane,
			[](int) { return false; },
			{RestShapes::OfDrawing, validity, accepts},
			limit);
	};
	const auto freely = [&](const PatchTest& isAccepted) {
		return repairFreely(map.mesh, {RestShapes::OfDrawing, wanted.validity, isAccepted}, limit);
	};
	Repair result = inStages(wanted.inText);
	// Where there is no room for that, floats have to do.
	result.add(inStages(wanted.validity));
	if (result.left > 0)
		result.add(freely(accepts));
	Finished finished;
	if (result.left > 0 && mayGrow) {
		BorderTest ofItself(map.mesh, boxes, false);
		const Repair growth =
			freely([&](const FlatMesh& flat, const Patch& patch) { return ofItself(flat, patch); });
		finished.boxes = growth.movedCount() > 0;
		result.add(growth);
	}
	finished.points = result.movedCount() > 0;
	finished.all = result.left == 0;
	map.report.finishMoved += result.movedCount();
	return finished;
}

/// Mends triangles of disks in their squares.
/// \param mayRedraw a chart all of whose points move may leave its disk: then it is drawn smaller
Repair repairDisks(bool mayRedraw, Parametrization& map)
{
	const Validity validity = Wanted(map.mesh, false).validity;
	if (badTriangles(map.mesh, validity).empty())
		return {};
	const Array<int> chartOf = map.mesh.chartOfPoints();
	// From the centre of its disk, over the radius
	const auto radius = [&](const FlatMesh& flat, int p) {
		const Box2& square = map.charts[positionOf(chartOf[p])].box;
		return distance(flat.place[p], square.centre()) / (0.5 * square.width());
	};
	const auto isInDisk = [&](const FlatMesh& flat, const Patch& patch) {
		return (mayRedraw && patch.isFree()) ||
			   std::all_of(patch.points.begin(), patch.points.end(), [&](int p) {
				   return radius(flat, p) < 1.0;
			   });
	};
	const auto shrink = [&] {
		Array<double> largest(map.charts.size(), 0.0);
		for (const int p : chartOf.indices())
			largest[chartOf[p]] = std::max(largest[chartOf[p]], radius(map.mesh, p));
		for (const int p : chartOf.indices())
			if (const double far = largest[chartOf[p]]; far >= 1.0) {
				const Point2 centre = map.charts[positionOf(chartOf[p])].box.centre();
				for (std::size_t k = 0; k < 2; ++k)
					map.mesh.place[p][k] =
						centre[k] + kRedrawnRadius / far * (map.mesh.place[p][k] - centre[k]);
			}
	};
	WorkLimit limit(map.mesh.size());
	Repair result = repairFreely(map.mesh, {RestShapes::OfDrawing, validity, isInDisk}, limit);
	shrink();
	result.left = static_cast<int>(badTriangles(map.mesh, validity).size());
	return result;
}

} // namespace

void finishInFloats(const FloatFinish& finish, Parametrization& map)
{
	WorkLimit limit(map.mesh.size());
	bool mayCut = finish.mayCut;
	for (int packings = 1;; ++packings) {
		const Wanted wanted(map.mesh, finish.forText);
		if (badTriangles(map.mesh, wanted.inText).empty())
			return;
		const bool mayGrow = finish.packAgain && packings < kMaxPackings;
		const std::optional<bool> moved = finishNear(wanted.inText, limit, map);
		const Finished finished =
			moved ? Finished{*moved} : finishEverywhere(wanted, mayGrow, limit, map);
		if (finished.points)
			finish.measure();
		bool isCut = false;
		if (!finished.all && mayGrow && mayCut) {
			std::vector<char> isBad(positionOf(map.mesh.size()), 0);
			for (const int f : badTriangles(map.mesh, wanted.validity))
				isBad[positionOf(f)] = 1;
			isCut = cutOff(isBad, map);
		}
		if (!finished.boxes && !isCut)
			return;
		mayCut = mayCut && !isCut; // once: what is left then has had its chart
		finish.packAgain();
	}
}

bool placeDisksInFloats(Parametrization& map)
{
	const Array<Point2> unplaced = map.mesh.place;
	placeDisks(map);
	Repair result = repairDisks(false, map);
	const std::size_t disks = map.charts.size();
	if (result.left > 0) {
		Parametrization divided = map;
		divided.mesh.place = unplaced;
		if (divideDisks(divided)) {
			placeDisks(divided);
			const Repair ofDivided = repairDisks(true, divided);
			if (ofDivided.left < result.left) {
				logLine(
					"Floats cannot hold the disks, which reach too far out: they are divided "
					"into " +
					std::to_string(divided.charts.size()) + ", each with its own middle.");
				map = std::move(divided);
				result = ofDivided;
			}
		}
	}
	map.report.finishMoved += result.movedCount();
	return result.movedCount() > 0 || map.charts.size() > disks;
}

} // namespace ricci
