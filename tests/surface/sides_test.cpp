// SPDX-License-Identifier: GPL-3.0-or-later
#include <ricci/surface/sides.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

/// The edges in order, each with its sides.
std::vector<std::vector<Corner>> edgesOf(const Sides& sides)
{
	std::vector<std::vector<Corner>> edges;
	sides.forEdges([&](const auto& edge) { edges.emplace_back(edge.begin(), edge.end()); });
	return edges;
}

} // namespace

TEST(Corner, StepsRoundItsTriangle)
{
	for (const int f : {0, 1, 7}) {
		EXPECT_EQ(Corner(f, 0).number(), 3 * f);
		for (const Corner c : cornersOf(f)) {
			EXPECT_EQ(c.face(), f);
			EXPECT_EQ(c.next().face(), f);
			EXPECT_EQ(c.next().index(), (c.index() + 1) % 3);
			EXPECT_EQ(c.next().previous(), c);
			EXPECT_EQ(c.next().next(), c.previous());
		}
	}
}

TEST(Corner, FindsWhatArraysHoldForCorners)
{
	Array<std::array<int, 3>> triangles{{4, 5, 6}, {7, 8, 9}};
	EXPECT_EQ(triangles[Corner(1, 2)], 9);
	triangles[Corner(0, 1)] = 0;
	EXPECT_EQ(triangles[0][1], 0);
}

TEST(Sides, AreFoundByEdge)
{
	// Three triangles at the edge 12, the second against the first; a fourth at 23.
	const std::vector<Triangle> triangles{{1, 2, 0}, {3, 2, 1}, {1, 2, 9}, {4, 2, 3}};
	const Sides sides(triangles);
	const auto edges = edgesOf(sides);
	ASSERT_EQ(edges.size(), 9U);
	int count = 0;
	std::pair<int, int> last{-1, -1};
	for (const auto& edge : edges) {
		ASSERT_FALSE(edge.empty());
		std::pair<int, int> own;
		for (const Corner c : edge) {
			const Triangle& t = triangles[positionOf(c.face())];
			const std::pair<int, int> ends = std::minmax({t[c.index()], t[c.next().index()]});
			EXPECT_TRUE(c == *edge.begin() || own == ends);
			own = ends;
			++count;
		}
		EXPECT_LT(last, own);
		EXPECT_TRUE(std::is_sorted(edge.begin(), edge.end()));
		last = own;
	}
	EXPECT_EQ(count, 12);
	EXPECT_EQ(edges[2], (std::vector<Corner>{Corner(0, 0), Corner(1, 1), Corner(2, 0)}));
}

TEST(Sides, AreJoinedInPairsThatRunOppositeWays)
{
	// 12 has three sides; 23 has two that run opposite ways, 34 two that run the same way.
	const Sides sides({{1, 2, 0}, {3, 2, 1}, {1, 2, 9}, {2, 3, 4}, {3, 4, 5}});
	EXPECT_EQ(sides.across(Corner(1, 0)), Corner(3, 0));
	EXPECT_EQ(sides.across(Corner(3, 0)), Corner(1, 0));
	int joined = 0;
	for (int f = 0; f < 5; ++f)
		for (const Corner c : cornersOf(f))
			joined += sides.across(c).isValid();
	EXPECT_EQ(joined, 2);
	EXPECT_TRUE(edgesOf(Sides({})).empty());
}

} // namespace ricci::testing
