// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/edge_swap/edge_swapper.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ricci::testing {
namespace {

/// A triangle over each side of a broken one: corners 0 1 2, outer vertices 3 4 5.
SurfaceMesh star()
{
	return {
		{{0, 0, 0}, {1, 0, 0}, {0.5, 0.8, 0}, {0.5, -0.8, 0.1}, {1.4, 0.8, 0.2}, {-0.4, 0.8, 0.3}},
		{{0, 1, 2}, {1, 0, 3}, {2, 1, 4}, {0, 2, 5}}};
}

Edge edgeBetween(const Triangulation& t, Vertex a, Vertex b)
{
	for (const Edge e : t.edges())
		if (std::minmax(t.origin(e.halfedge()), t.target(e.halfedge())) == std::minmax(a, b))
			return e;
	return Edge();
}

/// The map of the mesh with the ends of one edge put so far apart that its triangles break.
GeometricCurvatureMap<Euclidean> breaking(const Packed& mesh, Edge e)
{
	CirclePacking packing = mesh.packing;
	packing.delta[e] = 100.0;
	GeometricCurvatureMap<Euclidean> map(packing);
	map.evaluate(mesh.u());
	return map;
}

TEST(EdgeSwap, DoesNothingWhereNothingIsBroken)
{
	const SurfaceMesh mesh = star();
	const Packed packed(mesh);
	auto map = packed.map();
	map.evaluate(packed.u());
	const VertexArray<Point3> positions(mesh.positions);
	EdgeSwapper swapper(positions, packed.radii);
	EXPECT_FALSE(swapper(map));
	EXPECT_EQ(swapper.swaps(), 0);
	EXPECT_TRUE(swapper.boundaryEdgesToSplit().empty());
}

TEST(EdgeSwap, SwapsTheLongestEdgeAndMeasuresTheNewOneInSpace)
{
	const SurfaceMesh mesh = star();
	const Packed packed(mesh);
	const Edge e = edgeBetween(packed.triangulation, Vertex(0), Vertex(1));
	auto map = breaking(packed, e);
	ASSERT_EQ(map.brokenTriangles(), 2); // on both sides of it
	const VertexArray<Point3> positions(mesh.positions);
	EdgeSwapper swapper(positions, packed.radii);
	EXPECT_TRUE(swapper(map));
	EXPECT_EQ(swapper.swaps(), 1);
	const Triangulation& t = map.triangulation();
	EXPECT_EQ(
		std::minmax(t.origin(e.halfedge()), t.target(e.halfedge())),
		std::minmax(Vertex(2), Vertex(3)));
	// Paper 5.4: the inversive distance follows from the distance in space and the initial radii.
	const double l = distance(mesh.positions[2], mesh.positions[3]);
	const double gi = packed.radii[Vertex(2)], gj = packed.radii[Vertex(3)];
	EXPECT_NEAR(1 + map.delta()[e], (l * l - gi * gi - gj * gj) / (2 * gi * gj), 1e-12);
	for (const Edge edge : t.edges())
		EXPECT_EQ(swapper.swapped()[edge], edge == e);
}

TEST(EdgeSwap, AsksForASplitOnTheBoundary)
{
	const SurfaceMesh mesh = star();
	const Packed packed(mesh);
	const Edge e = edgeBetween(packed.triangulation, Vertex(1), Vertex(3));
	auto map = breaking(packed, e);
	ASSERT_EQ(map.brokenTriangles(), 1);
	const VertexArray<Point3> positions(mesh.positions);
	EdgeSwapper swapper(positions, packed.radii);
	swapper(map);
	EXPECT_EQ(swapper.boundaryEdgesToSplit(), std::vector<Edge>{e});
	EXPECT_FALSE(swapper.swapped()[e]);
}

TEST(EdgeSwap, AnEdgeIsNotSwappedForEver)
{
	// Made to break again after each swap, an edge is given up in the end.
	const SurfaceMesh mesh = star();
	const Packed packed(mesh);
	const Edge e = edgeBetween(packed.triangulation, Vertex(0), Vertex(1));
	auto map = breaking(packed, e);
	const VertexArray<Point3> positions(mesh.positions);
	EdgeSwapper swapper(positions, packed.radii);
	int rounds = 0;
	while (rounds < 100 && swapper(map)) {
		++rounds;
		const Triangulation& t = map.triangulation();
		CirclePacking packing{t, map.delta()};
		packing.delta[e] = 1e4;
		map = GeometricCurvatureMap<Euclidean>(packing);
		map.evaluate(packed.u());
	}
	EXPECT_GT(rounds, 0);
	EXPECT_LT(rounds, 50);
}

} // namespace
} // namespace ricci::testing
