// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"

#include <ricci/charts/separate_charts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

constexpr int kSide = 6; // squares along a side, two triangles each, row by row

/// The unit square as its own map, one chart.
Parametrization squareMap()
{
	return mapWith(flatMesh(rectangle(kSide, kSide, 1.0, 1.0)));
}

/// A column of squares off a square leaves it in two parts, and each of its triangles by itself.
TEST(CutOff, MakesAChartOfEachTriangleAndOfEachConnectedPart)
{
	Parametrization map = squareMap();
	const Array<Triangle2> before = map.mesh.corners();
	std::vector<int> off;
	for (const int f : before.indices()) {
		const Triangle2& p = before[f];
		if (std::floor(kSide * (p[0][0] + p[1][0] + p[2][0]) / 3.0) == 2.0)
			off.push_back(f);
	}
	ASSERT_EQ(off.size(), std::size_t(2 * kSide));
	cutOff(off, map);
	ASSERT_EQ(map.charts.size(), std::size_t(2 * kSide + 2));
	EXPECT_EQ(map.report.overlapCuts, 4 * kSide - 1);
	EXPECT_NEAR(map.report.seamLength, 3.0 - 1.0 / kSide + std::sqrt(2.0), 1e-14);
	std::vector<std::size_t> sizes;
	for (const std::vector<int>& chart : map.mesh.trianglesByChart(map.charts.size())) {
		sizes.push_back(chart.size());
		for (const int f : chart)
			for (std::size_t k = 0; k < 3; ++k)
				for (std::size_t i = 0; i < 2; ++i)
					EXPECT_NEAR(
						map.mesh.at(f)[k][i] - map.mesh.at(f)[0][i],
						before[f][k][i] - before[f][0][i],
						1e-15);
	}
	std::sort(sizes.begin(), sizes.end());
	std::vector<std::size_t> wanted(2 * kSide, 1);
	wanted.insert(wanted.end(), {4 * kSide, 6 * kSide});
	EXPECT_EQ(sizes, wanted);
	// The columns beside the cuts, and the triangles between them, have points of their own.
	EXPECT_EQ(map.mesh.place.size(), (kSide + 1) * (kSide + 1) + 6 * kSide);
}

/// What is joined elsewhere takes nothing from what is cut.
TEST(CountCuts, CountsTheEdgesThatAreCut)
{
	Parametrization map = squareMap();
	const auto cutAt = [&](double x) {
		for (const int f : map.mesh.chart.indices()) {
			const Triangle2 p = map.mesh.at(f);
			map.mesh.chart[f] = (p[0][0] + p[1][0] + p[2][0]) / 3.0 > x;
		}
		splitPoints(map.mesh);
	};
	cutAt(0.5);
	const Seams before = seams(map.mesh);
	EXPECT_EQ(before.edges.size(), std::size_t(kSide));
	map.mesh = squareMap().mesh;
	map.report.seamEdges = kSide + 2;
	countCuts(before, map);
	EXPECT_EQ(map.report.overlapCuts, 0);
	EXPECT_EQ(map.report.seamEdges, 2);
	EXPECT_NEAR(map.report.seamLength, -1.0, 1e-14);
	cutAt(1.0 / 3.0);
	countCuts(before, map);
	EXPECT_EQ(map.report.overlapCuts, kSide);
	EXPECT_NEAR(map.report.seamLength, -1.0, 1e-14);
}

} // namespace
} // namespace ricci::testing
