// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/error.h>
#include <ricci/math/orientation.h>
#include <ricci/surface/triangulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

/// Side ab of the front meets ba of the back, and so on.
Triangulation sphereOfTwoTriangles()
{
	return glued(3, {{0, 1, 2}, {1, 0, 2}}, {3, 5, 4, 0, 2, 1});
}

/// A cone: two sides of one triangle glued, the third a boundary loop of one edge.
Triangulation coneOfOneTriangle()
{
	return glued(2, {{0, 1, 0}}, {1, 0, -1});
}

/// All of a triangulation but the choice of halfedge(f) among the three of a face.
struct State
{
	std::vector<Halfedge> next;
	std::vector<Vertex> origin;
	std::vector<Face> face;

	explicit State(const Triangulation& t)
	{
		for (const Halfedge h : t.halfedges()) {
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
	FaceArray<int> sidesOf(t.faceCount(), 0);
	HalfedgeArray<int> entering(t.halfedgeCount(), 0);
	for (const Halfedge h : t.halfedges()) {
		ASSERT_EQ(t.origin(t.next(h)), t.target(h)) << "halfedge " << h.number();
		ASSERT_EQ(t.face(t.next(h)), t.face(h)) << "halfedge " << h.number();
		++entering[t.next(h)];
		if (t.isExterior(h))
			continue;
		ASSERT_EQ(t.next(t.next(t.next(h))), h);
		++sidesOf[t.face(h)];
	}
	EXPECT_TRUE(std::all_of(sidesOf.begin(), sidesOf.end(), [](int n) { return n == 3; }));
	EXPECT_TRUE(std::all_of(entering.begin(), entering.end(), [](int n) { return n == 1; }));
	for (const Face f : t.faces())
		for (const Halfedge h : t.halfedges(f))
			ASSERT_EQ(t.face(h), f);
}

/// Flips of random flippable edges; returns them in order.
std::vector<Edge> flipAtRandom(Triangulation& t, int count, Random& random)
{
	std::vector<Edge> flipped;
	while (static_cast<int>(flipped.size()) < count) {
		const Edge e(random.index(t.edgeCount()));
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
	const Triangulation t = glued(mesh);
	expectConsistent(t);
	EXPECT_EQ(t.faceCount(), 4);
	EXPECT_EQ(t.edgeCount(), 6);
	EXPECT_TRUE(t.boundaryLoops().empty());
	EXPECT_EQ(t.eulerCharacteristic(), 2);
	for (const Face f : t.faces())
		for (std::size_t k = 0; k < 3; ++k)
			EXPECT_EQ(t.origin(t.halfedges(f)[k]), Vertex(mesh.triangles[at(f)][k]));
}

TEST(Triangulation, RefusesAnEdgeOfTwoTrianglesThatDisagree)
{
	const auto expectRefusal = [](int vertexCount,
								  const std::vector<Triangle>& triangles,
								  std::size_t sides,
								  std::array<int, 2> ends) {
		const auto error = refusalOf<InvalidMesh>([&] { Triangulation(vertexCount, triangles); });
		EXPECT_EQ(error.problem, InvalidMesh::IncoherentEdge);
		EXPECT_EQ(error.count, sides);
		EXPECT_EQ(error.vertices, ends);
		EXPECT_EQ(
			std::string(error.what()),
			"The edge between vertices " + std::to_string(ends[0]) + " and " +
				std::to_string(ends[1]) + " is not shared by two coherent triangles");
	};
	expectRefusal(4, {{0, 1, 2}, {0, 1, 3}}, 2, {0, 1});
	expectRefusal(5, {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}, 3, {0, 1});
	expectRefusal(5, {{0, 3, 1}, {1, 2, 4}, {3, 0, 2}, {4, 1, 2}}, 2, {1, 2});
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
		const Triangulation t = glued(c.mesh);
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
	const Triangulation t = glued(ring(1, 2, 7, 3));
	VertexArray<int> visits(t.vertexCount(), 0);
	for (const Halfedge first : t.boundaryLoops()) {
		Halfedge h = first;
		int length = 0;
		do {
			EXPECT_TRUE(t.isExterior(h));
			++visits[t.origin(h)];
			++length;
			h = t.next(h);
		} while (h != first);
		EXPECT_EQ(length, 7);
	}
	const VertexArray<char> boundary = t.boundaryVertices();
	for (const Vertex v : t.vertices())
		EXPECT_EQ(visits[v], boundary[v]);
}

TEST(Triangulation, OneVertexTorusOfTwoTriangles)
{
	Triangulation t = oneVertexTorus();
	expectConsistent(t);
	EXPECT_EQ(t.edgeCount(), 3);
	EXPECT_EQ(t.eulerCharacteristic(), 0);
	EXPECT_TRUE(t.boundaryLoops().empty());
	for (const Edge e : t.edges()) {
		EXPECT_TRUE(t.isFlippable(e));
		t.flip(e);
		expectConsistent(t);
		EXPECT_EQ(t.eulerCharacteristic(), 0);
	}
}

TEST(Triangulation, TriangleGluedToItself)
{
	const Triangulation t = coneOfOneTriangle();
	expectConsistent(t);
	EXPECT_EQ(t.edgeCount(), 2);
	EXPECT_EQ(t.eulerCharacteristic(), 1);
	ASSERT_EQ(t.boundaryLoops().size(), 1u);
	const Halfedge exterior = t.boundaryLoops().front();
	EXPECT_EQ(t.next(exterior), exterior);
	for (const Edge e : t.edges())
		EXPECT_FALSE(t.isFlippable(e));
}

TEST(Triangulation, TwoTrianglesGluedAlongAllSidesMakeASphere)
{
	const Triangulation t = sphereOfTwoTriangles();
	expectConsistent(t);
	EXPECT_EQ(t.eulerCharacteristic(), 2);
	EXPECT_TRUE(t.boundaryLoops().empty());
}

TEST(Triangulation, FlipReplacesTheDiagonal)
{
	Triangulation t(4, {{0, 1, 2}, {0, 2, 3}});
	Edge diagonal;
	for (const Edge e : t.edges())
		if (!t.isBoundary(e))
			diagonal = e;
	ASSERT_TRUE(t.isFlippable(diagonal));
	const Vertex k = t.apex(diagonal.halfedge()), l = t.apex(diagonal.halfedge().twin());
	t.flip(diagonal);
	expectConsistent(t);
	EXPECT_EQ(t.origin(diagonal.halfedge()), l);
	EXPECT_EQ(t.target(diagonal.halfedge()), k);
	for (const Edge e : t.edges())
		EXPECT_EQ(t.isFlippable(e), e == diagonal);
}

TEST(Triangulation, UnflipUndoesFlipsHalfedgeForHalfedge)
{
	Random random(1);
	Triangulation surfaces[] = {
		oneVertexTorus(),
		sphereOfTwoTriangles(),
		glued(bumpyTorus(8, 6, random)),
		glued(randomPlanarDisk(6, random))};
	for (Triangulation& t : surfaces) {
		const State before(t);
		const int chi = t.eulerCharacteristic();
		const auto loops = t.boundaryLoops();
		// Long random sequences reach loops, multiple edges and triangles glued to themselves.
		const std::vector<Edge> flipped = flipAtRandom(t, 500, random);
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
	Triangulation t = glued(bumpyTorus(8, 6, random));
	const auto valence = [&] {
		VertexArray<int> n(t.vertexCount(), 0);
		for (const Halfedge h : t.halfedges())
			++n[t.origin(h)];
		return n;
	};
	for (const Edge e : t.edges()) {
		VertexArray<int> expected = valence();
		--expected[t.origin(e.halfedge())];
		--expected[t.target(e.halfedge())];
		++expected[t.apex(e.halfedge())];
		++expected[t.apex(e.halfedge().twin())];
		t.flip(e);
		EXPECT_EQ(valence(), expected);
		t.unflip(e);
	}
}

/// The halfedges for which \p test(h) holds, in increasing order.
template<class Test>
std::vector<Halfedge> halfedgesWith(const Triangulation& t, Test test)
{
	std::vector<Halfedge> found;
	for (int number = 0; number < t.halfedgeCount(); ++number)
		if (test(Halfedge(number)))
			found.push_back(Halfedge(number));
	return found;
}

/// What a range gives, in its order; cut off where it gives more than there is.
template<class Range>
std::vector<Halfedge> listOf(const Triangulation& t, const Range& range)
{
	std::vector<Halfedge> list;
	for (const Halfedge h : range) {
		list.push_back(h);
		if (static_cast<int>(list.size()) > t.halfedgeCount()) {
			ADD_FAILURE() << "a range that does not end";
			break;
		}
	}
	return list;
}

std::vector<Halfedge> sorted(std::vector<Halfedge> list)
{
	std::sort(list.begin(), list.end());
	return list;
}

/// halfedge(v), by the origins and faces of all halfedges: inside; on the boundary with the exterior
/// on its right; none without a face.
void expectVertexHalfedges(const Triangulation& t)
{
	for (const Vertex v : t.vertices()) {
		const auto leaving = halfedgesWith(t, [&](Halfedge h) { return t.origin(h) == v; });
		const Halfedge h = t.halfedge(v);
		ASSERT_EQ(h.isValid(), !leaving.empty()) << "vertex " << v.number();
		if (leaving.empty())
			continue;
		ASSERT_EQ(t.origin(h), v);
		ASSERT_FALSE(t.isExterior(h)) << "vertex " << v.number();
		const bool onBoundary = std::any_of(
			leaving.begin(), leaving.end(), [&](Halfedge g) { return t.isExterior(g); });
		ASSERT_EQ(t.isExterior(h.twin()), onBoundary) << "vertex " << v.number();
	}
}

/// Every range against a search through all halfedges.
void expectCirculators(const Triangulation& t)
{
	const auto inside = halfedgesWith(t, [&](Halfedge h) { return t.face(h).isValid(); });
	const auto outside = halfedgesWith(t, [&](Halfedge h) { return !t.face(h).isValid(); });
	ASSERT_EQ(listOf(t, t.interiorHalfedges()), inside);
	ASSERT_EQ(listOf(t, t.exteriorHalfedges()), outside);

	for (const Vertex v : t.vertices()) {
		const auto star = listOf(t, t.around(v));
		ASSERT_EQ(sorted(star), halfedgesWith(t, [&](Halfedge h) { return t.origin(h) == v; }))
			<< "vertex " << v.number();
		for (std::size_t i = 0; i < star.size(); ++i) {
			ASSERT_EQ(star[(i + 1) % star.size()], t.next(star[i].twin()));
			// The exterior lies between the last halfedge and the first.
			ASSERT_EQ(t.isExterior(star[i]), i == 1 % star.size() && t.isExterior(star[0].twin()));
		}
		if (!star.empty()) {
			ASSERT_EQ(star.front(), t.halfedge(v));
		}
	}

	HalfedgeArray<int> visits(t.halfedgeCount(), 0);
	for (const Face f : t.faces()) {
		const auto sides = listOf(t, t.loop(t.halfedge(f)));
		ASSERT_EQ(sorted(sides), halfedgesWith(t, [&](Halfedge h) { return t.face(h) == f; }));
		ASSERT_EQ(sides.size(), 3u);
		for (const Halfedge h : sides)
			++visits[h];
	}
	for (const Halfedge first : t.boundaryLoops())
		for (const Halfedge h : t.loop(first)) {
			ASSERT_TRUE(t.isExterior(h));
			++visits[h];
		}
	for (const Halfedge h : t.halfedges()) {
		ASSERT_EQ(visits[h], 1) << "halfedge " << h.number();
		const auto loop = listOf(t, t.loop(h));
		ASSERT_EQ(loop.front(), h);
		for (std::size_t i = 0; i < loop.size(); ++i) {
			ASSERT_EQ(t.target(loop[i]), t.origin(loop[(i + 1) % loop.size()]));
			ASSERT_EQ(std::count(loop.begin(), loop.end(), loop[i]), 1);
		}
	}
}

/// The two faces of an edge are (h, quad[0], quad[1]) and (twin, quad[2], quad[3]).
void expectQuads(const Triangulation& t)
{
	for (const Edge e : t.edges()) {
		const Halfedge h = e.halfedge(), g = h.twin();
		const bool twoFaces = t.face(h).isValid() && t.face(g).isValid() && t.face(h) != t.face(g);
		ASSERT_EQ(t.isFlippable(e), twoFaces);
		if (!twoFaces)
			continue;
		const auto quad = t.quad(e);
		const auto ends = t.ends(e);
		const auto sidesOf = [&](Halfedge x) {
			return halfedgesWith(t, [&](Halfedge y) { return t.face(y) == t.face(x); });
		};
		ASSERT_EQ(sorted({h, quad[0], quad[1]}), sidesOf(h));
		ASSERT_EQ(sorted({g, quad[2], quad[3]}), sidesOf(g));
		// Counter-clockwise round the quad from the end of h: j, k, i, l.
		const std::array<Vertex, 4> corners{ends[1], t.apex(h), ends[0], t.apex(g)};
		for (std::size_t k = 0; k < 4; ++k) {
			ASSERT_EQ(t.origin(quad[k]), corners[k]);
			ASSERT_EQ(t.target(quad[k]), corners[(k + 1) % 4]);
		}
	}
}

TEST(Triangulation, RangesFollowRandomFlipsAndUnflips)
{
	Random random(3);
	const struct
	{
		const char* name;
		Triangulation triangulation;
	} surfaces[] = {
		{"one vertex", oneVertexTorus()},
		{"two triangles", sphereOfTwoTriangles()},
		{"one triangle glued to itself", coneOfOneTriangle()},
		{"torus", glued(bumpyTorus(5, 4, random))},
		{"disk", glued(randomPlanarDisk(4, random))},
		{"ring", glued(ring(1, 2, 6, 2))},
		{"genus 2 with a hole", glued(withoutStars(perforatedSlab(2, 1), {0}))},
		{"vertices without a face", Triangulation(7, {{1, 2, 4}, {1, 4, 5}, {2, 1, 6}})},
		{"two pieces", glued(sideBySide(tetrahedron(), rectangle(2, 2, 1, 1), 5))}};
	int named = 0, onBoundary = 0, glueings = 0, loopsOfOneEdge = 0;
	for (const auto& s : surfaces) {
		SCOPED_TRACE(s.name);
		Triangulation t = s.triangulation;
		const VertexArray<char> boundary = t.boundaryVertices();
		for (int step = 0; step < 300; ++step) {
			ASSERT_NO_FATAL_FAILURE(expectVertexHalfedges(t));
			if (step % 15 == 0) {
				ASSERT_NO_FATAL_FAILURE(expectConsistent(t));
				ASSERT_NO_FATAL_FAILURE(expectCirculators(t));
				ASSERT_NO_FATAL_FAILURE(expectQuads(t));
				EXPECT_EQ(t.boundaryVertices(), boundary);
			}
			const Edge e(random.index(t.edgeCount()));
			glueings += t.face(e.halfedge()) == t.face(e.halfedge().twin());
			loopsOfOneEdge += t.ends(e)[0] == t.ends(e)[1];
			if (!t.isFlippable(e))
				continue;
			for (const Vertex v : t.ends(e)) {
				named += t.halfedge(v).edge() == e;
				onBoundary += boundary[v];
			}
			if (random.coin())
				t.flip(e);
			else
				t.unflip(e);
		}
	}
	// Flips of the edges that vertices name, at the boundary, and surfaces that no mesh has.
	EXPECT_GT(named, 100);
	EXPECT_GT(onBoundary, 100);
	EXPECT_GT(glueings, 100);
	EXPECT_GT(loopsOfOneEdge, 100);
}

TEST(Triangulation, AroundAVertexIsClockwise)
{
	Random random(4);
	const SurfaceMesh mesh = randomPlanarDisk(7, random);
	const auto place = [&](Vertex v) {
		return Point2{mesh.positions[at(v)][0], mesh.positions[at(v)][1]};
	};
	const auto side = [&](Vertex a, Vertex b, Vertex c) {
		return orientation(place(a), place(b), place(c));
	};
	Triangulation t = glued(mesh);
	int flips = 0, turns = 0;
	for (int attempt = 0; attempt < 400; ++attempt) {
		const Edge e(random.index(t.edgeCount()));
		if (!t.isFlippable(e))
			continue;
		const auto [i, j] = t.ends(e);
		const Vertex k = t.apex(e.halfedge()), l = t.apex(e.halfedge().twin());
		if (side(l, k, i) > 0 && side(l, k, j) < 0) { // a convex quad stays in the plane
			t.flip(e);
			++flips;
		}
	}
	for (const Vertex v : t.vertices()) {
		Halfedge before;
		for (const Halfedge h : t.around(v)) {
			// Across the exterior the turn may be of more than pi.
			if (before.isValid() && !t.isExterior(h)) {
				EXPECT_LT(side(v, t.target(before), t.target(h)), 0) << "vertex " << v.number();
				++turns;
			}
			before = h;
		}
	}
	EXPECT_GT(flips, 50);
	EXPECT_GT(turns, 200);
}

} // namespace
} // namespace ricci::testing
