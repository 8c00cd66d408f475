// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/math/disjoint_sets.h>
#include <ricci/math/shortest_paths.h>
#include <ricci/surface/triangulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

TEST(Topology, OfSurfacesWithAndWithoutBoundary)
{
	const struct
	{
		SurfaceMesh mesh;
		int genus;
		std::size_t loops;
		const char* name;
	} cases[] = {
		{perforatedSlab(0, 2), 0, 0, "a closed surface of genus 0 (a sphere)"},
		{torus(3, 1, 9, 7), 1, 0, "a closed surface of genus 1 (a torus)"},
		{perforatedSlab(2, 1), 2, 0, "a closed surface of genus 2"},
		{rectangle(5, 4, 5, 4), 0, 1, "a disk"},
		{ring(1, 2, 9, 3), 0, 2, "an annulus"},
		{withoutStars(torus(3, 1, 9, 9), {0}), 1, 1, "a surface of genus 1 with 1 boundary loop"}};
	for (const auto& c : cases) {
		const Triangulation t = glued(c.mesh);
		const Topology topology = topologyOf(t);
		EXPECT_EQ(topology.type.genus, c.genus);
		EXPECT_EQ(topology.loops.size(), c.loops);
		EXPECT_EQ(topology.type.boundaryLoops, static_cast<int>(c.loops));
		EXPECT_EQ(topology.type.name(), c.name);
		EXPECT_EQ(topology.type.eulerCharacteristic(), t.eulerCharacteristic());
		EXPECT_EQ(topology.boundary, t.boundaryVertices());
	}
}

TEST(Topology, LoopsHaveTheSurfaceOnTheirLeft)
{
	// Shoelace: the outer loop of a ring runs counter-clockwise, the inner one clockwise.
	const SurfaceMesh annulus = ring(1, 2, 9, 3);
	std::vector<double> areas;
	for (const std::vector<Vertex>& loop : topologyOf(glued(annulus)).loops) {
		double area = 0.0;
		for (std::size_t i = 0; i < loop.size(); ++i) {
			const Point3& p = annulus.positions[at(loop[i])];
			const Point3& q = annulus.positions[at(loop[(i + 1) % loop.size()])];
			area += 0.5 * (p[0] * q[1] - p[1] * q[0]);
		}
		areas.push_back(area);
	}
	std::sort(areas.begin(), areas.end());
	ASSERT_EQ(areas.size(), 2u);
	const double unitPolygon = 4.5 * std::sin(2 * kPi / 9);
	EXPECT_NEAR(areas[0], -unitPolygon, 1e-12);
	EXPECT_NEAR(areas[1], 4 * unitPolygon, 1e-12);
}

/// With the tree, they open a closed surface to one disk: the faces stay connected, and all that is left has
/// Euler characteristic 1. No other set of edges that does is shorter: each exchange of one of them for an
/// edge outside leaves a longer loop or divides the faces.
TEST(Cotree, LeavesTheShortestLoopsThatOpenTheSurface)
{
	Random random(612);
	for (int genus = 0; genus <= 3; ++genus) {
		const Triangulation t = glued(shaken(perforatedSlab(genus, 2), 0.05, random));
		const auto paths = shortestPaths<Vertex, Halfedge>(
			t.vertexCount(), {Vertex(0)}, [&](Vertex v, const auto& visit) {
				for (const Halfedge h : t.around(v))
					visit(t.target(h), 1.0, h);
			});
		EdgeArray<char> inTree(t.edgeCount(), 0);
		for (const Halfedge h : paths.parent)
			if (h.isValid())
				inTree[h.edge()] = 1;
		EdgeArray<double> length(t.edgeCount(), 0.0);
		for (double& l : length)
			l = random.real(1.0, 2.0);
		const std::vector<Edge> rest = edgesBesideCotree(t, inTree, length);
		ASSERT_EQ(rest.size(), static_cast<std::size_t>(2 * genus));
		EdgeArray<char> isLeft(t.edgeCount(), 0);
		for (const Edge e : rest)
			isLeft[e] = 1;
		const auto pieces = [&] {
			DisjointSetsOf<Face> joined(t.faceCount());
			int count = t.faceCount();
			for (const Edge e : t.edges())
				if (!inTree[e] && !isLeft[e])
					count -= joined.merge(t.face(e.halfedge()), t.face(e.halfedge().twin()));
			return count;
		};
		EXPECT_EQ(pieces(), 1);
		for (const Edge e : rest)
			for (const Edge other : t.edges()) {
				if (inTree[other] || isLeft[other] || length[other] >= length[e])
					continue;
				isLeft[e] = 0;
				isLeft[other] = 1;
				EXPECT_GT(pieces(), 1);
				isLeft[e] = 1;
				isLeft[other] = 0;
			}
	}
}

} // namespace
} // namespace ricci::testing
