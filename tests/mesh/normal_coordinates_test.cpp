// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/points.h>
#include <ricci/mesh/normal_coordinates.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>

namespace ricci::testing {
namespace {

/// Straight edges between the vertices of a mesh over the plane.
class PlanarEdges
{
public:
	using Ends = std::array<Vertex, 2>;

	explicit PlanarEdges(const SurfaceMesh& mesh)
	{
		for (const Point3& p : mesh.positions)
			m_points.push_back({p[0], p[1]});
	}

	/// Which side of the line from a to b v lies on: 1 on its left.
	int side(Vertex a, Vertex b, Vertex v) const
	{
		return orientation(m_points[a], m_points[b], m_points[v]);
	}

	/// Whether a flip of e keeps the triangulation in the plane.
	bool isConvexQuad(const Triangulation& t, Edge e) const
	{
		if (!t.isFlippable(e))
			return false;
		const auto [i, j] = t.ends(e);
		const Vertex k = t.apex(e.halfedge()), l = t.apex(e.halfedge().twin());
		return side(l, k, i) > 0 && side(l, k, j) < 0;
	}

	bool cross(const Ends& a, const Ends& b) const
	{
		return side(a[0], a[1], b[0]) * side(a[0], a[1], b[1]) < 0 &&
			   side(b[0], b[1], a[0]) * side(b[0], b[1], a[1]) < 0;
	}

	/// Where b crosses a, from the beginning of a (0) to its end (1).
	double along(const Ends& a, const Ends& b) const
	{
		const auto area = [&](Vertex x) {
			return doubledArea(m_points[b[0]], m_points[b[1]], m_points[x]);
		};
		return area(a[0]) / (area(a[0]) - area(a[1]));
	}

private:
	VertexArray<Point2> m_points;
};

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
