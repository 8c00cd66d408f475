// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/planar_edges.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/mesh/normal_coordinates.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace ricci::testing {
namespace {

using Curve = NormalCoordinates::Curve;

struct Surface
{
	const char* name;
	Triangulation triangulation;
	int flips;
};

/// Crossings grow exponentially with flips at random, so the smaller the surface, the fewer.
std::vector<Surface> surfaces()
{
	Random random(300);
	return {
		{"torus", glued(bumpyTorus(9, 7, random)), 250},
		{"disk", glued(randomPlanarDisk(7, random)), 250},
		{"tetrahedron", glued(tetrahedron()), 90},
		{"genus 2", glued(perforatedSlab(2, 1)), 150},
		{"ring", glued(ring(1, 2, 9, 4)), 150},
		{"one vertex", oneVertexTorus(), 45},
		{"two triangles", glued(3, {{0, 1, 2}, {1, 0, 2}}, {3, 5, 4, 0, 2, 1}), 14}};
}

std::vector<Edge> flipAtRandom(NormalCoordinates& coordinates, int count, Random& random)
{
	std::vector<Edge> flipped;
	while (static_cast<int>(flipped.size()) < count) {
		const Edge e(random.index(coordinates.triangulation().edgeCount()));
		if (!coordinates.triangulation().isFlippable(e))
			continue;
		coordinates.flip(e);
		flipped.push_back(e);
	}
	return flipped;
}

/// Its position counted from the origin of the edge.
int fromOrigin(const NormalCoordinates& c, const NormalCoordinates::Crossing& x)
{
	return x.halfedge.isFirst() ? x.position : c.crossings(x.halfedge.edge()) - 1 - x.position;
}

void expectEdgesThemselves(const Triangulation& original, const NormalCoordinates& c)
{
	const auto curves = c.trace();
	for (const Edge e : original.edges()) {
		EXPECT_TRUE(c.isCurve(e));
		EXPECT_EQ(c.crossings(e), 0);
		EXPECT_EQ(curves[e].first, e.halfedge());
		EXPECT_EQ(curves[e].last, e.halfedge().twin());
		EXPECT_TRUE(curves[e].crossings.empty());
		EXPECT_EQ(c.originalAtOrBefore(e.halfedge()), e.halfedge());
	}
	for (const Halfedge h : original.halfedges())
		EXPECT_EQ(c.triangulation().next(h), original.next(h));
}

/// What they are after flips, overlay_pieces_test.cpp and the refinements show of the pieces that they make.
TEST(NormalCoordinates, ComeBackWithTheFlipsUndone)
{
	for (const Surface& surface : surfaces()) {
		SCOPED_TRACE(surface.name);
		const Triangulation& original = surface.triangulation;
		int crossed = 0;
		for (std::uint64_t seed : {1u, 2u, 3u}) {
			Random random(310 + seed);
			NormalCoordinates c(original);
			expectEdgesThemselves(original, c);
			const std::vector<Edge> flipped = flipAtRandom(c, surface.flips, random);
			for (const Edge e : original.edges())
				crossed = std::max(crossed, c.crossings(e));
			for (auto e = flipped.rbegin(); e != flipped.rend(); ++e)
				c.unflip(*e);
			expectEdgesThemselves(original, c);
		}
		// Or the test says little. On a sphere with three vertices arcs hardly cross at all.
		EXPECT_TRUE(crossed > 5 || original.vertexCount() == 3);
	}
}

TEST(NormalCoordinates, AreThoseOfStraightEdgesInThePlane)
{
	for (std::uint64_t seed : {1u, 2u, 3u, 4u}) {
		Random random(330 + seed);
		const SurfaceMesh mesh = randomPlanarDisk(8, random);
		const PlanarEdges plane(mesh);
		const Triangulation original = glued(mesh);
		NormalCoordinates c(original);
		const Triangulation& t = c.triangulation();
		for (int attempt = 0; attempt < 4000; ++attempt) {
			const Edge e(random.index(t.edgeCount()));
			if (plane.isConvexQuad(t, e))
				c.flip(e);
		}
		const auto curves = c.trace();
		// What crosses an edge, in order along it.
		using Hits = std::vector<std::pair<double, Edge>>;
		const auto edgesOf = [](Hits hits) {
			std::sort(hits.begin(), hits.end());
			std::vector<Edge> edges;
			for (const auto& hit : hits)
				edges.push_back(hit.second);
			return edges;
		};
		EdgeArray<Hits> onEdge(t.edgeCount());
		EdgeArray<std::vector<Edge>> curveAt(t.edgeCount());
		for (const Edge x : t.edges())
			curveAt[x].assign(at(c.crossings(x)), Edge());
		std::size_t total = 0;
		for (const Edge e : original.edges()) {
			Hits hits;
			for (const Edge x : t.edges())
				if (plane.cross(original.ends(e), t.ends(x))) {
					hits.push_back({plane.along(original.ends(e), t.ends(x)), x});
					onEdge[x].push_back({plane.along(t.ends(x), original.ends(e)), e});
				}
			std::vector<Edge> crossed;
			for (const auto& x : curves[e].crossings) {
				crossed.push_back(x.halfedge.edge());
				curveAt[x.halfedge.edge()][at(fromOrigin(c, x))] = e;
			}
			EXPECT_EQ(crossed, edgesOf(hits)) << "edge " << e.number();
			total += hits.size();
		}
		EXPECT_GT(total, 200u);
		for (const Edge x : t.edges())
			EXPECT_EQ(curveAt[x], edgesOf(onEdge[x]));
	}
}

} // namespace
} // namespace ricci::testing
