// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/surface/flow_domain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace ricci::testing {
namespace {

struct Surface
{
	const char* name;
	Triangulation triangulation;
};

std::vector<Surface> surfaces()
{
	Random random(340);
	return {
		{"disk", glued(randomPlanarDisk(6, random))},
		{"ring", glued(ring(1, 2, 9, 3))},
		{"pierced torus", glued(withoutStars(torus(3, 1, 9, 9), {0, 40}))},
		{"triangle", Triangulation(3, {{0, 1, 2}})},
		{"two triangles, their edge between two boundary vertices",
		 Triangulation(4, {{0, 1, 2}, {0, 2, 3}})},
		{"triangle glued to itself", glued(2, {{0, 1, 0}}, {1, 0, -1})}};
}

int boundaryVertexCount(const Triangulation& t)
{
	const auto boundary = t.boundaryVertices();
	return static_cast<int>(std::count(boundary.begin(), boundary.end(), 1));
}

TEST(DoubleSurface, IsClosedWithTwiceTheEulerCharacteristic)
{
	for (const Surface& s : surfaces()) {
		SCOPED_TRACE(s.name);
		const Triangulation& t = s.triangulation;
		const DoubleSurface d = doubleOf(t);
		const Triangulation& closed = d.triangulation;
		EXPECT_TRUE(closed.boundaryLoops().empty());
		EXPECT_EQ(closed.faceCount(), 2 * t.faceCount());
		EXPECT_EQ(closed.vertexCount(), 2 * t.vertexCount() - boundaryVertexCount(t));
		// The boundary is made of circles, whose characteristic is 0.
		EXPECT_EQ(closed.eulerCharacteristic(), 2 * t.eulerCharacteristic());
		for (const Halfedge h : closed.halfedges()) {
			ASSERT_FALSE(closed.isExterior(h));
			ASSERT_EQ(closed.next(closed.next(closed.next(h))), h);
			ASSERT_EQ(closed.origin(closed.next(h)), closed.target(h));
		}
	}
}

TEST(DoubleSurface, FirstCopyKeepsItsNumbers)
{
	for (const Surface& s : surfaces()) {
		SCOPED_TRACE(s.name);
		const Triangulation& t = s.triangulation;
		const DoubleSurface d = doubleOf(t);
		for (const Halfedge h : t.halfedges()) {
			EXPECT_EQ(d.triangulation.origin(h), t.origin(h));
			EXPECT_EQ(d.edgeOf[h.edge()], h.edge());
			if (t.isExterior(h)) {
				EXPECT_GE(d.triangulation.face(h).number(), t.faceCount());
				continue;
			}
			EXPECT_EQ(d.triangulation.face(h), t.face(h));
			EXPECT_EQ(d.triangulation.next(h), t.next(h));
		}
		for (const Face f : t.faces())
			EXPECT_EQ(d.triangulation.halfedges(f), t.halfedges(f));
	}
}

TEST(DoubleSurface, MirrorIsAnInvolutionThatFixesTheBoundary)
{
	for (const Surface& s : surfaces()) {
		SCOPED_TRACE(s.name);
		const Triangulation& t = s.triangulation;
		const DoubleSurface d = doubleOf(t);
		const VertexArray<char> boundary = t.boundaryVertices();
		ASSERT_EQ(d.mirror.size(), d.triangulation.vertexCount());
		for (const Vertex v : d.mirror.indices()) {
			EXPECT_EQ(d.mirror[d.mirror[v]], v);
			EXPECT_EQ(d.mirror[v] == v, v.number() < boundary.size() && boundary[v]);
		}
	}
}

TEST(DoubleSurface, EveryEdgeIsItsOwnOrMirrorsOne)
{
	for (const Surface& s : surfaces()) {
		SCOPED_TRACE(s.name);
		const Triangulation& t = s.triangulation;
		const DoubleSurface d = doubleOf(t);
		EdgeArray<int> copies(t.edgeCount(), 0);
		ASSERT_EQ(d.edgeOf.size(), d.triangulation.edgeCount());
		for (const Edge e : d.triangulation.edges()) {
			const Edge original = d.edgeOf[e];
			ASSERT_TRUE(original.isValid());
			ASSERT_LT(original.number(), t.edgeCount());
			++copies[original];
			if (e == original)
				continue;
			const auto [a, b] = d.triangulation.ends(e);
			const std::array<Vertex, 2> mirrored{d.mirror[a], d.mirror[b]}, own = t.ends(original);
			EXPECT_TRUE(std::is_permutation(mirrored.begin(), mirrored.end(), own.begin()));
		}
		for (const Edge e : t.edges())
			EXPECT_EQ(copies[e], t.isBoundary(e) ? 1 : 2);
	}
}

/// The second copy of each face is the mirror image of the first.
TEST(DoubleSurface, SecondCopyIsTurnedRound)
{
	for (const Surface& s : surfaces()) {
		SCOPED_TRACE(s.name);
		const DoubleSurface d = doubleOf(s.triangulation);
		for (const Face f : s.triangulation.faces()) {
			const Face copy(s.triangulation.faceCount() + f.number());
			const auto h = d.triangulation.halfedges(f), g = d.triangulation.halfedges(copy);
			std::vector<Vertex> backward, image;
			for (std::size_t k = 0; k < 3; ++k) {
				image.push_back(d.triangulation.origin(g[k]));
				backward.push_back(d.mirror[d.triangulation.origin(h[(3 - k) % 3])]);
			}
			bool found = false;
			for (int turn = 0; turn < 3; ++turn) {
				found |= image == backward;
				std::rotate(image.begin(), image.begin() + 1, image.end());
			}
			EXPECT_TRUE(found) << "face " << f.number();
		}
	}
}

/// The edge of an ear joins two boundary vertices inside the surface: its two copies join the same
/// two vertices and must stay two edges.
TEST(DoubleSurface, EdgeBetweenTwoBoundaryVerticesStaysTwoEdges)
{
	const Triangulation t(4, {{0, 1, 2}, {0, 2, 3}});
	const DoubleSurface d = doubleOf(t);
	std::vector<Edge> diagonals;
	for (const Edge e : d.triangulation.edges()) {
		const auto [a, b] = d.triangulation.ends(e);
		if (std::min(a, b) == Vertex(0) && std::max(a, b) == Vertex(2))
			diagonals.push_back(e);
	}
	ASSERT_EQ(diagonals.size(), 2u);
	for (const Edge e : diagonals) {
		const bool first = d.triangulation.face(e.halfedge()) < Face(2);
		EXPECT_EQ(d.triangulation.face(e.halfedge().twin()) < Face(2), first);
		EXPECT_TRUE(d.triangulation.isFlippable(e));
	}
	EXPECT_EQ(d.triangulation.vertexCount(), 4);
}

TEST(DoubleSurface, SingleTriangleBecomesASphereOfTwo)
{
	const DoubleSurface d = doubleOf(Triangulation(3, {{0, 1, 2}}));
	EXPECT_EQ(d.triangulation.vertexCount(), 3);
	EXPECT_EQ(d.triangulation.edgeCount(), 3);
	EXPECT_EQ(d.triangulation.faceCount(), 2);
	EXPECT_EQ(d.triangulation.eulerCharacteristic(), 2);
	EXPECT_EQ(d.mirror, (VertexArray<Vertex>{Vertex(0), Vertex(1), Vertex(2)}));
	for (const Edge e : d.triangulation.edges())
		EXPECT_TRUE(d.triangulation.isFlippable(e));
}

} // namespace
} // namespace ricci::testing
