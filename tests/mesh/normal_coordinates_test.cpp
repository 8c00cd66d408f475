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

/// Its position counted from the origin of the edge.
int fromOrigin(const NormalCoordinates& c, const NormalCoordinates::Crossing& x)
{
	return x.halfedge.isFirst() ? x.position : c.crossings(x.halfedge.edge()) - 1 - x.position;
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
