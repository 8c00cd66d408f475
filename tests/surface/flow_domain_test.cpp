// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/surface/flow_domain.h>

#include <gtest/gtest.h>

#include <algorithm>
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

/// A square of 9 x 9 cells without the stars of some inner vertices.
SurfaceMesh squareWithHoles()
{
	const auto vertex = [](int i, int j) { return i * 10 + j; };
	return withoutStars(rectangle(9, 9, 1.0, 1.0), {vertex(2, 2), vertex(7, 3), vertex(4, 7)});
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

} // namespace
} // namespace ricci::testing
