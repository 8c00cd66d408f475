// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/error.h>
#include <ricci/surface/triangulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace ricci::testing {
namespace {

Triangulation glue(const SurfaceMesh& mesh)
{
	return Triangulation(static_cast<int>(mesh.positions.size()), mesh.triangles);
}

/// A square with opposite sides glued: two triangles, three edges, one vertex.
Triangulation oneVertexTorus()
{
	// Sides 0..2 of the first triangle are bottom, right, diagonal; of the second: top, left,
	// diagonal.
	return Triangulation(1, {{0, 0, 0}, {0, 0, 0}}, {3, 4, 5, 0, 1, 2});
}

/// All of a triangulation but the choice of halfedge(f) among the three of a face.
struct State
{
	std::vector<int> next, origin, face;

	explicit State(const Triangulation& t)
	{
		for (int h = 0; h < t.halfedgeCount(); ++h) {
			next.push_back(t.next(h));
			origin.push_back(t.origin(h));
			face.push_back(t.face(h));
		}
	}
	bool operator==(const State& other) const
	{
		return next == other.next && origin == other.origin && face == other.face;
	}
};

/// Everything that must hold of any triangulation.
void expectConsistent(const Triangulation& t)
{
	std::vector<int> sidesOf(at(t.faceCount()), 0), entering(at(t.halfedgeCount()), 0);
	for (int h = 0; h < t.halfedgeCount(); ++h) {
		ASSERT_EQ(t.origin(t.next(h)), t.target(h)) << "halfedge " << h;
		ASSERT_EQ(t.face(t.next(h)), t.face(h)) << "halfedge " << h;
		++entering[at(t.next(h))];
		if (t.isOuter(h))
			continue;
		ASSERT_EQ(t.next(t.next(t.next(h))), h);
		++sidesOf[at(t.face(h))];
	}
	EXPECT_TRUE(std::all_of(sidesOf.begin(), sidesOf.end(), [](int n) { return n == 3; }));
	EXPECT_TRUE(std::all_of(entering.begin(), entering.end(), [](int n) { return n == 1; }));
	for (int f = 0; f < t.faceCount(); ++f)
		for (int h : t.halfedges(f))
			ASSERT_EQ(t.face(h), f);
}

/// Flips of random flippable edges; returns them in order.
std::vector<int> flipAtRandom(Triangulation& t, int count, Random& random)
{
	std::vector<int> flipped;
	while (static_cast<int>(flipped.size()) < count) {
		const int e = random.index(t.edgeCount());
		if (!t.isFlippable(e))
			continue;
		t.flip(e);
		flipped.push_back(e);
	}
	return flipped;
}

TEST(Triangulation, GluesAlongEqualVertexPairs)
{
	const SurfaceMesh mesh = tetrahedron();
	const Triangulation t = glue(mesh);
	expectConsistent(t);
	EXPECT_EQ(t.faceCount(), 4);
	EXPECT_EQ(t.edgeCount(), 6);
	EXPECT_TRUE(t.boundaryLoops().empty());
	EXPECT_EQ(t.eulerCharacteristic(), 2);
	for (int f = 0; f < t.faceCount(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			EXPECT_EQ(t.origin(t.halfedges(f)[k]), mesh.triangles[at(f)][k]);
}

TEST(Triangulation, RefusesAnEdgeOfTwoTrianglesThatDisagree)
{
	EXPECT_THROW(Triangulation(4, {{0, 1, 2}, {0, 1, 3}}), InvalidMesh);
	EXPECT_THROW(Triangulation(5, {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}), InvalidMesh);
}

TEST(Triangulation, EulerCharacteristicAndBoundaryLoops)
{
	const struct
	{
		const char* name;
		SurfaceMesh mesh;
		int chi, loops;
	} cases[] = {
		{"rectangle", rectangle(3, 4, 1, 1), 1, 1},
		{"ring", ring(1, 2, 7, 3), 0, 2},
		{"torus", torus(3, 1, 8, 6), 0, 0},
		{"slab", perforatedSlab(0, 1), 2, 0},
		{"genus 2", perforatedSlab(2, 1), -2, 0},
		{"genus 3", perforatedSlab(3, 2), -4, 0},
		{"pierced torus", withoutStars(torus(3, 1, 9, 9), {0, 40}), -2, 2},
		{"two pieces", sideBySide(tetrahedron(), rectangle(1, 1, 1, 1), 5), 3, 1},
	};
	for (const auto& c : cases) {
		SCOPED_TRACE(c.name);
		const Triangulation t = glue(c.mesh);
		expectConsistent(t);
		EXPECT_EQ(t.eulerCharacteristic(), c.chi);
		EXPECT_EQ(static_cast<int>(t.boundaryLoops().size()), c.loops);
	}
}

TEST(Triangulation, UnusedVerticesDoNotCount)
{
	EXPECT_EQ(Triangulation(9, {{0, 1, 2}}).eulerCharacteristic(), 1);
}

TEST(Triangulation, BoundaryLoopsVisitEveryBoundaryVertexOnce)
{
	const Triangulation t = glue(ring(1, 2, 7, 3));
	std::vector<int> visits(at(t.vertexCount()), 0);
	for (int first : t.boundaryLoops()) {
		int h = first, length = 0;
		do {
			EXPECT_TRUE(t.isOuter(h));
			++visits[at(t.origin(h))];
			++length;
			h = t.next(h);
		} while (h != first);
		EXPECT_EQ(length, 7);
	}
	const std::vector<char> boundary = t.boundaryVertices();
	for (std::size_t v = 0; v < visits.size(); ++v)
		EXPECT_EQ(visits[v], boundary[v]);
}

TEST(Triangulation, OneVertexTorusOfTwoTriangles)
{
	Triangulation t = oneVertexTorus();
	expectConsistent(t);
	EXPECT_EQ(t.edgeCount(), 3);
	EXPECT_EQ(t.eulerCharacteristic(), 0);
	EXPECT_TRUE(t.boundaryLoops().empty());
	for (int e = 0; e < 3; ++e) {
		EXPECT_TRUE(t.isFlippable(e));
		t.flip(e);
		expectConsistent(t);
		EXPECT_EQ(t.eulerCharacteristic(), 0);
	}
}

TEST(Triangulation, TriangleGluedToItself)
{
	// A cone: two sides of one triangle glued, the third a boundary loop of one edge.
	const Triangulation t(2, {{0, 1, 0}}, {1, 0, -1});
	expectConsistent(t);
	EXPECT_EQ(t.edgeCount(), 2);
	EXPECT_EQ(t.eulerCharacteristic(), 1);
	ASSERT_EQ(t.boundaryLoops().size(), 1u);
	const int outer = t.boundaryLoops().front();
	EXPECT_EQ(t.next(outer), outer);
	for (int e = 0; e < 2; ++e)
		EXPECT_FALSE(t.isFlippable(e));
}

TEST(Triangulation, TwoTrianglesGluedAlongAllSidesMakeASphere)
{
	// Side ab of the front meets ba of the back, and so on.
	const Triangulation t(3, {{0, 1, 2}, {1, 0, 2}}, {3, 5, 4, 0, 2, 1});
	expectConsistent(t);
	EXPECT_EQ(t.eulerCharacteristic(), 2);
	EXPECT_TRUE(t.boundaryLoops().empty());
}

TEST(Triangulation, FlipReplacesTheDiagonal)
{
	Triangulation t(4, {{0, 1, 2}, {0, 2, 3}});
	int diagonal = -1;
	for (int e = 0; e < t.edgeCount(); ++e)
		if (!t.isBoundaryEdge(e))
			diagonal = e;
	ASSERT_TRUE(t.isFlippable(diagonal));
	const int k = t.origin(t.previous(2 * diagonal)), l = t.origin(t.previous(2 * diagonal + 1));
	t.flip(diagonal);
	expectConsistent(t);
	EXPECT_EQ(t.origin(2 * diagonal), l);
	EXPECT_EQ(t.target(2 * diagonal), k);
	for (int e = 0; e < t.edgeCount(); ++e)
		EXPECT_EQ(t.isFlippable(e), e == diagonal);
}

TEST(Triangulation, UnflipUndoesFlipsHalfedgeForHalfedge)
{
	Random random(1);
	Triangulation surfaces[] = {
		oneVertexTorus(),
		Triangulation(3, {{0, 1, 2}, {1, 0, 2}}, {3, 5, 4, 0, 2, 1}),
		glue(bumpyTorus(8, 6, random)),
		glue(randomPlanarDisk(6, random))};
	for (Triangulation& t : surfaces) {
		const State before(t);
		const int chi = t.eulerCharacteristic();
		const auto loops = t.boundaryLoops();
		// Long random sequences reach loops, multiple edges and triangles glued to themselves.
		const std::vector<int> flipped = flipAtRandom(t, 500, random);
		expectConsistent(t);
		EXPECT_EQ(t.eulerCharacteristic(), chi);
		EXPECT_EQ(t.boundaryLoops(), loops);
		for (auto e = flipped.rbegin(); e != flipped.rend(); ++e)
			t.unflip(*e);
		EXPECT_TRUE(State(t) == before);
	}
}

TEST(Triangulation, FlipChangesFourValencesByOne)
{
	Random random(2);
	Triangulation t = glue(bumpyTorus(8, 6, random));
	const auto valence = [&] {
		std::vector<int> n(at(t.vertexCount()), 0);
		for (int h = 0; h < t.halfedgeCount(); ++h)
			++n[at(t.origin(h))];
		return n;
	};
	for (int e = 0; e < t.edgeCount(); ++e) {
		std::vector<int> expected = valence();
		--expected[at(t.origin(2 * e))];
		--expected[at(t.target(2 * e))];
		++expected[at(t.origin(t.previous(2 * e)))];
		++expected[at(t.origin(t.previous(2 * e + 1)))];
		t.flip(e);
		EXPECT_EQ(valence(), expected);
		t.unflip(e);
	}
}

} // namespace
} // namespace ricci::testing
