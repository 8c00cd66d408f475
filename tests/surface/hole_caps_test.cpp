// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/shapes.h"

#include <ricci/surface/flow_domain.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace ricci::testing {
namespace {

/// A square of n x n cells without the stars of some inner vertices.
SurfaceMesh squareWithHoles(int n)
{
	const auto vertex = [&](int i, int j) { return i * (n + 1) + j; };
	return withoutStars(
		rectangle(n, n, 1.0, 1.0), {vertex(2, 2), vertex(n - 2, 3), vertex(n / 2, n - 2)});
}

FlowDomain capped(const SurfaceMesh& mesh, const EdgeArray<char>& isHole = {})
{
	FlowDomain domain;
	domain.surface = embeddedSurface(VertexArray<Point3>(mesh.positions), mesh.triangles);
	capHoles(loopsToClose(domain.surface, isHole, Holes::Capped), domain);
	return domain;
}

TEST(HoleCaps, CloseAllLoopsButTheLongest)
{
	const SurfaceMesh mesh = squareWithHoles(9);
	const Triangulation t = glued(mesh);
	ASSERT_EQ(t.boundaryLoops().size(), 4u);
	const FlowDomain domain = capped(mesh);
	const Triangulation& closed = domain.solved().triangulation;
	EXPECT_EQ(domain.holes, 3);
	EXPECT_EQ(closed.boundaryLoops().size(), 1u);
	EXPECT_EQ(closed.eulerCharacteristic(), t.eulerCharacteristic() + 3);
	EXPECT_EQ(closed.vertexCount(), t.vertexCount() + 3);
	// The rims of the holes, and nothing else, are marked.
	const VertexArray<char> before = t.boundaryVertices();
	const VertexArray<char> after = closed.boundaryVertices();
	ASSERT_EQ(domain.onHole.size(), t.vertexCount());
	for (const Vertex v : t.vertices()) {
		EXPECT_EQ(before[v] != 0, after[v] != 0 || domain.onHole[v] != 0);
		EXPECT_FALSE(after[v] && domain.onHole[v]);
	}
	for (const Vertex v : IndexRange<Vertex>(t.vertexCount(), closed.vertexCount()))
		EXPECT_FALSE(after[v]);
}

TEST(HoleCaps, KeepTheNumbersOfTheSurface)
{
	const SurfaceMesh mesh = squareWithHoles(8);
	const Triangulation t = glued(mesh);
	const FlowDomain domain = capped(mesh);
	const Triangulation& c = domain.solved().triangulation;
	for (const Halfedge h : t.halfedges()) {
		EXPECT_EQ(c.origin(h), t.origin(h));
		if (!t.isExterior(h)) {
			EXPECT_EQ(c.face(h), t.face(h));
			EXPECT_EQ(c.next(h), t.next(h));
		}
		else if (domain.onHole[t.origin(h)]) {
			EXPECT_GE(c.face(h).number(), t.faceCount());
		}
	}
	for (const Vertex v : t.vertices())
		EXPECT_EQ(domain.solved().positions[v], mesh.positions[at(v)]);
}

/// A loop is a hole if all its edges are marked.
TEST(HoleCaps, CloseMarkedLoops)
{
	const SurfaceMesh mesh = squareWithHoles(9);
	const Triangulation t = glued(mesh);
	const std::vector<Halfedge> loops = t.boundaryLoops();
	ASSERT_EQ(loops.size(), 4u);
	for (unsigned marked = 0; marked < 15; ++marked) {
		EdgeArray<char> isHole(t.edgeCount(), 0);
		VertexArray<char> expected(t.vertexCount(), 0);
		for (std::size_t l = 0; l < loops.size(); ++l)
			for (const Halfedge h : t.loop(loops[l])) {
				const bool isMarked = (marked >> l & 1u) != 0;
				isHole[h.edge()] = isMarked || h != loops[l]; // else all but one of its edges
				expected[t.origin(h)] = isMarked;
			}
		const FlowDomain domain = capped(mesh, isHole);
		EXPECT_EQ(domain.onHole.values(), expected.values());
		EXPECT_EQ(domain.solved().triangulation.boundaryLoops().size(), at(4 - domain.holes));
	}
}

TEST(HoleCaps, LeaveASurfaceWithOneLoopOrNoneAlone)
{
	for (const SurfaceMesh& mesh : {rectangle(3, 3, 1.0, 1.0), tetrahedron()}) {
		const Triangulation t = glued(mesh);
		const FlowDomain domain = capped(mesh);
		EXPECT_EQ(domain.holes, 0);
		EXPECT_EQ(domain.solved().triangulation.faceCount(), t.faceCount());
		EXPECT_EQ(std::count(domain.onHole.begin(), domain.onHole.end(), 1), 0);
	}
}

} // namespace
} // namespace ricci::testing
