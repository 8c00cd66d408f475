// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"
#include "support/random.h"

#include <ricci/base/numbers.h>
#include <ricci/base/points.h>
#include <ricci/charts/finish_in_floats.h>
#include <ricci/charts/pack.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace ricci::testing {
namespace {

constexpr int kSide = 24; // squares along a side

bool isUpright(const Triangle2& p)
{
	Triangle2 stored = p;
	for (Point2& q : stored)
		for (double& x : q)
			x = roundedToFloat(x);
	return orientation(stored[0], stored[1], stored[2]) > 0;
}

int flippedInFloats(const Parametrization& map)
{
	const Array<Triangle2> plane = map.mesh.corners();
	return static_cast<int>(std::count_if(
		plane.begin(), plane.end(), [](const Triangle2& p) { return !isUpright(p); }));
}

void finish(Parametrization& map, const std::function<void()>& packAgain = nullptr)
{
	FloatRules rules;
	rules.mayCut = static_cast<bool>(packAgain);
	FloatRepair repair;
	for (int packings = 1; packings == 1 || repair.needsPacking; ++packings) {
		rules.mayGrow = packings < 4;
		repair = repairInFloats(rules, map);
		map.report.finishMoved += repair.moved;
		if (repair.needsPacking && packAgain)
			packAgain();
	}
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
		const Parametrization before = mapWith(flatMesh(mesh, vertex, place));
		ASSERT_GT(flippedInFloats(before), 0);
		Parametrization map = before;
		finish(map);
		EXPECT_EQ(flippedInFloats(map), 0);
		EXPECT_GT(map.report.finishMoved, 0);
		for (int c = 0; c < 3 * map.mesh.size(); ++c) {
			const Point3& p = mesh.positions[at(map.mesh.vertices[Corner(c)])];
			if (std::max(std::abs(p[0] - own[0]), std::abs(p[1] - own[1])) > 5.5 / kSide) {
				EXPECT_EQ(map.mesh.at(Corner(c)), before.mesh.at(Corner(c)));
			}
		}
	}
}

TEST(FinishInFloats, MendsWhatSmallPatchesInsideDoNot)
{
	// A corner of the border lies inside: what is inside the chart cannot make room alone.
	const SurfaceMesh mesh = rectangle(kSide, kSide, 1.0, 1.0);
	Parametrization map = mapWith(flatMesh(mesh, 0, {1.5 / kSide, 1.4 / kSide}));
	ASSERT_GT(flippedInFloats(map), 0);
	finish(map);
	EXPECT_EQ(flippedInFloats(map), 0);
}

constexpr int kSlivers = 7;

/// A square, and slivers lower than a step of a float, each a chart of its own.
struct Slivers
{
	Parametrization map;

	/// \param width of the slivers
	explicit Slivers(double width)
	{
		SurfaceMesh mesh = rectangle(1, 1, 1.0, 1.0);
		for (int i = 0; i < kSlivers; ++i)
			mesh = sideBySide(
				mesh,
				SurfaceMesh{{{0, 0, 0}, {width, 0, 0}, {0.5 * width, 1e-9 * i, 0}}, {{0, 1, 2}}},
				2.0 + i);
		FlatMesh flat = flatMesh(mesh);
		for (const int f : flat.chart.indices())
			flat.chart[f] = std::max(0, f - 1);
		map = mapWith(flat);
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
		packCharts(packed, {normalize, 0.0, inAColumn(0.0)}, ChartTurns::None);
		ASSERT_EQ(flippedInFloats(packed), kSlivers);
		finish(packed);
		EXPECT_EQ(flippedInFloats(packed), 0);
		EXPECT_EQ(packed.report.finishMoved, 3 * kSlivers);
		for (const int f : packed.mesh.points.indices())
			for (const Point2& p : packed.mesh.at(f))
				EXPECT_TRUE(packed.charts[at(packed.mesh.chart[f])].box.contains(p));
	}
}

/// Points that move lie on floats, and these beyond the border of a box by less than a step.
TEST(FinishInFloats, MendsChartsWhoseBoxesEndBetweenFloats)
{
	const Slivers slivers(0.001);
	for (const double x : {8.01, 8.02, 8.03, 8.04}) {
		Parametrization packed = slivers.map;
		packCharts(packed, {false, 0.0, inAColumn(x)}, ChartTurns::None);
		ASSERT_EQ(flippedInFloats(packed), kSlivers);
		finish(packed);
		EXPECT_EQ(flippedInFloats(packed), 0);
		for (const int f : packed.mesh.points.indices()) {
			Box2 box = packed.charts[at(packed.mesh.chart[f])].box;
			for (Point2* corner : {&box.min, &box.max})
				for (double& c : *corner)
					c += corner == &box.min ? -0x1p-20 : 0x1p-20;
			for (const Point2& p : packed.mesh.at(f))
				EXPECT_TRUE(box.contains(p));
		}
	}
}

} // namespace
} // namespace ricci::testing
