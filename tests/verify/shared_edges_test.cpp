// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shapes.h"

#include <ricci/verify/shared_edges.h>

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

/// A drawing that tells every corner of every triangle from all others.
std::vector<Triangle2> markedCorners(const std::vector<Triangle>& triangles)
{
	std::vector<Triangle2> plane;
	for (std::size_t f = 0; f < triangles.size(); ++f)
		plane.push_back(
			{Point2{static_cast<double>(triangles[f][0]), static_cast<double>(f)},
			 Point2{static_cast<double>(triangles[f][1]), static_cast<double>(f)},
			 Point2{static_cast<double>(triangles[f][2]), static_cast<double>(f)}});
	return plane;
}

TEST(SharedEdges, EverySideHasTheCornersOfItsTriangleInTheOrderOfTheirNumbers)
{
	const SurfaceMesh mesh = torus(2, 1, 7, 5);
	const std::vector<PlaneSide> sides = planeSides(mesh.triangles, markedCorners(mesh.triangles));
	ASSERT_EQ(sides.size(), 3 * mesh.triangles.size());
	for (std::size_t i = 0; i < sides.size(); ++i) {
		EXPECT_LT(sides[i].low, sides[i].high);
		EXPECT_EQ(sides[i].atLow, (Point2{double(sides[i].low), double(i / 3)}));
		EXPECT_EQ(sides[i].atHigh, (Point2{double(sides[i].high), double(i / 3)}));
	}
}

/// Each edge inside once, with its two triangles; those of the boundary, or of three triangles, never.
TEST(SharedEdges, AreTheEdgesOfExactlyTwoTriangles)
{
	SurfaceMesh fin = tetrahedron();
	fin.positions.push_back({0, 0, 5});
	fin.triangles.push_back({0, 1, 4});
	const struct
	{
		SurfaceMesh mesh;
		std::size_t edges, shared;
	} cases[] = {
		{tetrahedron(), 6, 6},
		{torus(2, 1, 7, 5), 105, 105},        // 3 F / 2
		{rectangle(4, 3, 1, 1), 43, 43 - 14}, // 4 x 4 + 5 x 3 + 4 x 3, round it 14
		{fin, 8, 5}};
	for (const auto& c : cases) {
		std::vector<PlaneSide> sides =
			planeSides(c.mesh.triangles, markedCorners(c.mesh.triangles));
		std::size_t edges = 0, seen = 0;
		forEdgesOf(sides, [&](std::size_t, std::size_t count) {
			++edges;
			seen += count;
		});
		EXPECT_EQ(edges, c.edges);
		EXPECT_EQ(seen, sides.size());
		std::set<std::pair<int, int>> shared;
		forSharedEdges(sides, [&](const PlaneSide& a, const PlaneSide& b) {
			EXPECT_EQ(a.low, b.low);
			EXPECT_EQ(a.high, b.high);
			EXPECT_NE(a.atLow[1], b.atLow[1]); // two triangles
			EXPECT_TRUE(shared.emplace(a.low, a.high).second);
		});
		EXPECT_EQ(shared.size(), c.shared);
	}
}

} // namespace
} // namespace ricci::testing
