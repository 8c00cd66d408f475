// SPDX-License-Identifier: GPL-3.0-or-later
// The surfaces that the flow runs on: their topology, and creases.
#include "support/expect.h"
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/graphs.h>
#include <ricci/base/numbers.h>
#include <ricci/mesh/sides.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

namespace ricci::testing {
namespace {

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
		for (const Halfedge h : paths.parents())
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
