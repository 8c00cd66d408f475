// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/base/floating_point.h>
#include <ricci/charts/finish_in_floats.h>
#include <ricci/charts/pack.h>
#include <ricci/math/orientation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

constexpr int kSide = 24; // squares along a side

/// Squares in the unit square as their own map, one chart, with some vertices elsewhere.
Parametrization
mapWith(const SurfaceMesh& mesh, const std::vector<std::pair<int, Point2>>& displaced)
{
	std::vector<Point2> places;
	for (const Point3& p : mesh.positions)
		places.push_back({p[0], p[1]});
	for (const auto& [vertex, place] : displaced)
		places[at(vertex)] = place;
	Parametrization map;
	for (const Triangle& t : mesh.triangles)
		map.uv.push_back({places[at(t[0])], places[at(t[1])], places[at(t[2])]});
	map.reversed.assign(map.uv.size(), 0);
	Chart chart;
	chart.faces.resize(map.uv.size());
	std::iota(chart.faces.begin(), chart.faces.end(), 0);
	map.charts.push_back(chart);
	return map;
}

bool isUpright(const Triangle2& p)
{
	Triangle2 stored = p;
	for (Point2& q : stored)
		for (double& x : q)
			x = roundedToFloat(x);
	return orientation(stored[0], stored[1], stored[2]) > 0;
}

int turnedIn(const Parametrization& map)
{
	return static_cast<int>(std::count_if(
		map.uv.begin(), map.uv.end(), [](const Triangle2& p) { return !isUpright(p); }));
}

TEST(FinishInFloats, MovesPointsNearTurnedTrianglesOnly)
{
	const SurfaceMesh mesh = rectangle(kSide, kSide, 1.0, 1.0);
	Random random(1);
	for (int trial = 0; trial < 20; ++trial) {
		// One vertex inside leaves the ring of its neighbours.
		const int i = 4 + random.index(kSide - 7), j = 4 + random.index(kSide - 7);
		const int vertex = j * (kSide + 1) + i;
		const Point3& own = mesh.positions[at(vertex)];
		const Point2 place{own[0] + 1.3 / kSide, own[1] + random.real(-0.3, 0.3) / kSide};
		const Parametrization before = mapWith(mesh, {{vertex, place}});
		ASSERT_GT(turnedIn(before), 0);
		Parametrization map = before;
		finishInFloats(
			mesh, nullptr, false, map);
		EXPECT_EQ(turnedIn(map), 0);
		EXPECT_GT(map.report.finishMoved, 0);
		for (std::size_t f = 0; f < map.uv.size(); ++f)
			for (std::size_t k = 0; k < 3; ++k) {
				const Point3& p = mesh.positions[at(mesh.triangles[f][k])];
				if (std::max(std::abs(p[0] - own[0]), std::abs(p[1] - own[1])) > 5.5 / kSide) {
					EXPECT_EQ(map.uv[f][k], before.uv[f][k]);
				}
			}
	}
}

TEST(FinishInFloats, MendsWhatSmallPatchesInsideDoNot)
{
	// A corner of the border lies inside: what is inside the chart cannot make room alone.
	const SurfaceMesh mesh = rectangle(kSide, kSide, 1.0, 1.0);
	Parametrization map = mapWith(mesh, {{0, {1.5 / kSide, 1.4 / kSide}}});
	ASSERT_GT(turnedIn(map), 0);
	finishInFloats(
		mesh, nullptr, false, map);
	EXPECT_EQ(turnedIn(map), 0);
}

constexpr int kSlivers = 7;

/// A square, and slivers lower than a step of a float, each a chart of its own.
struct Slivers
{
	SurfaceMesh mesh = rectangle(1, 1, 1.0, 1.0);
	Parametrization map;

	/// \param width of the slivers
	explicit Slivers(double width)
	{
		for (int i = 0; i < kSlivers; ++i)
			mesh = sideBySide(
				mesh,
				SurfaceMesh{{{0, 0, 0}, {width, 0, 0}, {0.5 * width, 1e-9 * i, 0}}, {{0, 1, 2}}},
				2.0 + i);
		for (const Triangle& t : mesh.triangles) {
			const auto place = [&](std::size_t k) {
				const Point3& p = mesh.positions[at(t[k])];
				return Point2{p[0], p[1]};
			};
			map.uv.push_back({place(0), place(1), place(2)});
		}
		map.reversed.assign(map.uv.size(), 0);
		map.charts.resize(1 + kSlivers);
		map.charts[0].faces = {0, 1};
		for (int i = 0; i < kSlivers; ++i)
			map.charts[at(1 + i)].faces = {2 + i};
	}
};

/// Puts boxes in one column that begins at \p x.
PlaceBoxes inAColumn(double x)
{
	return [x](const std::vector<Box2>& boxes, double) {
		std::vector<Point2> shifts;
		double y = 0.0;
		for (const Box2& box : boxes) {
			shifts.push_back({x - box.min[0], y - box.min[1]});
			y += box.height();
		}
		return shifts;
	};
}

TEST(FinishInFloats, MendsTrianglesThatAreChartsOfTheirOwn)
{
	const Slivers slivers(0.9);
	for (const bool normalize : {false, true}) {
		Parametrization packed = slivers.map;
		packCharts(packed, normalize, 0.0, inAColumn(0.0));
		ASSERT_EQ(turnedIn(packed), kSlivers);
		finishInFloats(
			slivers.mesh, nullptr, false, packed);
		EXPECT_EQ(turnedIn(packed), 0);
		EXPECT_EQ(packed.report.finishMoved, 3 * kSlivers);
		for (const Chart& chart : packed.charts)
			for (const int f : chart.faces)
				for (const Point2& p : packed.uv[at(f)])
					EXPECT_TRUE(chart.box.contains(p));
	}
}

TEST(FinishInFloats, GivesChartsTheRoomThatTheyNeed)
{
	const Slivers slivers(0.9);
	Parametrization tight = slivers.map;
	packCharts(tight, true, 0.0, inAColumn(0.0));
	for (Chart& chart : tight.charts) {
		chart.box = {};
		for (const int f : chart.faces)
			for (const Point2& p : tight.uv[at(f)])
				chart.box.add(p);
	}
	Parametrization kept = tight;
	finishInFloats(slivers.mesh, nullptr, false, kept);
	EXPECT_GT(turnedIn(kept), 0);
	int packings = 0;
	const auto packAgain = [&] {
		EXPECT_EQ(turnedIn(tight), 0);
		packCharts(tight, true, 0.0, inAColumn(0.0));
		++packings;
	};
	finishInFloats(slivers.mesh, packAgain, false, tight);
	EXPECT_EQ(turnedIn(tight), 0);
	EXPECT_EQ(packings, 1);
}

/// Points that move lie on floats, and these beyond the border of a box by less than a step.
TEST(FinishInFloats, MendsChartsWhoseBoxesEndBetweenFloats)
{
	const Slivers slivers(0.001);
	for (const double x : {8.01, 8.02, 8.03, 8.04}) {
		Parametrization packed = slivers.map;
		packCharts(packed, false, 0.0, inAColumn(x));
		ASSERT_EQ(turnedIn(packed), kSlivers);
		finishInFloats(
			slivers.mesh, nullptr, false, packed);
		EXPECT_EQ(turnedIn(packed), 0);
		for (Chart& chart : packed.charts) {
			for (Point2* corner : {&chart.box.min, &chart.box.max})
				for (double& c : *corner)
					c += corner == &chart.box.min ? -0x1p-20 : 0x1p-20;
			for (const int f : chart.faces)
				for (const Point2& p : packed.uv[at(f)])
					EXPECT_TRUE(chart.box.contains(p));
		}
	}
}

} // namespace
} // namespace ricci::testing
