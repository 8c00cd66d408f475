// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/math/disjoint_sets.h>
#include <ricci/math/shortest_paths.h>
#include <ricci/surface/topology.h>

#include <gtest/gtest.h>

#include <vector>

namespace ricci::testing {
namespace {

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
