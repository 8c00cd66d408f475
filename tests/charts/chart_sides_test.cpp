// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/charts/chart_sides.h>

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

std::pair<int, int> verticesOf(const DrawnChart& chart, int side)
{
	const Triangle& t = chart.triangles[side / 3];
	return {t[at(side % 3)], t[at((side + 1) % 3)]};
}

/// All pairs of sides are compared, whatever the numbers of the vertices.
TEST(ChartSides, AreMatchedByTheirVertices)
{
	Random random(1200);
	for (const int stretch : {1, 1000000}) {
		const SurfaceMesh mesh = rectangle(7, 5, 7.0, 5.0);
		DrawnChart chart;
		for (const Triangle& t : mesh.triangles) {
			if (random.index(5) == 0)
				continue; // holes
			Triangle2 p;
			for (std::size_t k = 0; k < 3; ++k)
				p[k] = {mesh.positions[at(t[k])][0], mesh.positions[at(t[k])][1]};
			chart.triangles.push_back({t[0] * stretch, t[1] * stretch, t[2] * stretch});
			chart.plane.push_back(p);
		}
		const ChartSides sides{
			sidesAcross(chart),
			Array<std::array<double, 3>>(chart.triangles.size(), {1.0, 2.0, 3.0})};
		ASSERT_EQ(sides.across.size(), 3 * chart.triangles.size());
		int matched = 0;
		for (const int s : sides.across.indices()) {
			EXPECT_EQ(nextSide(previousSide(s)), s);
			EXPECT_EQ(sides.lengthOf(s), 1.0 + s % 3);
			const auto [a, b] = verticesOf(chart, s);
			int across = -1;
			for (int t = 0; t < sides.across.size(); ++t)
				if (verticesOf(chart, t) == std::pair(b, a))
					across = t;
			EXPECT_EQ(sides.across[s], across);
			matched += across >= 0;
		}
		EXPECT_GT(matched, 20);
		EXPECT_LT(matched, sides.across.size());
	}
}

/// Three triangles at one edge: two of them lie at one place.
TEST(ChartSides, OfMoreThanTwoTrianglesAreMatchedByTheirPlaces)
{
	DrawnChart chart;
	chart.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
	const Point2 a{0, 0}, b{1, 0}, up{0.5, 1}, down{0.5, -1};
	chart.plane = {
		Triangle2{Point2{9, 0}, Point2{10, 0}, Point2{9.5, 1}},
		Triangle2{b, a, down},
		Triangle2{a, b, up}};
	const Array<int> across = sidesAcross(chart);
	EXPECT_EQ(across[0], -1);
	EXPECT_EQ(across[3], 6);
	EXPECT_EQ(across[6], 3);
}

} // namespace
} // namespace ricci::testing
