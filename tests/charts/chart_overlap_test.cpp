// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/charts/chart_overlap.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace ricci::testing {
namespace {

/// Triangles round a vertex that go round it by \p angle, to the distances \p radius(i).
template<class Radius>
SurfaceMesh fan(int n, double angle, const Radius& radius)
{
	SurfaceMesh mesh;
	mesh.positions.push_back({0, 0, 0});
	for (int i = 0; i <= n; ++i) {
		const double a = angle * i / n, r = radius(i);
		mesh.positions.push_back({r * std::cos(a), r * std::sin(a), 0});
		if (i < n)
			mesh.triangles.push_back({0, 1 + i, 2 + i});
	}
	return mesh;
}

/// All triangles of a fan have its apex in common, so that the boxes in a quarter meet in pairs. Those
/// that overlap are few.
TEST(ChartOverlap, OfAFanTakesHardlyMoreStepsThanItHasTriangles)
{
	Random random(403);
	std::vector<double> radii(16001);
	for (double& r : radii)
		r = random.real(0.1, 1.0);
	for (int kind = 0; kind < 4; ++kind) {
		std::array<double, 2> steps{};
		for (const int n : {4000, 16000}) {
			const bool isRound = kind % 2 == 0;
			SurfaceMesh mesh = fan(n, 7.0, [&](int i) { return isRound ? 1.0 : radii[at(i)]; });
			if (kind > 1) // a triangle is flipped
				std::swap(mesh.triangles[at(n / 3)][1], mesh.triangles[at(n / 3)][2]);
			const FlatMesh chart = flatMesh(mesh);
			const OverlapSearch search(chart.corners());
			EXPECT_EQ(OverlapSearch(chart).pairs(), search.pairs()) << kind;
			// 7 - 2 pi of the angle is covered twice, where each triangle meets two others.
			const double twice = n * (1.0 - 2 * kPi / 7.0);
			EXPECT_NEAR(static_cast<double>(search.pairs().size()), 2 * twice, 4.0) << kind;
			steps[n == 4000 ? 0 : 1] = static_cast<double>(search.steps());
		}
		EXPECT_LT(steps[1], (kind % 2 == 0 ? 5.0 : 8.0) * steps[0]) << kind; // n^2: 16 times
	}
}

/// With the outlines of nodes, from which on none are compared.
TEST(ChartOverlap, OfFansIsWhatAllPairsGive)
{
	Random random(404);
	for (const double angle : {3.0, 6.2, 7.0, 20.0, 100.0}) {
		SurfaceMesh mesh = fan(700, angle, [&](int) { return random.real(0.05, 1.0); });
		const SurfaceMesh other = fan(300, 6.0, [&](int) { return random.real(0.05, 1.0); });
		const bool isStacked = angle > 50.0;
		mesh = sideBySide(mesh, other, isStacked ? 0.3 : 1.8);
		const FlatMesh chart = flatMesh(mesh);
		const double touching = 1e-9 * boxTreeOf(chart.corners()).extent();
		std::vector<TrianglePair> pairs;
		Array<char> isIn(chart.size(), 0);
		for (const int i : chart.points.indices())
			for (const int j : chart.points.indices())
				if (i < j && overlap(chart.at(i), chart.at(j), touching)) {
					pairs.push_back({i, j});
					isIn[i] = isIn[j] = 1;
				}
		const OverlapSearch search(chart.corners());
		EXPECT_EQ(search.isComplete(), !isStacked);
		EXPECT_EQ(search.overlapping(), isIn) << angle;
		if (!isStacked) {
			EXPECT_GT(search.steps(), 64 * chart.size());
			EXPECT_EQ(search.pairs(), pairs) << angle;
		}
		else {
			ASSERT_EQ(search.pairs().size(), 1u);
			EXPECT_EQ(std::count(pairs.begin(), pairs.end(), search.pairs().front()), 1);
			EXPECT_GT(pairs.size(), at(chart.size()));
		}
	}
}

/// Sheets of a screw, some of them with moved points so that the triangles are of many shapes and none is flipped.
/// What lies over itself far from the border is found by way of what lies between: all pairs, without looking at
/// all triangles.
TEST(ChartOverlap, OfARingIsFollowedToAllPairs)
{
	Random random(405);
	for (const double turns : {0.9, 1.02, 1.4, 2.7})
		for (const double wobble : {0.0, 0.3}) {
			const int around = static_cast<int>(200 * turns), across = 40;
			FlatMesh chart = flatMesh(screw(turns, around, across));
			for (Point2& p : chart.place)
				for (double& x : p)
					x += wobble * random.real(-1.0, 1.0) / around;
			const OverlapSearch all(chart.corners()), followed(chart);
			EXPECT_EQ(followed.pairs(), all.pairs()) << turns;
			EXPECT_EQ(all.pairs().empty(), turns < 1.0) << turns;
			EXPECT_TRUE(followed.isComplete());
			// That all are not compared shows where few of them overlap.
			if (turns < 1.1) {
				EXPECT_LT(2 * followed.steps(), all.steps()) << turns;
			}
		}
}

/// A corner is so far away that all sheets lie within the rounding of the chart.
TEST(ChartOverlap, ManySheetsThatOnlyTouchAreNotFollowedThroughAllTheirPairs)
{
	const int turns = 40, around = 25 * turns, across = 20;
	const SurfaceMesh strip = screw(turns, around, across);
	FlatMesh chart = flatMesh(strip);
	chart.place.back() = {1e12, 1e12};
	const OverlapSearch followed(chart);
	EXPECT_TRUE(followed.pairs().empty());
	EXPECT_TRUE(followed.isComplete());
	EXPECT_LT(followed.steps(), 250 * chart.size());
}

} // namespace
} // namespace ricci::testing
