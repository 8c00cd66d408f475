// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/cut/circle_paths.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Distances from \p from along edges that avoid \p closed, by Bellman and Ford.
VertexArray<double> distancesFrom(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	Vertex from,
	const std::vector<Vertex>& closed)
{
	VertexArray<double> d(t.vertexCount(), kFar);
	d[from] = 0.0;
	for (bool changed = true; changed;) {
		changed = false;
		for (const Halfedge h : t.halfedges()) {
			const Vertex v = t.origin(h), w = t.target(h);
			const bool isOpen =
				v == from || std::find(closed.begin(), closed.end(), v) == closed.end();
			if (isOpen && d[v] + lengths[h.edge()] < d[w]) {
				d[w] = d[v] + lengths[h.edge()];
				changed = true;
			}
		}
	}
	return d;
}

int splitCircles(CirclePaths& paths)
{
	paths.labelCircles();
	return paths.splitCircles({});
}

/// A closed surface with three marks and no cut: each mark is a circle of its own.
struct ThreeMarks
{
	explicit ThreeMarks(Random& random) :
			p(shaken(perforatedSlab(1, 3), 0.05, random)), t(p.triangulation),
			marked(t.vertexCount(), 0), isCut(t.edgeCount(), 0)
	{
		while (marks.size() < 3)
			if (const Vertex v(random.index(t.vertexCount())); !marked[v]) {
				marked[v] = 1;
				marks.push_back(v);
			}
		std::sort(marks.begin(), marks.end()); // as the circles are numbered
		for (const Vertex v : marks)
			distance.push_back(distancesFrom(t, p.lengths, v, marks));
	}

	const Packed p;
	const Triangulation& t;
	VertexArray<char> marked;
	EdgeArray<char> isCut;
	std::vector<Vertex> marks;
	std::vector<VertexArray<double>> distance;
};

TEST(CirclePaths, ABridgeIsAShortestPath)
{
	Random random(750);
	for (int i = 0; i < 20; ++i) {
		ThreeMarks s(random);
		CutSegments cut(s.t, s.p.lengths, s.marked, s.isCut);
		CirclePaths paths(cut, nullptr);
		ASSERT_EQ(splitCircles(paths), 3);
		const double min = std::min(s.distance[0][s.marks[1]], s.distance[0][s.marks[2]]);
		EXPECT_NEAR(paths.costOf(paths.shortestBridge(kFar)), min, 1e-12);
		EXPECT_TRUE(paths.shortestBridge(min * (1 - 1e-9)).empty());
	}
}

TEST(CirclePaths, ATripodIsShortest)
{
	Random random(751);
	int found = 0;
	for (int i = 0; i < 40; ++i) {
		ThreeMarks s(random);
		CutSegments cut(s.t, s.p.lengths, s.marked, s.isCut);
		CirclePaths paths(cut, nullptr);
		ASSERT_EQ(splitCircles(paths), 3);
		double min = kFar;
		for (const Vertex v : s.t.vertices())
			if (!s.marked[v])
				min = std::min(min, s.distance[0][v] + s.distance[1][v] + s.distance[2][v]);
		const std::vector<Edge> tripod = paths.bestTripod(kFar);
		EXPECT_TRUE(paths.bestTripod(min * (1 - 1e-9)).empty());
		if (tripod.empty())
			continue; // two of its paths touch before they meet
		++found;
		EXPECT_NEAR(paths.costOf(tripod), min, 1e-12);
		EXPECT_EQ(paths.bestTripod(min * (1 + 1e-9)), tripod); // the bound changes nothing
		cut.add(tripod);
		EXPECT_EQ(splitCircles(paths), 1);
	}
	EXPECT_GT(found, 20);
}

TEST(CirclePaths, JoinsAllCirclesAndLeavesTheCut)
{
	Random random(752);
	for (int i = 0; i < 20; ++i) {
		ThreeMarks s(random);
		CutSegments cut(s.t, s.p.lengths, s.marked, s.isCut);
		CirclePaths paths(cut, nullptr);
		splitCircles(paths);
		const std::vector<Edge> joins = paths.joinCircles(3, kFar);
		EXPECT_EQ(std::count(s.isCut.begin(), s.isCut.end(), 1), 0);
		const double ab = s.distance[0][s.marks[1]], bc = s.distance[1][s.marks[2]],
					 ca = s.distance[2][s.marks[0]];
		EXPECT_LE(paths.costOf(joins), ab + bc + ca - std::max({ab, bc, ca}) + 1e-12);
		cut.add(joins);
		EXPECT_EQ(splitCircles(paths), 1);
	}
}

/// Where parts are given, paths keep to those at which something was removed, and to those beside them.
TEST(CirclePaths, StayNearWhatWasRemoved)
{
	Random random(753);
	int shut = 0;
	for (int i = 0; i < 20; ++i) {
		ThreeMarks s(random);
		const CoarseSurface coarse(s.t, s.p.lengths, s.marked, 40);
		CutSegments cut(s.t, s.p.lengths, s.marked, s.isCut);
		CirclePaths everywhere(cut, nullptr);
		CirclePaths paths(cut, &coarse);
		splitCircles(everywhere);
		const std::vector<Edge> shortest = everywhere.shortestBridge(kFar);
		paths.findNear(shortest);
		splitCircles(paths);
		EXPECT_NEAR(paths.costOf(paths.shortestBridge(kFar)), paths.costOf(shortest), 1e-12);
		const Edge one = shortest.front();
		paths.findNear({one});
		splitCircles(paths);
		VertexArray<char> isNear(coarse.triangulation().vertexCount(), 0);
		for (const Vertex part : paths.near())
			isNear[part] = 1;
		const std::vector<Edge> near = paths.shortestBridge(kFar);
		shut += near.empty();
		for (const Edge e : near)
			for (const Vertex v : s.t.ends(e))
				EXPECT_TRUE(isNear[coarse.centreOf(v)] || s.marked[v]);
	}
	EXPECT_GT(shut, 0);
}

} // namespace
} // namespace ricci::testing
