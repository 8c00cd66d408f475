// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/cut/cut_graph.h>
#include <ricci/error.h>
#include <ricci/mesh/triangulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

/// The cut opens the surface to a disk, knows how many edges it has, and ends at marked vertices alone.
void expectCutToADisk(const Triangulation& t, const CutGraph& cut, const VertexArray<char>& marked)
{
	expectDiskThroughMarks(t, cut.isCut, marked);
	VertexArray<int> degree(t.vertexCount(), 0);
	for (const Halfedge h : t.halfedges())
		degree[t.origin(h)] += cut.isCut[h.edge()];
	const VertexArray<char> boundary = t.boundaryVertices();
	for (const Vertex v : t.vertices())
		EXPECT_TRUE(degree[v] != 1 || marked[v] || boundary[v]);
	EXPECT_EQ(cut.edgeCount, std::count(cut.isCut.begin(), cut.isCut.end(), 1));
}

constexpr double kFar = std::numeric_limits<double>::infinity();

TEST(CutGraph, KeepsOffForbiddenEdges)
{
	Random random(134);
	const Packed packed(bumpyTorus(14, 9, random));
	const VertexArray<char> unmarked(packed.radii.size(), 0);
	EdgeArray<double> cost = packed.lengths;
	const auto free = cutToDisk(packed.triangulation, cost, unmarked);
	for (const Edge e : cost.indices())
		if (e.number() % 2 == 0 && free.isCut[e])
			cost[e] = kFar;
	ASSERT_GT(std::count(cost.begin(), cost.end(), kFar), 3);
	const auto cut = cutToDisk(packed.triangulation, cost, unmarked);
	expectCutToADisk(packed.triangulation, cut, unmarked);
	for (const Edge e : cost.indices())
		EXPECT_FALSE(cost[e] == kFar && cut.isCut[e]);
	// Not where the forbidden edges leave no way.
	std::fill(cost.begin(), cost.end(), kFar);
	const auto error =
		refusalOf<NotConverged>([&] { cutToDisk(packed.triangulation, cost, unmarked); });
	EXPECT_EQ(error.problem, NotConverged::NoCut);
	expectWords(error.what(), {"cannot be cut open"});
}

/// Least number of edges to be crossed on the way from some triangle to every other one, off the cut.
int radiusInTriangles(const Triangulation& t, const EdgeArray<char>& isCut)
{
	int least = t.faceCount();
	for (const Face first : t.faces()) {
		FaceArray<int> steps(t.faceCount(), -1);
		std::vector<Face> queue{first};
		steps[first] = 0;
		for (std::size_t head = 0; head < queue.size(); ++head)
			for (const Halfedge h : t.halfedges(queue[head]))
				if (!t.isBoundary(h.edge()) && !isCut[h.edge()] && steps[t.face(h.twin())] < 0) {
					steps[t.face(h.twin())] = steps[queue[head]] + 1;
					queue.push_back(t.face(h.twin()));
				}
		least = std::min(least, steps[queue.back()]);
	}
	return least;
}

/// No way in the disk is much longer than on the surface, as it is round a long handle that a short cut
/// opens at one place.
TEST(CutAroundCentre, LeavesADiskHardlyWiderThanTheSurface)
{
	for (const int genus : {3, 6}) {
		const Packed packed(perforatedSlab(genus, 3));
		const Triangulation& t = packed.triangulation;
		const VertexArray<char> unmarked(t.vertexCount(), 0);
		const int surface = radiusInTriangles(t, EdgeArray<char>(t.edgeCount(), 0));
		const int around = radiusInTriangles(t, cutAroundCentre(t, packed.lengths, unmarked).isCut);
		const int shortCut = radiusInTriangles(t, cutToDisk(t, packed.lengths, unmarked).isCut);
		EXPECT_LE(around, 1.2 * surface) << "genus " << genus;
		EXPECT_LT(around, shortCut) << "genus " << genus;
	}
}

} // namespace
} // namespace ricci::testing
