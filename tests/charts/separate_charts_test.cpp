// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shapes.h"

#include <ricci/charts/separate_charts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace ricci::testing {
namespace {

constexpr int kSide = 6; // squares along a side, two triangles each, row by row

/// The unit square as its own map, one chart.
Parametrization squareMap()
{
	Parametrization map;
	map.opened.mesh = rectangle(kSide, kSide, 1.0, 1.0);
	for (const Triangle& t : map.opened.mesh.triangles) {
		Triangle2 corners;
		for (std::size_t k = 0; k < 3; ++k) {
			const Point3& p = map.opened.mesh.positions[at(t[k])];
			corners[k] = {p[0], p[1]};
		}
		map.uv.push_back(corners);
	}
	map.reversed.assign(map.uv.size(), 0);
	Chart chart;
	chart.faces.resize(map.uv.size());
	std::iota(chart.faces.begin(), chart.faces.end(), 0);
	map.charts.push_back(chart);
	map.report.charts = 1;
	return map;
}

/// A column of squares off a square leaves it in two parts, with two cuts as long as a side.
TEST(CutOff, MakesAChartOfEachConnectedPart)
{
	Parametrization map = squareMap();
	const std::vector<Triangle2> before = map.uv;
	std::vector<char> isOff(map.uv.size(), 0);
	for (std::size_t f = 0; f < map.uv.size(); ++f) {
		const double middle = (map.uv[f][0][0] + map.uv[f][1][0] + map.uv[f][2][0]) / 3.0;
		isOff[f] = std::floor(kSide * middle) == 2.0;
	}
	ASSERT_EQ(std::count(isOff.begin(), isOff.end(), 1), 2 * kSide);
	EXPECT_TRUE(cutOff(isOff, map));
	ASSERT_EQ(map.charts.size(), 3u);
	EXPECT_EQ(map.report.charts, 3);
	EXPECT_EQ(map.report.overlapCuts, 2 * kSide);
	EXPECT_NEAR(map.report.seamLength, 2.0, 1e-14);
	EXPECT_NEAR(map.report.seamLengthRelative, 2.0, 1e-14);
	std::vector<std::size_t> sizes;
	std::vector<int> times(map.uv.size(), 0);
	for (const Chart& chart : map.charts) {
		sizes.push_back(chart.faces.size());
		for (const int f : chart.faces) {
			++times[at(f)];
			EXPECT_EQ(isOff[at(f)], isOff[at(chart.faces.front())]);
			for (std::size_t k = 0; k < 3; ++k)
				for (std::size_t i = 0; i < 2; ++i)
					EXPECT_NEAR(
						map.uv[at(f)][k][i] - map.uv[at(f)][0][i],
						before[at(f)][k][i] - before[at(f)][0][i],
						1e-15);
		}
	}
	std::sort(sizes.begin(), sizes.end());
	EXPECT_EQ(sizes, (std::vector<std::size_t>{2 * kSide, 4 * kSide, 6 * kSide}));
	EXPECT_EQ(std::count(times.begin(), times.end(), 1), std::ptrdiff_t(times.size()));
}

TEST(CutOff, LeavesChartsOfOneKind)
{
	for (const bool kind : {false, true}) {
		Parametrization map = squareMap();
		const std::vector<Triangle2> before = map.uv;
		EXPECT_FALSE(cutOff(std::vector<char>(map.uv.size(), kind ? 1 : 0), map));
		EXPECT_EQ(map.charts.size(), 1u);
		EXPECT_EQ(map.report.overlapCuts, 0);
		EXPECT_EQ(map.uv, before);
	}
}

} // namespace
} // namespace ricci::testing
