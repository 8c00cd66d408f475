// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/surface/flow_domain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

using DirectedEdge = std::pair<int, int>;

/// Sides of the triangles of a mesh, in their directions.
std::set<DirectedEdge> sidesOf(const std::vector<Triangle>& triangles)
{
	std::set<DirectedEdge> sides;
	for (const Triangle& t : triangles)
		for (std::size_t k = 0; k < 3; ++k)
			sides.insert({t[k], t[(k + 1) % 3]});
	return sides;
}

/// Sides without a triangle on their right: the boundary, with the surface on the left.
std::set<DirectedEdge> boundaryOf(const std::vector<Triangle>& triangles)
{
	const std::set<DirectedEdge> sides = sidesOf(triangles);
	std::set<DirectedEdge> boundary;
	for (const auto& [a, b] : sides)
		if (sides.count({b, a}) == 0)
			boundary.insert({a, b});
	return boundary;
}

/// V - E + F by counting vertex pairs.
int eulerCharacteristic(const std::vector<Triangle>& triangles)
{
	std::set<int> vertices;
	std::set<DirectedEdge> edges;
	for (const auto& [a, b] : sidesOf(triangles)) {
		vertices.insert(a);
		edges.insert(std::minmax(a, b));
	}
	return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) +
		   static_cast<int>(triangles.size());
}

/// The loops go along the boundary of \p triangles with the surface on the left, once.
void expectLoops(
	const std::vector<std::vector<Vertex>>& loops, const std::vector<Triangle>& triangles)
{
	const std::set<DirectedEdge> boundary = boundaryOf(triangles);
	std::set<DirectedEdge> passed;
	std::size_t length = 0;
	for (const auto& loop : loops)
		for (std::size_t i = 0; i < loop.size(); ++i) {
			passed.insert({loop[i].number(), loop[(i + 1) % loop.size()].number()});
			++length;
		}
	EXPECT_EQ(passed, boundary);
	EXPECT_EQ(length, boundary.size());
}

double lengthOf(const std::vector<Vertex>& loop, const VertexArray<Point3>& positions)
{
	double length = 0.0;
	for (std::size_t i = 0; i < loop.size(); ++i)
		length += distance(positions[loop[i]], positions[loop[(i + 1) % loop.size()]]);
	return length;
}

/// Twice the area that a loop in the plane z = 0 goes round; positive if counter-clockwise.
double signedArea(const std::vector<Vertex>& loop, const VertexArray<Point3>& positions)
{
	double area = 0.0;
	for (std::size_t i = 0; i < loop.size(); ++i) {
		const Point3 &p = positions[loop[i]], &q = positions[loop[(i + 1) % loop.size()]];
		area += p[0] * q[1] - p[1] * q[0];
	}
	return area;
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
	const char* name;
	SurfaceMesh mesh;
	int genus, loops;
};

std::vector<Case> surfacesWithSeveralLoops()
{
	Random random(350);
	return {
		{"square with holes", shaken(squareWithHoles(), 0.02, random), 0, 4},
		{"ring", ring(1, 2, 9, 3), 0, 2},
		{"torus with holes", withoutStars(bumpyTorus(9, 9, random), {0, 30, 34, 60}), 1, 4},
		{"genus 2 with holes", withoutStars(perforatedSlab(2, 3), {0, 40}), 2, 2}};
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
		long double square = 0.0L;
		for (std::size_t x = 0; x < 3; ++x) {
			const long double difference =
				positions[i][x] - static_cast<long double>(positions[j][x]);
			square += difference * difference;
		}
		EXPECT_NEAR(s.lengths[e] / static_cast<double>(std::sqrt(square)), 1.0, 1e-15);
	}
	EXPECT_EQ(s.topology.type.eulerCharacteristic(), eulerCharacteristic(triangles));
	expectLoops(s.topology.loops, triangles);
}

TEST(FlowDomain, EdgeLengthsAreStraight)
{
	const Triangulation t(4, {{0, 1, 2}, {0, 2, 3}});
	const VertexArray<Point3> positions{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 0, 12}};
	const EdgeArray<double> lengths = edgeLengths(t, positions);
	ASSERT_EQ(lengths.size(), 5);
	for (const Edge e : t.edges()) {
		const auto ends = t.ends(e);
		const int a = std::min(ends[0], ends[1]).number(), b = std::max(ends[0], ends[1]).number();
		const double expected = a == 0 ? (b == 1 ? 3.0 : b == 2 ? 5.0 : 12.0) : b == 2 ? 4.0 : 13.0;
		EXPECT_EQ(lengths[e], expected) << a << "-" << b;
	}
}

TEST(FlowDomain, EdgeLengthsAreThoseOfTheTriangulationThatIsHandedOver)
{
	// After a flip the length of the other diagonal in space.
	Triangulation t(4, {{0, 1, 2}, {0, 2, 3}});
	const VertexArray<Point3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1}};
	int flips = 0;
	for (const Edge e : t.edges())
		if (t.isFlippable(e)) {
			EXPECT_NEAR(edgeLengths(t, positions)[e], std::sqrt(2.0), 1e-15);
			t.flip(e);
			++flips;
			EXPECT_NEAR(edgeLengths(t, positions)[e], std::sqrt(3.0), 1e-15);
		}
	EXPECT_EQ(flips, 1);
}

TEST(FlowDomain, TopologyOfSurfacesOfEveryKind)
{
	Random random(351);
	const std::vector<SurfaceMesh> meshes = surfacesOfEveryKind(random);
	// Genus and loops. The two stars taken from a ball are neighbours: they make one hole.
	std::vector<std::pair<int, int>> types;
	for (int genus = 0; genus <= 3; ++genus)
		for (int loops = 0; loops <= 2; ++loops)
			types.emplace_back(genus, genus == 0 ? std::min(loops, 1) : loops);
	types.emplace_back(1, 0);
	types.emplace_back(0, 2);
	ASSERT_EQ(meshes.size(), types.size());
	for (std::size_t i = 0; i < meshes.size(); ++i) {
		SCOPED_TRACE("surface " + std::to_string(i));
		const SurfaceMesh& mesh = meshes[i];
		const auto [genus, loops] = types[i];
		const Triangulation t = glued(mesh);
		const Topology topology = topologyOf(t);
		EXPECT_EQ(topology.type.genus, genus);
		EXPECT_EQ(topology.type.boundaryLoops, loops);
		EXPECT_EQ(topology.type.isClosed(), loops == 0);
		EXPECT_EQ(topology.type.isSphere(), genus == 0 && loops == 0);
		EXPECT_EQ(topology.type.isDisk(), genus == 0 && loops == 1);
		EXPECT_EQ(topology.type.isAnnulus(), genus == 0 && loops == 2);
		EXPECT_EQ(topology.type.isTorus(), genus == 1 && loops == 0);
		EXPECT_EQ(topology.type.eulerCharacteristic(), 2 - 2 * genus - loops);
		EXPECT_EQ(topology.type.eulerCharacteristic(), eulerCharacteristic(mesh.triangles));
		ASSERT_EQ(static_cast<int>(topology.loops.size()), loops);
		expectLoops(topology.loops, mesh.triangles);
		std::set<int> onBoundary;
		for (const auto& [a, b] : boundaryOf(mesh.triangles))
			onBoundary.insert(a);
		ASSERT_EQ(topology.boundary.size(), t.vertexCount());
		for (const Vertex v : t.vertices())
			EXPECT_EQ(topology.boundary[v] != 0, onBoundary.count(v.number()) == 1);
	}
}

TEST(FlowDomain, TopologyDoesNotChangeWithFlips)
{
	Random random(352);
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		Triangulation t = glued(mesh);
		const Topology before = topologyOf(t);
		int flips = 0;
		while (flips < 500) {
			const Edge e(random.index(t.edgeCount()));
			if (!t.isFlippable(e))
				continue;
			t.flip(e);
			++flips;
		}
		const Topology after = topologyOf(t);
		EXPECT_EQ(after.type.genus, before.type.genus);
		EXPECT_EQ(after.type.boundaryLoops, before.type.boundaryLoops);
		EXPECT_EQ(after.boundary, before.boundary);
		EXPECT_EQ(after.loops, before.loops);
	}
}

TEST(FlowDomain, LoopsHaveTheSurfaceOnTheLeft)
{
	// In the plane, seen from above: counter-clockwise outside, clockwise round the holes.
	for (const SurfaceMesh& mesh : {ring(1, 2, 9, 3), squareWithHoles()}) {
		const VertexArray<Point3> positions(mesh.positions);
		const Topology topology = topologyOf(glued(mesh));
		int outside = 0, holes = 0;
		double area = 0.0, covered = 0.0;
		for (const auto& loop : topology.loops) {
			const double enclosed = signedArea(loop, positions);
			area += enclosed;
			++(enclosed > 0 ? outside : holes);
		}
		for (const Triangle& t : mesh.triangles)
			covered += signedArea({Vertex(t[0]), Vertex(t[1]), Vertex(t[2])}, positions);
		EXPECT_EQ(outside, 1);
		EXPECT_EQ(holes, static_cast<int>(topology.loops.size()) - 1);
		EXPECT_NEAR(area, covered, 1e-12);
	}
}

TEST(FlowDomain, TopologyOfSurfacesThatNoMeshHas)
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

TEST(FlowDomain, WithoutCapsIsTheSurfaceItself)
{
	for (const Case& c : surfacesWithSeveralLoops()) {
		SCOPED_TRACE(c.name);
		const Component component = onlyComponent(c.mesh);
		const FlowDomain domain = flowDomain(component, Holes::Boundaries);
		expectEmbedded(domain.surface, component.positions, component.triangles);
		EXPECT_EQ(domain.surface.topology.type.genus, c.genus);
		EXPECT_EQ(domain.surface.topology.type.boundaryLoops, c.loops);
		EXPECT_FALSE(domain.capped.has_value());
		EXPECT_EQ(&domain.solved(), &domain.surface);
		EXPECT_EQ(domain.holes, 0);
		EXPECT_EQ(domain.onHole, VertexArray<char>(domain.surface.triangulation.vertexCount(), 0));
	}
}

TEST(FlowDomain, CapsCloseAllLoopsButTheLongest)
{
	for (const Case& c : surfacesWithSeveralLoops()) {
		SCOPED_TRACE(c.name);
		const Component component = onlyComponent(c.mesh);
		const FlowDomain domain = flowDomain(component, Holes::Capped);
		expectEmbedded(domain.surface, component.positions, component.triangles);
		ASSERT_TRUE(domain.capped.has_value());
		EXPECT_EQ(&domain.solved(), &*domain.capped);
		EXPECT_EQ(domain.holes, c.loops - 1);

		// The flow runs on a surface of the same genus, with the longest loop alone.
		const SurfaceType& type = domain.capped->topology.type;
		EXPECT_EQ(type.genus, c.genus);
		EXPECT_EQ(type.boundaryLoops, 1);
		EXPECT_EQ(
			type.eulerCharacteristic(),
			domain.surface.topology.type.eulerCharacteristic() + domain.holes);
		const Topology& topology = domain.surface.topology;
		const auto longest = std::max_element(
			topology.loops.begin(), topology.loops.end(), [&](const auto& a, const auto& b) {
				return lengthOf(a, component.positions) < lengthOf(b, component.positions);
			});
		ASSERT_EQ(domain.capped->topology.loops.size(), 1u);
		const auto& left = domain.capped->topology.loops.front();
		EXPECT_TRUE(
			left.size() == longest->size() &&
			std::is_permutation(left.begin(), left.end(), longest->begin()));

		// The rims of the caps, and nothing else, are marked.
		VertexArray<char> rims(domain.surface.triangulation.vertexCount(), 0);
		for (auto loop = topology.loops.begin(); loop != topology.loops.end(); ++loop)
			if (loop != longest)
				for (const Vertex v : *loop)
					rims[v] = 1;
		EXPECT_EQ(domain.onHole, rims);
	}
}

TEST(FlowDomain, CapsKeepTheNumbersAndTheMetricOfTheSurface)
{
	for (const Case& c : surfacesWithSeveralLoops()) {
		SCOPED_TRACE(c.name);
		const FlowDomain domain = flowDomain(onlyComponent(c.mesh), Holes::Capped);
		ASSERT_TRUE(domain.capped.has_value());
		const Triangulation& t = domain.surface.triangulation;
		const Triangulation& closed = domain.capped->triangulation;
		for (const Halfedge h : t.interiorHalfedges()) {
			ASSERT_EQ(closed.origin(h), t.origin(h));
			ASSERT_EQ(closed.next(h), t.next(h));
			ASSERT_EQ(closed.face(h), t.face(h));
		}
		for (const Edge e : t.edges())
			EXPECT_EQ(domain.capped->lengths[e], domain.surface.lengths[e]);
		for (const Vertex v : t.vertices())
			EXPECT_EQ(domain.capped->positions[v], domain.surface.positions[v]);

		// A fan round one new vertex for each hole, and its triangles measured in space.
		EXPECT_EQ(closed.vertexCount(), t.vertexCount() + domain.holes);
		int rim = 0;
		for (const char marked : domain.onHole)
			rim += marked;
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
		expectEmbedded(*domain.capped, domain.capped->positions, triangles);
	}
}

TEST(FlowDomain, ShortLoopsAreThoseBelowATenthOfTheRootOfTheArea)
{
	// A square of 1 with a hole: a smaller square less two opposite corners, cut off from the middles of sides.
	for (const double side : {0.0280, 0.0292, 0.0294, 0.04}) {
		SurfaceMesh mesh = withoutStars(rectangle(6, 6, 1.0, 1.0), {16});
		const bool isShort =
			(2 + std::sqrt(2.0)) * side < 0.1 * std::sqrt(1.0 - 0.75 * side * side);
		const Point3 centre{2.0 / 6, 2.0 / 6, 0.0};
		for (Point3& p : mesh.positions) {
			const Point3 d = p - centre;
			const double far = std::max(std::abs(d[0]), std::abs(d[1]));
			if (far < 0.2)
				p = centre + (0.5 * side / far) * d;
		}
		const FlowDomain domain = flowDomain(onlyComponent(mesh), Holes::ShortCapped);
		EXPECT_EQ(domain.holes, isShort ? 1 : 0) << side;
		EXPECT_EQ(domain.capped.has_value(), isShort);
		EXPECT_EQ(domain.surface.topology.type.boundaryLoops, 2);
		EXPECT_EQ(domain.solved().topology.type.boundaryLoops, isShort ? 1 : 2);
		// The same at any scale.
		for (Point3& p : mesh.positions)
			p = 1e6 * p;
		EXPECT_EQ(flowDomain(onlyComponent(mesh), Holes::ShortCapped).holes, domain.holes);
	}
}

TEST(FlowDomain, ASurfaceWithShortLoopsAloneIsClosed)
{
	// Of a fine torus single vertices, and of a coarse one.
	const SurfaceMesh fine = torus(3, 1, 160, 80), coarse = torus(3, 1, 20, 10);
	for (const std::vector<int>& missing : {std::vector<int>{5}, {5, 2000, 7000}}) {
		const FlowDomain domain =
			flowDomain(onlyComponent(withoutStars(fine, missing)), Holes::ShortCapped);
		EXPECT_EQ(domain.holes, static_cast<int>(missing.size()));
		EXPECT_TRUE(domain.solved().topology.type.isTorus());
	}
	const FlowDomain domain =
		flowDomain(onlyComponent(withoutStars(coarse, {5})), Holes::ShortCapped);
	EXPECT_EQ(domain.holes, 0);
	EXPECT_FALSE(domain.capped.has_value());
}

TEST(FlowDomain, OneLoopOrNoneHasNothingToCap)
{
	for (const SurfaceMesh& mesh : {rectangle(3, 3, 1, 1), tetrahedron(), torus(3, 1, 8, 6)}) {
		const Component component = onlyComponent(mesh);
		const FlowDomain domain = flowDomain(component, Holes::Capped);
		expectEmbedded(domain.surface, component.positions, component.triangles);
		EXPECT_FALSE(domain.capped.has_value());
		EXPECT_EQ(&domain.solved(), &domain.surface);
		EXPECT_EQ(domain.holes, 0);
		EXPECT_EQ(domain.onHole, VertexArray<char>(domain.surface.triangulation.vertexCount(), 0));
	}
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
