// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/math/orientation.h>
#include <ricci/surface/normal_coordinates.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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
	ASSERT_TRUE(curve.first.isValid());
	ASSERT_TRUE(curve.last.isValid());
	const auto [origin, target] = original.ends(edge);
	EXPECT_EQ(t.origin(curve.first), origin);
	EXPECT_EQ(t.origin(curve.last), target);
	if (curve.crossings.empty()) {
		EXPECT_EQ(curve.last, curve.first.twin());
		EXPECT_TRUE(c.isCurve(curve.first.edge()));
		return;
	}
	EXPECT_EQ(curve.crossings.front().halfedge, t.next(curve.first));
	for (std::size_t i = 0; i + 1 < curve.crossings.size(); ++i) {
		const Halfedge entered = curve.crossings[i].halfedge.twin();
		const Halfedge left = curve.crossings[i + 1].halfedge;
		ASSERT_EQ(t.face(entered), t.face(left));
		ASSERT_NE(entered, left);
	}
	const Halfedge entered = curve.crossings.back().halfedge.twin();
	EXPECT_EQ(t.next(curve.last), entered);
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
			const Edge e = x.halfedge.edge();
			const int position = fromOrigin(c, x);
			ASSERT_GE(position, 0);
			ASSERT_LT(position, c.crossings(e));
			++visits[e][at(position)];
		}
	for (const auto& edge : visits)
		for (int n : edge)
			ASSERT_EQ(n, 1);
}

/// A piece of a curve in one triangle, between two places of its border: (side, position), a
/// corner being position -1 of the side that starts there.
using Place = std::pair<int, int>;
using Chord = std::pair<Place, Place>;

/// In no triangle do two curves cross.
void expectDisjoint(const NormalCoordinates& c, const EdgeArray<Curve>& curves)
{
	const Triangulation& t = c.triangulation();
	FaceArray<std::vector<Chord>> chords(t.faceCount());
	const auto place = [&](Halfedge h, int position) {
		const auto sides = t.halfedges(t.face(h));
		return Place{
			static_cast<int>(std::find(sides.begin(), sides.end(), h) - sides.begin()), position};
	};
	for (const Curve& curve : curves) {
		if (curve.crossings.empty())
			continue;
		Halfedge from = curve.first;
		int position = -1;
		for (const auto& x : curve.crossings) {
			Chord chord{place(from, position), place(x.halfedge, x.position)};
			chords[t.face(from)].push_back(std::minmax(chord.first, chord.second));
			from = x.halfedge.twin();
			position = c.crossings(from.edge()) - 1 - x.position;
		}
		const Chord chord{place(from, position), place(curve.last, -1)};
		chords[t.face(from)].push_back(std::minmax(chord.first, chord.second));
	}
	for (const auto& face : chords)
		for (std::size_t i = 0; i < face.size() && i < 60; ++i)
			for (std::size_t j = 0; j < face.size(); ++j)
				ASSERT_FALSE(
					face[i].first < face[j].first && face[j].first < face[i].second &&
					face[i].second < face[j].second);
}

/// Turns counter-clockwise about the origin of h; none behind the last triangle of a boundary vertex.
Halfedge turned(const Triangulation& t, Halfedge h)
{
	return t.isExterior(h) ? Halfedge() : t.previous(h).twin();
}

/// Halfedges that leave each vertex, counter-clockwise; open at the boundary.
std::vector<Halfedge> star(const Triangulation& t, Halfedge first)
{
	Halfedge start = first;
	while (!t.isExterior(start.twin())) {
		start = t.next(start.twin());
		if (start == first)
			break;
	}
	std::vector<Halfedge> halfedges;
	for (Halfedge h = start; h.isValid(); h = turned(t, h)) {
		if (!halfedges.empty() && h == start)
			break;
		halfedges.push_back(h);
	}
	return halfedges;
}

/// The curves leave every vertex in the order of the original edges.
void expectRoundabouts(
	const Triangulation& original, const NormalCoordinates& c, const EdgeArray<Curve>& curves)
{
	const Triangulation& t = c.triangulation();
	struct Leaving
	{
		int position; // among the curves of the corner; -1 along its halfedge
		Halfedge original;
	};
	HalfedgeArray<std::vector<Leaving>> leaving(t.halfedgeCount());
	for (const Edge e : curves.indices()) {
		const Curve& curve = curves[e];
		const Halfedge h = e.halfedge();
		if (curve.crossings.empty()) {
			leaving[curve.first].push_back({-1, h});
			leaving[curve.last].push_back({-1, h.twin()});
			continue;
		}
		const auto &x = curve.crossings.front(), &y = curve.crossings.back();
		leaving[curve.first].push_back({x.position, h});
		leaving[curve.last].push_back({c.crossings(y.halfedge.edge()) - 1 - y.position, h.twin()});
	}
	VertexArray<char> seen(t.vertexCount(), 0);
	for (const Halfedge h : t.halfedges()) {
		const Vertex v = t.origin(h);
		if (seen[v])
			continue;
		seen[v] = 1;
		std::vector<Halfedge> order;
		for (const Halfedge spoke : star(t, h)) {
			auto& curvesHere = leaving[spoke];
			std::sort(curvesHere.begin(), curvesHere.end(), [](const Leaving& a, const Leaving& b) {
				return a.position < b.position;
			});
			const Halfedge before = c.originalAtOrBefore(spoke);
			if (!curvesHere.empty() && curvesHere.front().position < 0) {
				EXPECT_EQ(before, curvesHere.front().original);
			}
			else if (!order.empty()) {
				EXPECT_EQ(before, order.back());
			}
			for (const Leaving& l : curvesHere)
				order.push_back(l.original);
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
	expectDisjoint(c, curves);
	expectRoundabouts(original, c, curves);
}

TEST(NormalCoordinates, EveryEdgeIsACurveAtFirst)
{
	for (const Surface& s : surfaces()) {
		SCOPED_TRACE(s.name);
		const NormalCoordinates c(s.triangulation);
		const auto curves = c.trace();
		for (const Edge e : s.triangulation.edges()) {
			EXPECT_TRUE(c.isCurve(e));
			EXPECT_EQ(c.crossings(e), 0);
			EXPECT_EQ(curves[e].first, e.halfedge());
			EXPECT_EQ(curves[e].last, e.halfedge().twin());
			EXPECT_TRUE(curves[e].crossings.empty());
			EXPECT_EQ(c.originalAtOrBefore(e.halfedge()), e.halfedge());
		}
	}
}

TEST(NormalCoordinates, TracesAreWholeAfterRandomFlips)
{
	std::vector<int> crossed(surfaces().size(), 0);
	for (std::uint64_t seed : {1u, 2u, 3u})
		for (std::size_t i = 0; i < crossed.size(); ++i) {
			const Surface s = surfaces()[i];
			SCOPED_TRACE(std::string(s.name) + ", seed " + std::to_string(seed));
			Random random(310 + seed);
			NormalCoordinates c(s.triangulation);
			for (int part = 0; part < 3; ++part) {
				flipAtRandom(c, s.flips / 3, random);
				expectConsistent(s.triangulation, c);
			}
			for (const Edge e : s.triangulation.edges())
				crossed[i] = std::max(crossed[i], c.crossings(e));
		}
	// Or the test says little. On a sphere with three vertices arcs hardly cross at all.
	for (std::size_t i = 0; i + 1 < crossed.size(); ++i)
		EXPECT_GT(crossed[i], 5) << surfaces()[i].name;
}

TEST(NormalCoordinates, FlipsUndoneLeaveTheEdges)
{
	for (const Surface& s : surfaces()) {
		SCOPED_TRACE(s.name);
		Random random(320);
		NormalCoordinates c(s.triangulation);
		const std::vector<Edge> flipped = flipAtRandom(c, s.flips, random);
		for (auto e = flipped.rbegin(); e != flipped.rend(); ++e)
			c.unflip(*e);
		const auto curves = c.trace();
		for (const Edge e : s.triangulation.edges()) {
			EXPECT_TRUE(c.isCurve(e));
			EXPECT_EQ(curves[e].first, e.halfedge());
			EXPECT_EQ(curves[e].last, e.halfedge().twin());
		}
		for (const Halfedge h : s.triangulation.halfedges())
			EXPECT_EQ(c.triangulation().next(h), s.triangulation.next(h));
	}
}

TEST(NormalCoordinates, TwoFlipsTurnAnEdgeRound)
{
	for (const Surface& s : surfaces()) {
		SCOPED_TRACE(s.name);
		int flipped = 0;
		for (const Edge e : s.triangulation.edges()) {
			NormalCoordinates c(s.triangulation);
			if (!s.triangulation.isFlippable(e))
				continue;
			++flipped;
			c.flip(e);
			EXPECT_FALSE(c.isCurve(e));
			EXPECT_EQ(c.crossings(e), 1);
			expectConsistent(s.triangulation, c);
			c.flip(e);
			EXPECT_TRUE(c.isCurve(e));
			EXPECT_EQ(c.trace()[e].first, e.halfedge().twin());
		}
		// All edges inside: 3 F = 2 E - (boundary edges).
		EXPECT_EQ(flipped, 3 * s.triangulation.faceCount() - s.triangulation.edgeCount());
	}
}

class PlanarEdges
{
public:
	explicit PlanarEdges(const SurfaceMesh& mesh)
	{
		for (const Point3& p : mesh.positions)
			m_points.push_back({p[0], p[1]});
	}

	bool isConvexQuad(const Triangulation& t, Edge e) const
	{
		if (!t.isFlippable(e))
			return false;
		const auto [i, j] = t.ends(e);
		const Vertex k = t.apex(e.halfedge()), l = t.apex(e.halfedge().twin());
		return side(l, k, i) > 0 && side(l, k, j) < 0;
	}

	bool cross(Vertex a, Vertex b, Vertex p, Vertex q) const
	{
		return side(a, b, p) * side(a, b, q) < 0 && side(p, q, a) * side(p, q, b) < 0;
	}

	/// Where pq crosses ab, from a (0) to b (1).
	double along(Vertex a, Vertex b, Vertex p, Vertex q) const
	{
		const auto area = [&](Vertex x) {
			return (m_points[q][0] - m_points[p][0]) * (m_points[x][1] - m_points[p][1]) -
				   (m_points[q][1] - m_points[p][1]) * (m_points[x][0] - m_points[p][0]);
		};
		return area(a) / (area(a) - area(b));
	}

private:
	int side(Vertex a, Vertex b, Vertex c) const
	{
		return orientation(m_points[a], m_points[b], m_points[c]);
	}

	VertexArray<Point2> m_points;
};

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
		struct Hit
		{
			double along;
			Edge edge;
		};
		EdgeArray<std::vector<Hit>> onEdge(t.edgeCount()); // edge: of the original
		int total = 0;
		for (const Edge e : original.edges()) {
			const auto [a, b] = original.ends(e);
			std::vector<Hit> expected;
			for (const Edge x : t.edges()) {
				const auto [p, q] = t.ends(x);
				if (!plane.cross(a, b, p, q))
					continue;
				expected.push_back({plane.along(a, b, p, q), x});
				onEdge[x].push_back({plane.along(p, q, a, b), e});
			}
			std::sort(expected.begin(), expected.end(), [](const Hit& m, const Hit& n) {
				return m.along < n.along;
			});
			const Curve& curve = curves[e];
			ASSERT_EQ(curve.crossings.size(), expected.size()) << "edge " << e.number();
			for (std::size_t i = 0; i < expected.size(); ++i)
				EXPECT_EQ(curve.crossings[i].halfedge.edge(), expected[i].edge);
			total += static_cast<int>(expected.size());
		}
		EXPECT_GT(total, 200);
		EdgeArray<std::vector<Edge>> curveAt(t.edgeCount());
		for (const Edge x : t.edges())
			curveAt[x].assign(at(c.crossings(x)), Edge());
		for (const Edge e : curves.indices())
			for (const auto& x : curves[e].crossings)
				curveAt[x.halfedge.edge()][at(fromOrigin(c, x))] = e;
		for (const Edge x : t.edges()) {
			std::sort(onEdge[x].begin(), onEdge[x].end(), [](const Hit& m, const Hit& n) {
				return m.along < n.along;
			});
			ASSERT_EQ(static_cast<int>(onEdge[x].size()), c.crossings(x));
			for (std::size_t i = 0; i < onEdge[x].size(); ++i)
				EXPECT_EQ(curveAt[x][i], onEdge[x][i].edge);
		}
	}
}

/// Coordinates of some of the edges are those of all with the other curves left out.
TEST(NormalCoordinates, OfSomeEdgesAreThoseOfAllWithoutTheOthers)
{
	Random choice(340);
	int total = 0;
	for (const Surface& s : surfaces())
		for (const double share : {0.1, 0.6}) {
			SCOPED_TRACE(s.name);
			EdgeArray<char> isCurve(s.triangulation.edgeCount(), 0);
			for (const Edge e : s.triangulation.edges())
				isCurve[e] = s.triangulation.isBoundary(e) || choice.real(0.0, 1.0) < share;
			NormalCoordinates all(s.triangulation), some(s.triangulation, isCurve);
			Random random(341);
			for (const Edge e : flipAtRandom(all, s.flips, random))
				some.flip(e);
			const Triangulation& t = all.triangulation();
			const auto curves = all.trace(), chosen = some.trace();
			EdgeArray<int> crossings(t.edgeCount(), 0);
			EdgeArray<char> isEdge(t.edgeCount(), 0);
			for (const Edge e : curves.indices()) {
				if (!isCurve[e])
					continue;
				const Curve &a = curves[e], &b = chosen[e];
				EXPECT_EQ(a.first, b.first);
				EXPECT_EQ(a.last, b.last);
				ASSERT_EQ(a.crossings.size(), b.crossings.size());
				for (std::size_t i = 0; i < a.crossings.size(); ++i) {
					EXPECT_EQ(a.crossings[i].halfedge, b.crossings[i].halfedge);
					++crossings[a.crossings[i].halfedge.edge()];
					++total;
				}
				if (a.crossings.empty())
					isEdge[a.first.edge()] = 1;
			}
			for (const Edge e : t.edges()) {
				EXPECT_EQ(some.crossings(e), crossings[e]);
				EXPECT_EQ(some.isCurve(e), isEdge[e] != 0);
			}
			for (const Halfedge h : t.halfedges()) {
				if (!some.hasCurves(t.origin(h)))
					continue;
				Halfedge expected = all.originalAtOrBefore(h);
				while (!isCurve[expected.edge()])
					expected = s.triangulation.next(expected.twin()); // clockwise
				EXPECT_EQ(some.originalAtOrBefore(h), expected);
			}
		}
	EXPECT_GT(total, 1000);
}

TEST(Unfold, AStripOfThePlaneIsItself)
{
	// From every corner of a plane mesh straight on over two edges, to the left and to the right.
	Random random(630);
	const SurfaceMesh mesh = randomPlanarDisk(5, random);
	const Triangulation t = glued(mesh);
	const EdgeArray<double> lengths = edgeLengths(t, mesh);
	int strips = 0;
	for (const Halfedge h : t.halfedges())
		for (bool left : {true, false}) {
			if (t.isExterior(h) || t.isExterior(t.next(h).twin()))
				continue;
			NormalCoordinates::Curve curve;
			curve.first = h;
			curve.crossings.resize(2);
			curve.crossings[0].halfedge = t.next(h);
			const Halfedge y = t.next(h).twin();
			const Halfedge second = left ? t.previous(y) : t.next(y);
			if (t.isExterior(second.twin()))
				continue;
			curve.crossings[1].halfedge = second;
			Strip strip;
			unfold(t, lengths, curve, strip);
			// The plane seen from the curve's beginning, along its first halfedge.
			const Point3& o = mesh.positions[at(t.origin(h))];
			const Point3& e = mesh.positions[at(t.target(h))];
			const double c = (e[0] - o[0]) / distance(o, e), s = (e[1] - o[1]) / distance(o, e);
			const auto expectAt = [&](const Point2& p, Vertex v) {
				const Point3& q = mesh.positions[at(v)];
				const double x = q[0] - o[0], z = q[1] - o[1];
				EXPECT_NEAR(p[0], c * x + s * z, 1e-12);
				EXPECT_NEAR(p[1], c * z - s * x, 1e-12);
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
