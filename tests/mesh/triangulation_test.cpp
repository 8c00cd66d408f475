// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/mesh/triangulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace ricci::testing {
namespace {

struct Surface
{
	const char* name;
	Triangulation triangulation;
	int faces, chi, loops;
};

/// Side ab of the front meets ba of the back, and so on.
Triangulation sphereOfTwoTriangles()
{
	return glued(3, {{0, 1, 2}, {1, 0, 2}}, {3, 5, 4, 0, 2, 1});
}

/// Two sides of one triangle glued, the third a boundary loop of one edge.
Triangulation coneOfOneTriangle()
{
	return glued(2, {{0, 1, 0}}, {1, 0, -1});
}

std::vector<Surface> surfaces(Random& random)
{
	return {
		{"one vertex", oneVertexTorus(), 2, 0, 0},
		{"two triangles", sphereOfTwoTriangles(), 2, 2, 0},
		{"one triangle glued to itself", coneOfOneTriangle(), 1, 1, 1},
		{"torus", glued(bumpyTorus(5, 4, random)), 40, 0, 0},
		{"disk", glued(randomPlanarDisk(4, random)), 32, 1, 1},
		{"ring", glued(ring(1, 2, 6, 2)), 24, 0, 2},
		{"genus 3", glued(perforatedSlab(3, 1)), 136, -4, 0},
		{"genus 2 with a hole", glued(withoutStars(perforatedSlab(2, 1), {0})), 94, -3, 1},
		{"torus with holes", glued(withoutStars(torus(3, 1, 9, 9), {0, 40})), 150, -2, 2},
		{"unused vertices", Triangulation(7, {{1, 2, 4}, {1, 4, 5}, {2, 1, 6}}), 3, 1, 1},
		{"two pieces", glued(sideBySide(tetrahedron(), rectangle(2, 2, 1, 1), 5)), 12, 3, 1}};
}

/// All of a triangulation but the choice of halfedge(f) among the three of a face.
std::vector<std::array<int, 3>> stateOf(const Triangulation& t)
{
	std::vector<std::array<int, 3>> state;
	for (const Halfedge h : t.halfedges())
		state.push_back({t.next(h).number(), t.origin(h).number(), t.face(h).number()});
	return state;
}

/// The halfedges for which \p test(h) holds, in increasing order.
template<class Test>
std::vector<Halfedge> halfedgesWith(const Triangulation& t, Test test)
{
	std::vector<Halfedge> found;
	for (const Halfedge h : t.halfedges())
		if (test(h))
			found.push_back(h);
	return found;
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
		ASSERT_EQ(t.boundaryVertices()[v] != 0, onBoundary);
	}
}

TEST(Triangulation, RefusesAnEdgeOfTwoTrianglesThatDisagree)
{
	const struct
	{
		int vertexCount;
		std::vector<Triangle> triangles;
		std::size_t sides;
		std::array<int, 2> ends;
	} cases[] = {
		{4, {{0, 1, 2}, {0, 1, 3}}, 2, {0, 1}},
		{5, {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}, 3, {0, 1}},
		{5, {{0, 3, 1}, {1, 2, 4}, {3, 0, 2}, {4, 1, 2}}, 2, {1, 2}}};
	for (const auto& c : cases) {
		const auto error = refusalFor<InvalidMesh>(
			InvalidMesh::IncoherentEdge,
			{"between vertices " + std::to_string(c.ends[0]) + " and " + std::to_string(c.ends[1])},
			[&] { Triangulation(c.vertexCount, c.triangles); });
		EXPECT_EQ(error.count, c.sides);
		EXPECT_EQ(error.vertices, c.ends);
	}
}

/// Long random sequences reach loops, multiple edges and triangles glued to themselves.
TEST(Triangulation, StaysConsistentUnderFlipsAndComesBack)
{
	Random random(3);
	int named = 0, onBoundary = 0, glueings = 0, loopsOfOneEdge = 0;
	for (const Surface& s : surfaces(random)) {
		SCOPED_TRACE(s.name);
		Triangulation t = s.triangulation;
		const auto before = stateOf(t);
		const VertexArray<char> boundary = t.boundaryVertices();
		const auto loops = t.boundaryLoops();
		std::vector<Edge> flipped;
		for (int step = 0; step < 300; ++step) {
			ASSERT_NO_FATAL_FAILURE(expectVertexHalfedges(t));
			if (step % 15 == 0) {
				EXPECT_EQ(t.faceCount(), s.faces);
				EXPECT_EQ(t.eulerCharacteristic(), s.chi);
				EXPECT_EQ(static_cast<int>(t.boundaryLoops().size()), s.loops);
				EXPECT_EQ(t.boundaryLoops(), loops);
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
			const Vertex k = t.apex(e.halfedge()), l = t.apex(e.halfedge().twin());
			t.flip(e);
			EXPECT_EQ(t.ends(e), (std::array<Vertex, 2>{l, k}));
			flipped.push_back(e);
		}
		for (auto e = flipped.rbegin(); e != flipped.rend(); ++e) {
			t.unflip(*e);
			ASSERT_NO_FATAL_FAILURE(expectVertexHalfedges(t));
		}
		EXPECT_EQ(stateOf(t), before);
	}
	// Flips of the edges that vertices name, at the boundary, and surfaces that no mesh has.
	EXPECT_GT(named, 100);
	EXPECT_GT(onBoundary, 100);
	EXPECT_GT(glueings, 100);
	EXPECT_GT(loopsOfOneEdge, 100);
}

} // namespace
} // namespace ricci::testing
