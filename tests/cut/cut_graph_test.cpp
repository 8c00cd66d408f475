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
#include <cmath>
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

constexpr double kInfinity = std::numeric_limits<double>::infinity();

VertexArray<char> someVertices(int count, const Triangulation& t, Random& random)
{
	VertexArray<char> marked(t.vertexCount(), 0);
	for (int i = 0; i < count; ++i)
		marked[Vertex(random.index(t.vertexCount()))] = 1;
	return marked;
}

TEST(CutGraph, OpensSurfacesOfEveryKindToADisk)
{
	Random random(130);
	std::vector<SurfaceMesh> meshes = surfacesOfEveryKind(random);
	meshes.push_back(randomPlanarDisk(6, random));
	int opened = 0, needless = 0;
	for (const SurfaceMesh& mesh : meshes) {
		const Packed packed(mesh);
		const Triangulation& t = packed.triangulation;
		const Topology topology = topologyOf(t);
		SCOPED_TRACE(topology.type.name());
		for (int cones : {0, 1, 4}) {
			const VertexArray<char> marked = someVertices(cones, t, random);
			const CutGraph cut = cutToDisk(t, packed.lengths, marked);
			if (topology.type.isSphere() && std::count(marked.begin(), marked.end(), 1) < 2) {
				// A sphere without two cones has no flat metric.
				EXPECT_EQ(cut.edgeCount, 0);
				++needless;
				continue;
			}
			++opened;
			expectCutToADisk(t, cut, marked);
			EXPECT_EQ(static_cast<int>(cut.generators.size()), 2 * topology.type.genus);
			for (const Edge e : cut.generators)
				EXPECT_TRUE(cut.isCut[e]);
			EXPECT_NEAR(cut.length, lengthOf(cut.isCut, packed.lengths), 1e-12 * (1 + cut.length));
		}
	}
	EXPECT_EQ(needless, 2);
	EXPECT_EQ(opened + needless, 3 * static_cast<int>(meshes.size()));
}

TEST(CutGraph, IsShortestAcrossAnAnnulus)
{
	// On a planar ring the shortest cut is one radial line of edges.
	const Packed packed(ring(1, 4, 12, 5));
	const VertexArray<char> unmarked(packed.radii.size(), 0);
	const CutGraph cut = cutToDisk(packed.triangulation, packed.lengths, unmarked);
	EXPECT_EQ(cut.edgeCount, 5);
	EXPECT_NEAR(cut.length, 3.0, 1e-12);
}

TEST(CutGraph, OnATorusIsNoLongerThanTheTwoObviousLoops)
{
	// A flat torus, 9 x 20 units: one loop of edges round each way, which are shortest.
	const Packed torusGrid(torus(3, 1, 20, 9));
	for (double width : {0.2, 1.0, 3.0}) {
		EdgeArray<double> lengths;
		const Triangulation& t = torusGrid.triangulation;
		for (const Edge e : t.edges()) {
			const int a = t.ends(e)[0].number(), b = t.ends(e)[1].number();
			const bool sameColumn = a / 9 == b / 9, sameRow = a % 9 == b % 9;
			lengths.push_back(sameColumn ? 1.0 : sameRow ? width : std::hypot(1.0, width));
		}
		const VertexArray<char> unmarked(t.vertexCount(), 0);
		const CutGraph cut = cutToDisk(t, lengths, unmarked);
		expectCutToADisk(t, cut, unmarked);
		EXPECT_LE(cut.length, 9.0 + 20.0 * width + 1e-9);
		// Two generating loops are at least as long as the two shortest of the lattice, less what
		// they share: a cut graph contains a loop of each class that a generator crosses.
		EXPECT_GE(cut.length, std::max(9.0, 20.0 * width) - 1e-9);
	}
}

TEST(CutGraph, KeepsOffForbiddenEdges)
{
	Random random(134);
	const Packed packed(bumpyTorus(14, 9, random));
	const VertexArray<char> unmarked(packed.radii.size(), 0);
	EdgeArray<double> cost = packed.lengths;
	const auto free = cutToDisk(packed.triangulation, cost, unmarked);
	for (const Edge e : cost.indices())
		if (e.number() % 2 == 0 && free.isCut[e])
			cost[e] = kInfinity;
	ASSERT_GT(std::count(cost.begin(), cost.end(), kInfinity), 3);
	const auto cut = cutToDisk(packed.triangulation, cost, unmarked);
	expectCutToADisk(packed.triangulation, cut, unmarked);
	for (const Edge e : cost.indices())
		EXPECT_FALSE(cost[e] == kInfinity && cut.isCut[e]);
	// Not where the forbidden edges leave no way.
	std::fill(cost.begin(), cost.end(), kInfinity);
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

TEST(CutAroundCentre, OpensSurfacesOfEveryKindToADiskThroughTheMarks)
{
	Random random(135);
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		const Packed packed(mesh);
		const Triangulation& t = packed.triangulation;
		const VertexArray<char> marked = someVertices(4, t, random);
		const CutGraph cut = cutAroundCentre(t, packed.lengths, marked);
		expectCutToADisk(t, cut, marked);
		EXPECT_EQ(static_cast<int>(cut.generators.size()), 2 * topologyOf(t).type.genus);
	}
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
