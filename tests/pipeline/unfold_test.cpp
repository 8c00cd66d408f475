// SPDX-License-Identifier: GPL-3.0-or-later
#include "../support/flat_map.h"
#include "../support/intrinsic.h"
#include "../support/listener.h"
#include "../support/random_surface.h"
#include "../support/shapes.h"

#include <ricci/base/memory_estimate.h>
#include <ricci/base/numbers.h>
#include <ricci/base/task.h>
#include <ricci/charts/chart_overlap.h>
#include <ricci/measure/distortion.h>
#include <ricci/pipeline/flatten.h>
#include <ricci/pipeline/flatten_steps.h>
#include <ricci/pipeline/whole_map.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kFlat = 0.25; // of the curvature at most lies between creases

void expectIsometric(const Parametrization& map)
{
	for (const int f : map.mesh.points.indices())
		for (const Corner side : cornersOf(f)) {
			const auto [p, q] = map.mesh.ends(side);
			EXPECT_NEAR(distance(p, q), map.mesh.lengths[side], 1e-9);
		}
	EXPECT_NEAR(stretchEnergy(map.mesh), 4.0, 1e-9);
	for (const std::vector<int>& chart : map.mesh.trianglesByChart(map.charts.size()))
		EXPECT_TRUE(overlappingPairs(map.mesh.part(chart)).empty());
}

/// A box is its net: of the 12 edges 5 are joined, the longest that make a tree of its faces.
TEST(Unfold, ABoxIsItsNet)
{
	const SurfaceMesh box = perforatedSlab(0, 4);
	const std::optional<Parametrization> map = unfold(onlyComponent(box), Options(), kFlat);
	ASSERT_TRUE(map);
	expectIsometric(*map);
	EXPECT_EQ(map->charts.size(), 1u);
	// Eight corners of a quarter of 4 pi each, nothing elsewhere.
	int corners = 0;
	double sum = 0.0;
	for (const double k : map->targetCurvature) {
		corners += k != 0.0;
		sum += k;
		EXPECT_NEAR(std::abs(k - 0.25 * kPi), 0.25 * kPi, 1e-9); // 0 or pi / 2
	}
	EXPECT_EQ(corners, 8);
	EXPECT_EQ(map->report.cones, 8);
	EXPECT_NEAR(sum, 4.0 * kPi, 1e-9);
	EXPECT_EQ(map->report.components, 1);
	EXPECT_EQ(map->report.eulerCharacteristic, 2);
	const Seams seam = seams(map->mesh);
	EXPECT_EQ(at(map->report.seamEdges), seam.edges.size());
	EXPECT_DOUBLE_EQ(map->report.seamLength, seam.length);
}

/// Wall, bottom and lid of a cylinder touch in one edge each then.
TEST(Unfold, ACylinderIsItsWallWithTwoLids)
{
	constexpr int kSides = 16;
	const SurfaceMesh mesh = revolved({{0.0, 0.0}, {1.0, 0.0}, {1.0, 3.0}, {0.0, 3.0}}, kSides);
	const std::optional<Parametrization> map = unfold(onlyComponent(mesh), Options(), kFlat);
	ASSERT_TRUE(map);
	expectIsometric(*map);
	EXPECT_EQ(map->charts.size(), 1u);
	const double side = 2.0 * std::sin(kPi / kSides);
	EXPECT_NEAR(map->report.seamLength, 2.0 * (kSides - 1) * side + 3.0, 1e-9);
}

TEST(Unfold, LeavesRoundSurfacesToTheFlow)
{
	EXPECT_FALSE(unfold(onlyComponent(torus(2.0, 1.0, 40, 20)), Options(), kFlat));
	EXPECT_FALSE(unfold(onlyComponent(ring(1.0, 2.0, 30, 5)), Options(), kFlat));
}

/// A dome has half of its curvature at its rim, half between.
TEST(Unfold, TakesAsMuchCurvatureAsItMay)
{
	std::vector<std::array<double, 2>> profile{{0.0, 0.0}};
	for (int i = 0; i <= 8; ++i)
		profile.push_back({std::cos(i * kPi / 16.0), std::sin(i * kPi / 16.0)});
	const Component dome = onlyComponent(revolved(profile, 32));
	EXPECT_FALSE(unfold(dome, Options(), 0.4));
	const std::optional<Parametrization> map = unfold(dome, Options(), 0.6);
	ASSERT_TRUE(map);
	EXPECT_EQ(map->report.charts, 1); // dome and floor, joined
	EXPECT_GT(stretchEnergy(map->mesh), 4.0 + 1e-3);
	Report report;
	countFlipped(map->mesh, report);
	EXPECT_EQ(report.flippedFaces, 0);
}

/// Of both maps the one that costs less is given back.
TEST(Unfold, IsTakenWhereItCostsLess)
{
	const SurfaceMesh box = perforatedSlab(2, 4);
	const std::optional<Parametrization> unfolded = unfold(onlyComponent(box), Options(), kFlat);
	ASSERT_TRUE(unfolded);
	const FlatResult given = run(box, Options());
	Options placed;
	placed.target = TargetCurvature::PlacedCones;
	const FlatResult whole = run(box, placed);
	const double cost = costOf(given).total();
	EXPECT_LE(cost, costOf(whole).total() + 1e-9);
	EXPECT_LE(cost, costOf(*unfolded).total() + 1e-9);
}

/// With memory for one map at a time they are the same; with less there is none, and the log says so.
TEST(Unfold, TakesNoMoreMemoryThanThereIs)
{
	Listener log;
	const SurfaceMesh slab = perforatedSlab(2, 8);
	const std::size_t faces = slab.triangles.size();
	const Component component = onlyComponent(slab);
	Task task(log);
	const std::optional<Parametrization> map = unfold(component, Options(), kFlat);
	ASSERT_TRUE(map);
	task.setMemoryLimit(1.7 * estimatedMemory(faces, faces, false));
	const std::optional<Parametrization> again = unfold(component, Options(), kFlat);
	ASSERT_TRUE(again);
	EXPECT_EQ(again->mesh.place.values(), map->mesh.place.values());
	EXPECT_TRUE(log.lines.empty());
	task.setMemoryLimit(1.1 * estimatedMemory(faces, faces, false));
	EXPECT_FALSE(unfold(component, Options(), kFlat));
	EXPECT_EQ(log.count("There is not enough memory to unfold"), 1);
}

/// What the other map says while the first stages run is in the log, with any number of threads.
TEST(Unfold, WhatIsSaidBesideTheFirstStagesIsLogged)
{
	const SurfaceMesh body = revolved({{0, -1}, {1, -0.5}, {1.5, 0.5}, {0, 1}}, 400);
	for (const bool isLarge : {false, true}) {
		Listener listener;
		const Task task(listener);
		const auto alternative = [](double cost) {
			if (cost == 0.0)
				logLine("No other map");
			return kNoAlternative;
		};
		const SurfaceMesh small = revolved({{0, -1}, {1, -0.5}, {0, 1}}, 6);
		flattenToPlane(onlyComponent(isLarge ? body : small), {}, Options(), alternative);
		EXPECT_EQ(listener.count("No other map"), 1);
	}
}

/// No flow where another map, made once it is known what this one is expected to cost, costs less than that.
/// The progress of that is what the flow's would be.
TEST(Unfold, EndsWhatIsExpectedToCostMore)
{
	const Component body = onlyComponent(revolved({{0, -1}, {1, -0.5}, {1.5, 0.5}, {0, 1}}, 12));
	Listener listener;
	const Task task(listener);
	std::vector<double> asked;
	const auto flattened = [&](double factor) {
		asked.clear();
		return flattenToPlane(body, {}, Options(), [&](double cost) {
			asked.push_back(cost);
			advance(1.0, "Another map");
			return cost > 0.0 ? factor * cost : kNoAlternative;
		});
	};
	EXPECT_FALSE(flattened(0.99));
	EXPECT_EQ(listener.fractions.back(), 1.0 - kAfterFlow);
	EXPECT_LT(*std::prev(listener.fractions.end(), 2), kBeforeFlow);
	ASSERT_EQ(asked.size(), 2u);
	EXPECT_EQ(asked.front(), 0.0);
	const double expected = asked.back();
	EXPECT_GT(expected, 4.0);
	const std::optional<ComponentMap> map = flattened(1.01);
	ASSERT_TRUE(map);
	ASSERT_TRUE(map->flow.target.expected);
	EXPECT_EQ(asked, (std::vector<double>{0.0, expected}));
}

} // namespace
} // namespace ricci::testing
