// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts that open surfaces, and shorter ones.
#include "support/expect.h"
#include "support/intrinsic.h"
#include "support/listener.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/graphs.h>
#include <ricci/cut/cut_graph.h>
#include <ricci/error.h>
#include <ricci/layout/planar_layout.h>
#include <ricci/mesh/triangulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace ricci::testing {
namespace {

/// A cut that nobody would want: all edges but those that a breadth-first search of the faces
/// crosses, less the dead ends without a mark.
EdgeArray<char> clumsyCut(const Triangulation& t, const VertexArray<char>& marked)
{
	EdgeArray<char> isCut(t.edgeCount(), 1);
	FaceArray<char> seen(t.faceCount(), 0);
	std::vector<Face> queue{Face(0)};
	seen[Face(0)] = 1;
	for (std::size_t head = 0; head < queue.size(); ++head)
		for (const Halfedge h : t.halfedges(queue[head])) {
			const Halfedge g = h.twin();
			if (!t.isExterior(g) && !seen[t.face(g)]) {
				seen[t.face(g)] = 1;
				isCut[h.edge()] = 0;
				queue.push_back(t.face(g));
			}
		}
	const VertexArray<char> boundary = t.boundaryVertices();
	for (const Edge e : t.edges())
		if (t.isBoundary(e))
			isCut[e] = 0;
	for (bool changed = true; changed;) {
		changed = false;
		VertexArray<int> degree(t.vertexCount(), 0);
		for (const Halfedge h : t.halfedges())
			degree[t.origin(h)] += isCut[h.edge()];
		for (const Halfedge h : t.halfedges()) {
			const Vertex v = t.origin(h);
			if (isCut[h.edge()] && degree[v] == 1 && !marked[v] && !boundary[v]) {
				isCut[h.edge()] = 0;
				changed = true;
				break;
			}
		}
	}
	return isCut;
}

/// Without any one segment the opened surface has two boundaries, and no path between them is shorter than the
/// segment. Boundaries are found as classes of the wedges into which the cut divides the corners, distances by
/// Bellman and Ford.
void expectNoShorterPath(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const VertexArray<char>& marked,
	const EdgeArray<char>& isCut)
{
	for (const std::vector<Halfedge>& segment : seamsOf(t, isCut, marked)) {
		EdgeArray<char> rest = isCut;
		double length = 0.0;
		for (const Halfedge h : segment) {
			rest[h.edge()] = 0;
			length += lengths[h.edge()];
		}
		const HalfedgeArray<int> wedge = cornerWedges(t, rest).wedge;
		DisjointSets boundaries(t.halfedgeCount());
		std::set<int> ends; // wedges at the boundaries
		for (const Halfedge h : t.interiorHalfedges())
			if (rest[h.edge()] || t.isBoundary(h.edge())) {
				boundaries.merge(wedge[h], wedge[t.next(h)]);
				ends.insert({wedge[h], wedge[t.next(h)]});
			}
		for (const Halfedge h : {segment.front(), segment.back().twin()})
			if (marked[t.origin(h)]) // it may be alone
				ends.insert(wedge[h]);
		const int from = boundaries.find(*ends.begin());
		std::set<int> numbers;
		std::vector<double> distance(at(t.halfedgeCount()), kInfinity);
		for (const int end : ends) {
			numbers.insert(boundaries.find(end));
			if (boundaries.find(end) == from)
				distance[at(end)] = 0.0;
		}
		EXPECT_EQ(numbers.size(), 2u);
		for (bool changed = true; changed;) {
			changed = false;
			const auto relax = [&](int a, int b, double step) {
				if (distance[at(a)] + step < distance[at(b)]) {
					distance[at(b)] = distance[at(a)] + step;
					changed = true;
				}
			};
			for (const Halfedge h : t.interiorHalfedges()) {
				relax(wedge[h], wedge[t.next(h)], lengths[h.edge()]);
				relax(wedge[t.next(h)], wedge[h], lengths[h.edge()]);
			}
		}
		for (const int end : ends)
			EXPECT_TRUE(boundaries.find(end) == from || distance[at(end)] >= length * (1 - 1e-12));
	}
}

Vertex randomVertex(const Triangulation& t, Random& random)
{
	return Vertex(random.index(t.vertexCount()));
}

TEST(ShortenCut, StaysADiskThroughTheMarksAndGetsShorterUntilNoSegmentHasAShorterPath)
{
	Random random(720);
	int tried = 0;
	const std::vector<SurfaceMesh> meshes = surfacesOfEveryKind(random);
	for (const SurfaceMesh& mesh : meshes) {
		const Packed p(mesh);
		const Triangulation& t = p.triangulation;
		const Topology topology = topologyOf(t);
		SCOPED_TRACE(topology.type.name());
		for (int count : {0, 2, 7}) { // two on a sphere: the shortest path between them
			VertexArray<char> marked(t.vertexCount(), 0);
			for (int i = 0; i < count; ++i)
				marked[randomVertex(t, random)] = 1;
			if (topology.type.isSphere() && count == 0)
				continue;
			++tried;
			EdgeArray<char> isCut = clumsyCut(t, marked);
			expectDiskThroughMarks(t, isCut, marked);
			for (double before = kInfinity, now = lengthOf(isCut, p.lengths); now < before;) {
				before = now;
				shortenCut(t, p.lengths, marked, isCut);
				now = lengthOf(isCut, p.lengths);
				expectDiskThroughMarks(t, isCut, marked);
				EXPECT_LE(now, before * (1 + 1e-12));
			}
			expectNoShorterPath(t, p.lengths, marked, isCut);
		}
	}
	EXPECT_EQ(tried, 3 * static_cast<int>(meshes.size()) - 1); // less the sphere without marks
}

/// Between two moves the cut is a disk's, so that a search may end there.
TEST(ShortenCut, ASearchThatIsEndedLeavesADisk)
{
	Random random(723);
	const Packed p(shaken(perforatedSlab(8, 4), 0.05, random));
	const Triangulation& t = p.triangulation;
	VertexArray<char> marked(t.vertexCount(), 0);
	for (int i = 0; i < 120; ++i)
		marked[randomVertex(t, random)] = 1;
	const EdgeArray<char> clumsy = clumsyCut(t, marked);
	Listener ticks;
	EdgeArray<char> whole = clumsy;
	withListener(ticks, [&] { return shortenCut(t, p.lengths, marked, whole); });
	EXPECT_GE(ticks.calls(), 3);
	double before = lengthOf(clumsy, p.lengths);
	for (int n = 1; n <= ticks.calls(); ++n) {
		EdgeArray<char> isCut = clumsy;
		Listener impatient(n);
		EXPECT_THROW(
			withListener(impatient, [&] { shortenCut(t, p.lengths, marked, isCut); }), Cancelled);
		expectDiskThroughMarks(t, isCut, marked);
		const double now = lengthOf(isCut, p.lengths);
		EXPECT_LE(now, before * (1 + 1e-12));
		before = now;
	}
	EXPECT_LE(lengthOf(whole, p.lengths), before * (1 + 1e-12));
}

/// The cut opens the surface to a disk, and ends at marked vertices alone.
void expectCutToADisk(const Triangulation& t, const CutGraph& cut, const VertexArray<char>& marked)
{
	expectDiskThroughMarks(t, cut.isCut, marked);
	VertexArray<int> degree(t.vertexCount(), 0);
	for (const Halfedge h : t.halfedges())
		degree[t.origin(h)] += cut.isCut[h.edge()];
	const VertexArray<char> boundary = t.boundaryVertices();
	for (const Vertex v : t.vertices())
		EXPECT_TRUE(degree[v] != 1 || marked[v] || boundary[v]);
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
