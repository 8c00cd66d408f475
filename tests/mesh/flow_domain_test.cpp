// SPDX-License-Identifier: GPL-3.0-or-later
// The surfaces that the flow runs on: their topology, caps on holes, doubles, creases.
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/graphs.h>
#include <ricci/base/numbers.h>
#include <ricci/mesh/flow_domain.h>
#include <ricci/mesh/sides.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace ricci::testing {
namespace {

using DirectedEdges = std::set<std::pair<int, int>>;

/// Sides without a triangle on their right: the boundary, with the surface on the left.
DirectedEdges boundaryOf(const std::vector<Triangle>& triangles)
{
	DirectedEdges sides, boundary;
	for (const Triangle& t : triangles)
		for (std::size_t k = 0; k < 3; ++k)
			sides.insert({t[k], t[(k + 1) % 3]});
	for (const auto& [a, b] : sides)
		if (sides.count({b, a}) == 0)
			boundary.insert({a, b});
	return boundary;
}

/// The loops go along the boundary of \p triangles with the surface on the left, once.
void expectLoops(
	const std::vector<std::vector<Vertex>>& loops, const std::vector<Triangle>& triangles)
{
	DirectedEdges passed;
	std::size_t length = 0;
	for (const auto& loop : loops)
		for (std::size_t i = 0; i < loop.size(); ++i, ++length)
			passed.insert({loop[i].number(), loop[(i + 1) % loop.size()].number()});
	EXPECT_EQ(passed, boundaryOf(triangles));
	EXPECT_EQ(length, passed.size());
}

/// A square of n x n cells without the stars of some inner vertices.
SurfaceMesh squareWithHoles(int n = 9)
{
	const auto vertex = [&](int i, int j) { return i * (n + 1) + j; };
	return withoutStars(
		rectangle(n, n, 1.0, 1.0), {vertex(2, 2), vertex(n - 2, 3), vertex(n / 2, n - 2)});
}

struct Case
{
	std::string name;
	SurfaceMesh mesh;
	int genus, loops;
};

std::vector<Case> surfaces()
{
	Random random(350);
	const std::vector<SurfaceMesh> kinds = surfacesOfEveryKind(random);
	std::vector<Case> cases;
	// The two stars taken from a ball are neighbours: they make one hole.
	for (int i = 0; i < 12; ++i)
		cases.push_back(
			{"kind " + std::to_string(i), kinds[at(i)], i / 3, i < 3 ? std::min(i, 1) : i % 3});
	cases.push_back({"torus", kinds[12], 1, 0});
	cases.push_back({"annulus", kinds[13], 0, 2});
	cases.push_back({"square with holes", shaken(squareWithHoles(), 0.02, random), 0, 4});
	const SurfaceMesh donut = withoutStars(bumpyTorus(9, 9, random), {0, 30, 34, 60});
	cases.push_back({"torus with holes", donut, 1, 4});
	return cases;
}

TEST(Topology, OfSurfacesOfEveryKindDoesNotChangeWithFlips)
{
	Random random(352);
	for (const Case& c : surfaces()) {
		SCOPED_TRACE(c.name);
		Triangulation t = glued(c.mesh);
		const Topology topology = topologyOf(t);
		const SurfaceType& type = topology.type;
		EXPECT_EQ(type.genus, c.genus);
		EXPECT_EQ(type.boundaryLoops, c.loops);
		EXPECT_EQ(type.isClosed(), c.loops == 0);
		EXPECT_EQ(type.isSphere(), c.genus == 0 && c.loops == 0);
		EXPECT_EQ(type.isDisk(), c.genus == 0 && c.loops == 1);
		EXPECT_EQ(type.isAnnulus(), c.genus == 0 && c.loops == 2);
		EXPECT_EQ(type.isTorus(), c.genus == 1 && c.loops == 0);
		EXPECT_EQ(type.eulerCharacteristic(), 2 - 2 * c.genus - c.loops);
		EXPECT_EQ(type.eulerCharacteristic(), t.eulerCharacteristic());
		ASSERT_EQ(static_cast<int>(topology.loops.size()), c.loops);
		expectLoops(topology.loops, c.mesh.triangles);
		std::set<int> onBoundary;
		for (const auto& [a, b] : boundaryOf(c.mesh.triangles))
			onBoundary.insert(a);
		for (const Vertex v : t.vertices())
			EXPECT_EQ(topology.boundary[v] != 0, onBoundary.count(v.number()) == 1);
		for (int flips = 0; flips < 500;) {
			const Edge e(random.index(t.edgeCount()));
			if (!t.isFlippable(e))
				continue;
			t.flip(e);
			++flips;
		}
		const Topology after = topologyOf(t);
		EXPECT_EQ(after.type.genus, c.genus);
		EXPECT_EQ(after.boundary, topology.boundary);
		EXPECT_EQ(after.loops, topology.loops);
	}
}

TEST(Topology, OfSurfacesThatNoMeshHas)
{
	const Topology torus = topologyOf(oneVertexTorus());
	EXPECT_TRUE(torus.type.isTorus());
	EXPECT_TRUE(torus.loops.empty());
	// One triangle with two sides glued: a disk, whose boundary is one edge from a vertex to itself.
	const Topology cone = topologyOf(glued(2, {{0, 1, 0}}, {1, 0, -1}));
	EXPECT_TRUE(cone.type.isDisk());
	EXPECT_EQ(cone.loops, (std::vector<std::vector<Vertex>>{{Vertex(0)}}));
	EXPECT_EQ(cone.boundary, (VertexArray<char>{1, 0}));
	// Vertices without a face do not count.
	const Topology triangle = topologyOf(Triangulation(9, {{4, 1, 2}}));
	EXPECT_TRUE(triangle.type.isDisk());
	EXPECT_EQ(triangle.boundary, (VertexArray<char>{0, 1, 1, 0, 1, 0, 0, 0, 0}));
}

TEST(Topology, HasANameForEveryType)
{
	const std::pair<SurfaceMesh, const char*> cases[] = {
		{perforatedSlab(0, 2), "a closed surface of genus 0 (a sphere)"},
		{torus(3, 1, 9, 7), "a closed surface of genus 1 (a torus)"},
		{perforatedSlab(2, 1), "a closed surface of genus 2"},
		{rectangle(5, 4, 5, 4), "a disk"},
		{ring(1, 2, 9, 3), "an annulus"},
		{withoutStars(torus(3, 1, 9, 9), {0}), "a surface of genus 1 with 1 boundary loop"}};
	for (const auto& [mesh, name] : cases)
		EXPECT_EQ(topologyOf(glued(mesh)).type.name(), name);
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
		EdgeArray<char> inTree(t.edgeCount(), 0), isLeft(t.edgeCount(), 0);
		for (const Halfedge h : paths.parent)
			if (h.isValid())
				inTree[h.edge()] = 1;
		EdgeArray<double> length(t.edgeCount(), 0.0);
		for (double& l : length)
			l = random.real(1.0, 2.0);
		const std::vector<Edge> rest = edgesBesideCotree(t, inTree, length);
		ASSERT_EQ(rest.size(), at(2 * genus));
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
				std::swap(isLeft[e], isLeft[other]);
				EXPECT_GT(pieces(), 1);
				std::swap(isLeft[e], isLeft[other]);
			}
	}
}

/// The surface of \p triangles with their metric in space.
void expectEmbedded(
	const EmbeddedSurface& s,
	const VertexArray<Point3>& positions,
	const std::vector<Triangle>& triangles)
{
	const Triangulation& t = s.triangulation;
	EXPECT_EQ(s.positions, positions);
	ASSERT_EQ(t.vertexCount(), positions.size());
	ASSERT_EQ(t.faceCount(), static_cast<int>(triangles.size()));
	for (const Face f : t.faces())
		for (std::size_t k = 0; k < 3; ++k)
			ASSERT_EQ(t.origin(t.halfedges(f)[k]), Vertex(triangles[at(f)][k]));
	ASSERT_EQ(s.lengths.size(), t.edgeCount());
	for (const Edge e : t.edges()) {
		const auto [i, j] = t.ends(e);
		EXPECT_DOUBLE_EQ(s.lengths[e], distance(s.positions[i], s.positions[j]));
	}
	EXPECT_EQ(s.topology.type.eulerCharacteristic(), t.eulerCharacteristic());
	expectLoops(s.topology.loops, triangles);
}

TEST(FlowDomain, CapsCloseAllLoopsButTheLongest)
{
	for (const Case& c : surfaces()) {
		SCOPED_TRACE(c.name);
		const Component component = onlyComponent(c.mesh);
		const FlowDomain open = flowDomain(component, Holes::Boundaries);
		const FlowDomain domain = flowDomain(component, Holes::Capped);
		for (const FlowDomain* d : {&open, &domain}) {
			expectEmbedded(d->surface, component.positions, component.triangles);
			const bool isCapped = d == &domain && c.loops > 1;
			EXPECT_EQ(d->holes, isCapped ? c.loops - 1 : 0);
			ASSERT_EQ(d->capped.has_value(), isCapped);
			EXPECT_EQ(&d->solved(), isCapped ? &*d->capped : &d->surface);
		}

		// The rims of the caps, and nothing else, are marked; the flow has the longest loop alone.
		const Triangulation& t = domain.surface.triangulation;
		const Topology& topology = domain.surface.topology;
		VertexArray<char> rims(t.vertexCount(), 0);
		const auto lengthOf = [&](const std::vector<Vertex>& loop) {
			double length = 0.0;
			for (std::size_t i = 0; i < loop.size(); ++i)
				length += distance(
					component.positions[loop[i]], component.positions[loop[(i + 1) % loop.size()]]);
			return length;
		};
		const auto longest = std::max_element(
			topology.loops.begin(), topology.loops.end(), [&](const auto& a, const auto& b) {
				return lengthOf(a) < lengthOf(b);
			});
		for (auto loop = topology.loops.begin(); loop != topology.loops.end(); ++loop)
			for (const Vertex v : *loop)
				rims[v] = loop != longest;
		EXPECT_EQ(open.onHole, VertexArray<char>(t.vertexCount(), 0));
		EXPECT_EQ(domain.onHole, rims);
		const Topology& solved = domain.solved().topology;
		EXPECT_EQ(solved.type.genus, c.genus);
		ASSERT_EQ(solved.type.boundaryLoops, std::min(c.loops, 1));
		if (c.loops > 0) {
			EXPECT_EQ(solved.loops[0].size(), longest->size());
			EXPECT_TRUE(std::is_permutation(
				solved.loops[0].begin(), solved.loops[0].end(), longest->begin()));
		}

		// Numbers and metric of the surface stay. A fan round one new vertex for each hole, and its
		// triangles measured in space.
		const Triangulation& closed = domain.solved().triangulation;
		for (const Halfedge h : t.halfedges()) {
			ASSERT_EQ(closed.origin(h), t.origin(h));
			if (!t.isExterior(h)) {
				ASSERT_EQ(closed.next(h), t.next(h));
				ASSERT_EQ(closed.face(h), t.face(h));
			}
		}
		const int rim = static_cast<int>(std::count(rims.begin(), rims.end(), 1));
		EXPECT_EQ(closed.vertexCount(), t.vertexCount() + domain.holes);
		EXPECT_EQ(closed.faceCount(), t.faceCount() + rim);
		EXPECT_EQ(closed.edgeCount(), t.edgeCount() + rim);
		std::vector<Triangle> triangles;
		for (const Face f : closed.faces()) {
			const auto [i, j, k] = closed.vertices(f);
			triangles.push_back({i.number(), j.number(), k.number()});
			if (f < Face(t.faceCount()))
				continue;
			EXPECT_TRUE(domain.onHole[i] && domain.onHole[j]);
			EXPECT_GE(k.number(), t.vertexCount());
		}
		expectEmbedded(domain.solved(), domain.solved().positions, triangles);
	}
}

TEST(DoubleSurface, IsTwoMirroredCopiesGluedAlongTheBoundary)
{
	Random random(340);
	const std::pair<const char*, Triangulation> cases[] = {
		{"disk", glued(randomPlanarDisk(6, random))},
		{"ring", glued(ring(1, 2, 9, 3))},
		{"pierced torus", glued(withoutStars(torus(3, 1, 9, 9), {0, 40}))},
		{"triangle", Triangulation(3, {{0, 1, 2}})},
		{"an edge between two boundary vertices", Triangulation(4, {{0, 1, 2}, {0, 2, 3}})},
		{"triangle glued to itself", glued(2, {{0, 1, 0}}, {1, 0, -1})}};
	for (const auto& [name, t] : cases) {
		SCOPED_TRACE(name);
		const DoubleSurface d = doubleOf(t);
		const Triangulation& closed = d.triangulation;
		const VertexArray<char> boundary = t.boundaryVertices();
		const auto rim = static_cast<int>(std::count(boundary.begin(), boundary.end(), 1));
		EXPECT_EQ(closed.faceCount(), 2 * t.faceCount());
		EXPECT_EQ(closed.vertexCount(), 2 * t.vertexCount() - rim);
		// The boundary is made of circles, whose characteristic is 0.
		EXPECT_EQ(closed.eulerCharacteristic(), 2 * t.eulerCharacteristic());
		for (const Halfedge h : closed.halfedges()) {
			ASSERT_FALSE(closed.isExterior(h));
			ASSERT_EQ(closed.next(closed.next(closed.next(h))), h);
			ASSERT_EQ(closed.origin(closed.next(h)), closed.target(h));
		}

		// The first copy keeps its numbers.
		for (const Halfedge h : t.halfedges()) {
			EXPECT_EQ(closed.origin(h), t.origin(h));
			EXPECT_EQ(d.edgeOf[h.edge()], h.edge());
			if (t.isExterior(h)) {
				EXPECT_GE(closed.face(h).number(), t.faceCount());
				continue;
			}
			EXPECT_EQ(closed.face(h), t.face(h));
			EXPECT_EQ(closed.next(h), t.next(h));
		}
		ASSERT_EQ(d.mirror.size(), closed.vertexCount());
		for (const Vertex v : d.mirror.indices()) {
			EXPECT_EQ(d.mirror[d.mirror[v]], v);
			EXPECT_EQ(d.mirror[v] == v, v.number() < boundary.size() && boundary[v]);
		}

		// Every edge is its own or mirrors one. An edge inside that joins two boundary vertices has two
		// copies with the same ends.
		EdgeArray<int> copies(t.edgeCount(), 0);
		for (const Edge e : closed.edges()) {
			const Edge original = d.edgeOf[e];
			ASSERT_TRUE(original.isValid() && original.number() < t.edgeCount());
			++copies[original];
			if (e == original)
				continue;
			const auto [a, b] = closed.ends(e);
			const std::array<Vertex, 2> mirrored{d.mirror[a], d.mirror[b]}, own = t.ends(original);
			EXPECT_TRUE(std::is_permutation(mirrored.begin(), mirrored.end(), own.begin()));
			for (const Halfedge h : {e.halfedge(), e.halfedge().twin()})
				EXPECT_GE(closed.face(h).number(), t.faceCount());
		}
		for (const Edge e : t.edges())
			EXPECT_EQ(copies[e], t.isBoundary(e) ? 1 : 2);

		// The second copy of each face is the mirror image of the first.
		for (const Face f : t.faces()) {
			EXPECT_EQ(closed.halfedges(f), t.halfedges(f));
			const auto own = closed.vertices(f);
			auto image = closed.vertices(Face(t.faceCount() + f.number()));
			const std::array<Vertex, 3> backward{
				d.mirror[own[0]], d.mirror[own[2]], d.mirror[own[1]]};
			bool found = false;
			for (int turn = 0; turn < 3; ++turn) {
				found |= image == backward;
				std::rotate(image.begin(), image.begin() + 1, image.end());
			}
			EXPECT_TRUE(found) << "face " << f.number();
		}
	}
}

Creases creasesOf(const SurfaceMesh& mesh, double degrees)
{
	return creases(mesh.positions, mesh.triangles, Sides(mesh.triangles), degrees * kPi / 180.0);
}

/// The faces of a cylinder with n sides meet at 360 / n degrees along its length, and at a right angle along its
/// two rims.
TEST(Creases, OfACylinder)
{
	constexpr int kSides = 12;
	const SurfaceMesh mesh =
		revolved({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}, {0.0, 2.0}}, kSides);
	EXPECT_EQ(creasesOf(mesh, 29.0).edges, 2 * kSides + 2 * kSides);
	EXPECT_EQ(creasesOf(mesh, 31.0).edges, 2 * kSides);
	EXPECT_EQ(creasesOf(mesh, 89.0).edges, 2 * kSides);
	EXPECT_EQ(creasesOf(mesh, 91.0).edges, 0);
	const Creases rims = creasesOf(mesh, 60.0);
	int marks = 0;
	for (const auto& sides : rims.sides)
		marks += sides[0] + sides[1] + sides[2];
	EXPECT_EQ(marks, rims.edges); // one side each
	// All curvature is at the rims.
	EXPECT_NEAR(rims.curvatureBetween, 0.0, 1e-12);
	EXPECT_NEAR(creasesOf(mesh, 91.0).curvatureBetween, 1.0, 1e-12);
}

/// Two tips of curvature 2 pi less their angles, the rest at the rim.
TEST(Creases, ADoubleConeKeepsItsTipsBetweenThem)
{
	constexpr int kSides = 60;
	const SurfaceMesh mesh = revolved({{0.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}}, kSides);
	const Creases rim = creasesOf(mesh, 60.0);
	EXPECT_EQ(rim.edges, kSides);
	const double side = std::sqrt(2.0), base = 2.0 * std::sin(kPi / kSides);
	const double tip = 2.0 * kPi - kSides * 2.0 * std::asin(0.5 * base / side);
	EXPECT_NEAR(rim.curvatureBetween, 2.0 * tip / (4.0 * kPi), 1e-12);
}

} // namespace
} // namespace ricci::testing
