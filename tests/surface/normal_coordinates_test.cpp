// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/planar_edges.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/surface/normal_coordinates.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
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

/// The way from its beginning to its end, triangle by triangle.
void expectConnected(
	const NormalCoordinates& c, const Curve& curve, const Triangulation& original, Edge edge)
{
	SCOPED_TRACE("original edge " + std::to_string(edge.number()));
	const Triangulation& t = c.triangulation();
	ASSERT_TRUE(curve.first.isValid() && curve.last.isValid());
	EXPECT_EQ(t.origin(curve.first), original.ends(edge)[0]);
	EXPECT_EQ(t.origin(curve.last), original.ends(edge)[1]);
	if (curve.crossings.empty()) {
		EXPECT_EQ(curve.last, curve.first.twin());
		EXPECT_TRUE(c.isCurve(curve.first.edge()));
		return;
	}
	EXPECT_EQ(curve.crossings.front().halfedge, t.next(curve.first));
	for (std::size_t i = 0; i + 1 < curve.crossings.size(); ++i) {
		const Halfedge entered = curve.crossings[i].halfedge.twin();
		ASSERT_EQ(t.face(entered), t.face(curve.crossings[i + 1].halfedge));
		ASSERT_NE(entered, curve.crossings[i + 1].halfedge);
	}
	EXPECT_EQ(t.next(curve.last), curve.crossings.back().halfedge.twin());
}

/// Every place at which an edge counts a crossing belongs to exactly one crossing of one curve.
void expectCrossingsCounted(const NormalCoordinates& c, const EdgeArray<Curve>& curves)
{
	const Triangulation& t = c.triangulation();
	EdgeArray<std::vector<int>> visits(t.edgeCount());
	for (const Edge e : t.edges())
		visits[e].assign(at(c.crossings(e)), 0);
	for (const Curve& curve : curves)
		for (const auto& x : curve.crossings) {
			const int position = fromOrigin(c, x);
			ASSERT_GE(position, 0);
			ASSERT_LT(position, c.crossings(x.halfedge.edge()));
			++visits[x.halfedge.edge()][at(position)];
		}
	for (const auto& edge : visits)
		EXPECT_EQ(edge, std::vector<int>(edge.size(), 1));
}

/// Halfedges that leave the origin of \p first, counter-clockwise; open at the boundary.
std::vector<Halfedge> star(const Triangulation& t, Halfedge first)
{
	std::vector<Halfedge> halfedges;
	for (const Halfedge h : t.around(t.origin(first)))
		halfedges.push_back(h);
	if (t.isExterior(halfedges.front().twin())) // the exterior one lies behind the first
		std::rotate(halfedges.begin(), halfedges.begin() + 1, halfedges.end());
	std::reverse(halfedges.begin(), halfedges.end());
	return halfedges;
}

/// The curves leave every vertex in the order of the original edges.
void expectRoundabouts(
	const Triangulation& original, const NormalCoordinates& c, const EdgeArray<Curve>& curves)
{
	const Triangulation& t = c.triangulation();
	/// By the position among the curves of the corner, -1 along its halfedge.
	HalfedgeArray<std::vector<std::pair<int, Halfedge>>> leaving(t.halfedgeCount());
	for (const Edge e : curves.indices()) {
		const Curve& curve = curves[e];
		const Halfedge h = e.halfedge();
		const bool isEdge = curve.crossings.empty();
		leaving[curve.first].push_back({isEdge ? -1 : curve.crossings.front().position, h});
		const int back = isEdge ? -1
								: c.crossings(curve.crossings.back().halfedge.edge()) - 1 -
									  curve.crossings.back().position;
		leaving[curve.last].push_back({back, h.twin()});
	}
	for (const Vertex v : t.vertices()) {
		std::vector<Halfedge> order;
		for (const Halfedge spoke : star(t, t.halfedge(v))) {
			auto& curvesHere = leaving[spoke];
			std::sort(curvesHere.begin(), curvesHere.end());
			const Halfedge before = c.originalAtOrBefore(spoke);
			if (!curvesHere.empty() && curvesHere.front().first < 0) {
				EXPECT_EQ(before, curvesHere.front().second);
			}
			else if (!order.empty()) {
				EXPECT_EQ(before, order.back());
			}
			for (const auto& [position, originalHalfedge] : curvesHere)
				order.push_back(originalHalfedge);
		}
		ASSERT_FALSE(order.empty());
		std::vector<Halfedge> expected = star(original, order.front());
		const auto first = std::find(expected.begin(), expected.end(), order.front());
		std::rotate(expected.begin(), first, expected.end());
		EXPECT_EQ(order, expected) << "vertex " << v.number();
	}
}

void expectConsistent(const Triangulation& original, const NormalCoordinates& c)
{
	const auto curves = c.trace();
	ASSERT_EQ(curves.size(), original.edgeCount());
	for (const Edge e : original.edges())
		expectConnected(c, curves[e], original, e);
	expectCrossingsCounted(c, curves);
	expectRoundabouts(original, c, curves);
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

TEST(NormalCoordinates, TracesAreWholeAfterRandomFlipsAndComeBack)
{
	const std::vector<Surface> all = surfaces();
	std::vector<int> crossed(all.size(), 0);
	for (std::uint64_t seed : {1u, 2u, 3u})
		for (std::size_t i = 0; i < all.size(); ++i) {
			const Triangulation& original = all[i].triangulation;
			SCOPED_TRACE(std::string(all[i].name) + ", seed " + std::to_string(seed));
			Random random(310 + seed);
			NormalCoordinates c(original);
			expectEdgesThemselves(original, c);
			std::vector<Edge> flipped;
			for (int part = 0; part < 3; ++part) {
				for (const Edge e : flipAtRandom(c, all[i].flips / 3, random))
					flipped.push_back(e);
				expectConsistent(original, c);
			}
			for (const Edge e : original.edges())
				crossed[i] = std::max(crossed[i], c.crossings(e));
			for (auto e = flipped.rbegin(); e != flipped.rend(); ++e)
				c.unflip(*e);
			expectEdgesThemselves(original, c);
		}
	// Or the test says little. On a sphere with three vertices arcs hardly cross at all.
	for (std::size_t i = 0; i + 1 < crossed.size(); ++i)
		EXPECT_GT(crossed[i], 5) << all[i].name;
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

/// From every corner of a plane mesh straight on over two edges, to the left and to the right.
TEST(Unfold, AStripOfThePlaneIsItself)
{
	Random random(630);
	const SurfaceMesh mesh = randomPlanarDisk(5, random);
	const Triangulation t = glued(mesh);
	const EdgeArray<double> lengths = edgeLengths(t, mesh);
	int strips = 0;
	for (const Halfedge h : t.interiorHalfedges())
		for (bool left : {true, false}) {
			const Halfedge y = t.next(h).twin();
			if (t.isExterior(y))
				continue;
			const Halfedge second = left ? t.previous(y) : t.next(y);
			if (t.isExterior(second.twin()))
				continue;
			Curve curve;
			curve.first = h;
			curve.crossings = {{t.next(h), 0}, {second, 0}};
			Strip strip;
			unfold(t, lengths, curve, strip);
			// The plane seen from the curve's beginning, along its first halfedge.
			const Point3& o = mesh.positions[at(t.origin(h))];
			const Point3& e = mesh.positions[at(t.target(h))];
			const double c = (e[0] - o[0]) / distance(o, e), s = (e[1] - o[1]) / distance(o, e);
			const auto expectAt = [&](const Point2& p, Vertex v) {
				const Point3 q = mesh.positions[at(v)] - o;
				EXPECT_NEAR(p[0], c * q[0] + s * q[1], 1e-12);
				EXPECT_NEAR(p[1], c * q[1] - s * q[0], 1e-12);
			};
			ASSERT_EQ(strip.sides.size(), 2u);
			for (std::size_t i = 0; i < 2; ++i) {
				expectAt(strip.sides[i].from, t.origin(curve.crossings[i].halfedge));
				expectAt(strip.sides[i].to, t.target(curve.crossings[i].halfedge));
			}
			expectAt(strip.end, t.apex(second.twin()));
			++strips;
		}
	EXPECT_GT(strips, 20);
}

} // namespace
} // namespace ricci::testing
