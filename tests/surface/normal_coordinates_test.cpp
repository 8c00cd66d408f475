// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/layout/orientation.h>
#include <ricci/surface/normal_coordinates.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
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
		{"two triangles", Triangulation(3, {{0, 1, 2}, {1, 0, 2}}, {3, 5, 4, 0, 2, 1}), 14}};
}

std::vector<int> flipAtRandom(NormalCoordinates& coordinates, int count, Random& random)
{
	std::vector<int> flipped;
	while (static_cast<int>(flipped.size()) < count) {
		const int e = random.index(coordinates.triangulation().edgeCount());
		if (!coordinates.triangulation().isFlippable(e))
			continue;
		coordinates.flip(e);
		flipped.push_back(e);
	}
	return flipped;
}

int fromEven(const NormalCoordinates& c, const NormalCoordinates::Crossing& x)
{
	return x.halfedge % 2 == 0 ? x.position
							   : c.crossings(Triangulation::edge(x.halfedge)) - 1 - x.position;
}

/// The way from its beginning to its end, triangle by triangle.
void expectConnected(
	const NormalCoordinates& c, const Curve& curve, int origin, int target, int edge)
{
	SCOPED_TRACE("original edge " + std::to_string(edge));
	const Triangulation& t = c.triangulation();
	ASSERT_GE(curve.first, 0);
	ASSERT_GE(curve.last, 0);
	EXPECT_EQ(t.origin(curve.first), origin);
	EXPECT_EQ(t.origin(curve.last), target);
	if (curve.crossings.empty()) {
		EXPECT_EQ(curve.last, Triangulation::twin(curve.first));
		EXPECT_TRUE(c.isCurve(Triangulation::edge(curve.first)));
		return;
	}
	EXPECT_EQ(curve.crossings.front().halfedge, t.next(curve.first));
	for (std::size_t i = 0; i + 1 < curve.crossings.size(); ++i) {
		const int entered = Triangulation::twin(curve.crossings[i].halfedge);
		const int left = curve.crossings[i + 1].halfedge;
		ASSERT_EQ(t.face(entered), t.face(left));
		ASSERT_NE(entered, left);
	}
	const int entered = Triangulation::twin(curve.crossings.back().halfedge);
	EXPECT_EQ(t.next(curve.last), entered);
}

/// Every place at which an edge counts a crossing belongs to exactly one crossing of one curve.
void expectCrossingsCounted(const NormalCoordinates& c, const std::vector<Curve>& curves)
{
	const Triangulation& t = c.triangulation();
	std::vector<std::vector<int>> visits;
	for (int e = 0; e < t.edgeCount(); ++e)
		visits.emplace_back(at(c.crossings(e)), 0);
	for (const Curve& curve : curves)
		for (const auto& x : curve.crossings) {
			const int e = Triangulation::edge(x.halfedge), position = fromEven(c, x);
			ASSERT_GE(position, 0);
			ASSERT_LT(position, c.crossings(e));
			++visits[at(e)][at(position)];
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
void expectDisjoint(const NormalCoordinates& c, const std::vector<Curve>& curves)
{
	const Triangulation& t = c.triangulation();
	std::vector<std::vector<Chord>> chords(at(t.faceCount()));
	const auto place = [&](int h, int position) {
		const auto sides = t.halfedges(t.face(h));
		return Place{
			static_cast<int>(std::find(sides.begin(), sides.end(), h) - sides.begin()), position};
	};
	for (const Curve& curve : curves) {
		if (curve.crossings.empty())
			continue;
		int from = curve.first, position = -1;
		for (const auto& x : curve.crossings) {
			Chord chord{place(from, position), place(x.halfedge, x.position)};
			chords[at(t.face(from))].push_back(std::minmax(chord.first, chord.second));
			from = Triangulation::twin(x.halfedge);
			position = c.crossings(Triangulation::edge(from)) - 1 - x.position;
		}
		const Chord chord{place(from, position), place(curve.last, -1)};
		chords[at(t.face(from))].push_back(std::minmax(chord.first, chord.second));
	}
	for (const auto& face : chords)
		for (std::size_t i = 0; i < face.size() && i < 60; ++i)
			for (std::size_t j = 0; j < face.size(); ++j)
				ASSERT_FALSE(
					face[i].first < face[j].first && face[j].first < face[i].second &&
					face[i].second < face[j].second);
}

/// Turns counter-clockwise about the origin of h; -1 behind the last triangle of a boundary vertex.
int turned(const Triangulation& t, int h)
{
	return t.isOuter(h) ? -1 : Triangulation::twin(t.previous(h));
}

/// Halfedges that leave each vertex, counter-clockwise; open at the boundary.
std::vector<int> star(const Triangulation& t, int first)
{
	int start = first;
	while (!t.isOuter(Triangulation::twin(start))) {
		start = t.next(Triangulation::twin(start));
		if (start == first)
			break;
	}
	std::vector<int> halfedges;
	for (int h = start; h >= 0; h = turned(t, h)) {
		if (!halfedges.empty() && h == start)
			break;
		halfedges.push_back(h);
	}
	return halfedges;
}

/// The curves leave every vertex in the order of the original edges.
void expectRoundabouts(
	const Triangulation& original, const NormalCoordinates& c, const std::vector<Curve>& curves)
{
	const Triangulation& t = c.triangulation();
	struct Leaving
	{
		int position; // among the curves of the corner; -1 along its halfedge
		int original; // halfedge
	};
	std::vector<std::vector<Leaving>> leaving(at(t.halfedgeCount()));
	for (std::size_t e = 0; e < curves.size(); ++e) {
		const Curve& curve = curves[e];
		const int h = 2 * static_cast<int>(e);
		if (curve.crossings.empty()) {
			leaving[at(curve.first)].push_back({-1, h});
			leaving[at(curve.last)].push_back({-1, h + 1});
			continue;
		}
		const auto &x = curve.crossings.front(), &y = curve.crossings.back();
		leaving[at(curve.first)].push_back({x.position, h});
		leaving[at(curve.last)].push_back(
			{c.crossings(Triangulation::edge(y.halfedge)) - 1 - y.position, h + 1});
	}
	std::vector<char> seen(at(t.vertexCount()), 0);
	for (int h = 0; h < t.halfedgeCount(); ++h) {
		const int v = t.origin(h);
		if (seen[at(v)])
			continue;
		seen[at(v)] = 1;
		std::vector<int> order;
		for (int spoke : star(t, h)) {
			auto& curvesHere = leaving[at(spoke)];
			std::sort(curvesHere.begin(), curvesHere.end(), [](const Leaving& a, const Leaving& b) {
				return a.position < b.position;
			});
			const int before = c.originalAtOrBefore(spoke);
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
		std::vector<int> expected = star(original, order.front());
		const auto first = std::find(expected.begin(), expected.end(), order.front());
		std::rotate(expected.begin(), first, expected.end());
		EXPECT_EQ(order, expected) << "vertex " << v;
	}
}

void expectConsistent(const Triangulation& original, const NormalCoordinates& c)
{
	const auto curves = c.trace();
	ASSERT_EQ(static_cast<int>(curves.size()), original.edgeCount());
	for (int e = 0; e < original.edgeCount(); ++e)
		expectConnected(c, curves[at(e)], original.origin(2 * e), original.target(2 * e), e);
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
		for (int e = 0; e < s.triangulation.edgeCount(); ++e) {
			EXPECT_TRUE(c.isCurve(e));
			EXPECT_EQ(c.crossings(e), 0);
			EXPECT_EQ(curves[at(e)].first, 2 * e);
			EXPECT_EQ(curves[at(e)].last, 2 * e + 1);
			EXPECT_TRUE(curves[at(e)].crossings.empty());
			EXPECT_EQ(c.originalAtOrBefore(2 * e), 2 * e);
		}
	}
}

TEST(NormalCoordinates, TracesAreWholeAfterRandomFlips)
{
	std::vector<int> crossed(surfaces().size(), 0);
	for (std::uint64_t seed : {1, 2, 3})
		for (std::size_t i = 0; i < crossed.size(); ++i) {
			const Surface s = surfaces()[i];
			SCOPED_TRACE(std::string(s.name) + ", seed " + std::to_string(seed));
			Random random(310 + seed);
			NormalCoordinates c(s.triangulation);
			for (int part = 0; part < 3; ++part) {
				flipAtRandom(c, s.flips / 3, random);
				expectConsistent(s.triangulation, c);
			}
			for (int e = 0; e < s.triangulation.edgeCount(); ++e)
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
		const std::vector<int> flipped = flipAtRandom(c, s.flips, random);
		for (auto e = flipped.rbegin(); e != flipped.rend(); ++e)
			c.unflip(*e);
		const auto curves = c.trace();
		for (int e = 0; e < s.triangulation.edgeCount(); ++e) {
			EXPECT_TRUE(c.isCurve(e));
			EXPECT_EQ(curves[at(e)].first, 2 * e);
			EXPECT_EQ(curves[at(e)].last, 2 * e + 1);
		}
		for (int h = 0; h < s.triangulation.halfedgeCount(); ++h)
			EXPECT_EQ(c.triangulation().next(h), s.triangulation.next(h));
	}
}

TEST(NormalCoordinates, TwoFlipsTurnAnEdgeRound)
{
	for (const Surface& s : surfaces()) {
		SCOPED_TRACE(s.name);
		for (int e = 0; e < s.triangulation.edgeCount(); ++e) {
			NormalCoordinates c(s.triangulation);
			if (!s.triangulation.isFlippable(e))
				continue;
			c.flip(e);
			EXPECT_FALSE(c.isCurve(e));
			EXPECT_EQ(c.crossings(e), 1);
			expectConsistent(s.triangulation, c);
			c.flip(e);
			EXPECT_TRUE(c.isCurve(e));
			EXPECT_EQ(c.trace()[at(e)].first, 2 * e + 1);
		}
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

	bool isConvexQuad(const Triangulation& t, int e) const
	{
		if (!t.isFlippable(e))
			return false;
		const int i = t.origin(2 * e), j = t.target(2 * e);
		const int k = t.origin(t.previous(2 * e)), l = t.origin(t.previous(2 * e + 1));
		return side(l, k, i) > 0 && side(l, k, j) < 0;
	}

	bool cross(int a, int b, int p, int q) const
	{
		return side(a, b, p) * side(a, b, q) < 0 && side(p, q, a) * side(p, q, b) < 0;
	}

	/// Where pq crosses ab, from a (0) to b (1).
	double along(int a, int b, int p, int q) const
	{
		const auto area = [&](int x) {
			return (m_points[at(q)][0] - m_points[at(p)][0]) *
					   (m_points[at(x)][1] - m_points[at(p)][1]) -
				   (m_points[at(q)][1] - m_points[at(p)][1]) *
					   (m_points[at(x)][0] - m_points[at(p)][0]);
		};
		return area(a) / (area(a) - area(b));
	}

private:
	int side(int a, int b, int c) const
	{
		return orientation(m_points[at(a)], m_points[at(b)], m_points[at(c)]);
	}

	std::vector<Point2> m_points;
};

TEST(NormalCoordinates, AreThoseOfStraightEdgesInThePlane)
{
	for (std::uint64_t seed : {1, 2, 3, 4}) {
		Random random(330 + seed);
		const SurfaceMesh mesh = randomPlanarDisk(8, random);
		const PlanarEdges plane(mesh);
		const Triangulation original = glued(mesh);
		NormalCoordinates c(original);
		const Triangulation& t = c.triangulation();
		for (int attempt = 0; attempt < 4000; ++attempt) {
			const int e = random.index(t.edgeCount());
			if (plane.isConvexQuad(t, e))
				c.flip(e);
		}
		const auto curves = c.trace();
		struct Hit
		{
			double along;
			int edge;
		};
		std::vector<std::vector<Hit>> onEdge(at(t.edgeCount())); // edge: of the original
		int total = 0;
		for (int e = 0; e < original.edgeCount(); ++e) {
			const int a = original.origin(2 * e), b = original.target(2 * e);
			std::vector<Hit> expected;
			for (int x = 0; x < t.edgeCount(); ++x) {
				const int p = t.origin(2 * x), q = t.target(2 * x);
				if (!plane.cross(a, b, p, q))
					continue;
				expected.push_back({plane.along(a, b, p, q), x});
				onEdge[at(x)].push_back({plane.along(p, q, a, b), e});
			}
			std::sort(expected.begin(), expected.end(), [](const Hit& m, const Hit& n) {
				return m.along < n.along;
			});
			const Curve& curve = curves[at(e)];
			ASSERT_EQ(curve.crossings.size(), expected.size()) << "edge " << e;
			for (std::size_t i = 0; i < expected.size(); ++i)
				EXPECT_EQ(Triangulation::edge(curve.crossings[i].halfedge), expected[i].edge);
			total += static_cast<int>(expected.size());
		}
		EXPECT_GT(total, 200);
		std::vector<std::vector<int>> curveAt(at(t.edgeCount()));
		for (int x = 0; x < t.edgeCount(); ++x)
			curveAt[at(x)].assign(at(c.crossings(x)), -1);
		for (std::size_t e = 0; e < curves.size(); ++e)
			for (const auto& x : curves[e].crossings)
				curveAt[at(Triangulation::edge(x.halfedge))][at(fromEven(c, x))] =
					static_cast<int>(e);
		for (int x = 0; x < t.edgeCount(); ++x) {
			std::sort(onEdge[at(x)].begin(), onEdge[at(x)].end(), [](const Hit& m, const Hit& n) {
				return m.along < n.along;
			});
			ASSERT_EQ(static_cast<int>(onEdge[at(x)].size()), c.crossings(x));
			for (std::size_t i = 0; i < onEdge[at(x)].size(); ++i)
				EXPECT_EQ(curveAt[at(x)][i], onEdge[at(x)][i].edge);
		}
	}
}

} // namespace
} // namespace ricci::testing
