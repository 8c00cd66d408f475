// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/closed_flows.h"
#include "support/intrinsic.h"
#include "support/planar_edges.h"

#include <ricci/base/numbers.h>
#include <ricci/overlay/edge_crossings.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace ricci::testing {
namespace {

/// Where an input edge is crossed, in space.
Point3 placeOf(const FlippedFlow& flow, const InputCrossing& x)
{
	const auto [a, b] = flow.base().ends(x.edge);
	const VertexArray<Point3>& p = flow.surface().positions;
	return (1.0 - x.onInput) * p[a] + x.onInput * p[b];
}

/// A path on the faces of the mesh whose length is the edge's length is the straight one.
TEST(EdgeCrossings, WithTheInputLieOnStraightLines)
{
	Random random(800);
	int crossings = 0;
	for (const FlippedFlow& flow : closedFlows(random)) {
		const EdgeCrossings x(flow.result);
		const IntrinsicMesh& start = flow.result.start.mesh;
		const Triangulation& input = flow.base();
		for (const Edge e : start.triangulation.edges()) {
			const auto [i, j] = start.triangulation.ends(e);
			std::vector<Point3> path{flow.surface().positions[i]};
			std::vector<double> shares{0.0};
			std::vector<Edge> edges;
			for (int n = x.inputOn.first(e); n < x.inputOn.last(e); ++n) {
				path.push_back(placeOf(flow, x.inputCrossings[n]));
				shares.push_back(x.inputCrossings[n].onStart);
				edges.push_back(x.inputCrossings[n].edge);
				++crossings;
			}
			path.push_back(flow.surface().positions[j]);
			shares.push_back(1.0);
			for (std::size_t k = 0; k + 1 < edges.size(); ++k) { // in one face from edge to edge
				const Halfedge h = edges[k].halfedge(), g = edges[k + 1].halfedge();
				EXPECT_TRUE(
					input.face(h) == input.face(g) || input.face(h) == input.face(g.twin()) ||
					input.face(h.twin()) == input.face(g) ||
					input.face(h.twin()) == input.face(g.twin()));
			}
			double way = 0.0;
			for (std::size_t k = 0; k + 1 < path.size(); ++k) {
				EXPECT_NEAR(way / start.lengths[e], shares[k], 1e-9);
				EXPECT_LE(shares[k], shares[k + 1]);
				way += distance(path[k], path[k + 1]);
			}
			EXPECT_NEAR(way / start.lengths[e], 1.0, 1e-9);
		}
	}
	EXPECT_GT(crossings, 100); // or the test says little
}

/// In the plane which edges cross is seen from their ends, and where from both edges.
TEST(EdgeCrossings, InThePlaneAreThoseOfTheDrawing)
{
	Random random(801);
	std::size_t crossings = 0;
	for (int trial = 0; trial < 5; ++trial) {
		SurfaceMesh mesh = randomPlanarDisk(7, random);
		for (Point3& p : mesh.positions)
			p[0] *= 1.0 + 3.0 * trial; // needles
		const FlippedFlow flow(mesh, requestOf(TargetCurvature::Automatic));
		ASSERT_FALSE(flow.result.doubled);
		const EdgeCrossings x(flow.result);
		const Triangulation& start = flow.result.start.mesh.triangulation;
		const VertexArray<Point3>& p = flow.surface().positions;
		const PlanarEdges plane(mesh);
		std::set<std::pair<Edge, Edge>> wanted, found;
		for (const Edge e : flow.base().edges())
			for (const Edge s : start.edges())
				if (plane.cross(flow.base().ends(e), start.ends(s)))
					wanted.insert({e, s});
		for (const Edge s : start.edges())
			for (int n = x.inputOn.first(s); n < x.inputOn.last(s); ++n) {
				const InputCrossing& crossing = x.inputCrossings[n];
				EXPECT_TRUE(found.insert({crossing.edge, s}).second);
				const auto [c, d] = start.ends(s);
				const double share = crossing.onStart;
				EXPECT_LT(
					distance(placeOf(flow, crossing), (1.0 - share) * p[c] + share * p[d]), 1e-11);
			}
		EXPECT_EQ(found, wanted);
		crossings += found.size();
	}
	EXPECT_GT(crossings, 100u); // or the test says little
}

TEST(EdgeCrossings, AreNumberedOnceEach)
{
	Random random(802);
	for (const FlippedFlow& flow : closedFlows(random)) {
		const EdgeCrossings x(flow.result);
		const auto expectEachOnce = [](const EdgeArray<EdgeCrossings::Curve>& curves,
									   const EdgeRanges& on,
									   const auto& numberOf,
									   const auto& edgeOf) {
			std::vector<int> numbers;
			for (const Edge e : curves.indices())
				for (const auto& crossing : curves[e].crossings) {
					const int n = numberOf(crossing);
					EXPECT_GE(n, on.first(crossing.halfedge.edge()));
					EXPECT_LT(n, on.last(crossing.halfedge.edge()));
					EXPECT_EQ(edgeOf(n), e);
					numbers.push_back(n);
				}
			std::sort(numbers.begin(), numbers.end());
			ASSERT_EQ(numbers.size(), at(on.total()));
			for (std::size_t n = 0; n < numbers.size(); ++n)
				EXPECT_EQ(at(numbers[n]), n);
		};
		expectEachOnce(
			x.inputCurves,
			x.inputOn,
			[&](const auto& crossing) { return x.inputNumber(crossing); },
			[&](int n) { return x.inputCrossings[n].edge; });
		expectEachOnce(
			x.endCurves,
			x.endOn,
			[&](const auto& crossing) { return x.endNumber(crossing); },
			[&](int n) { return x.endCrossings[n].edge; });
		// The end's edges on the start, found backwards, and the start's on the end, forwards.
		for (const Edge e : x.startCurves.indices())
			EXPECT_EQ(x.startCurves[e].crossings.size(), at(x.endOn.size(e)));
	}
}

/// End edges do not cross each other, however far they wind.
TEST(EdgeCrossings, WithTheEndAreInTheirOrder)
{
	Random random(804);
	std::size_t longest = 0;
	for (int trial = 0; trial < 20; ++trial) {
		SurfaceMesh mesh = grid(6, 5, Ends::Joined, Ends::Joined, [&](int i, int) {
			return Point3{i + random.real(-0.2, 0.2), random.real(-0.2, 0.2), 0.0};
		});
		mesh.positions[10][0] = 4000.0; // far out, at the end of needles
		std::vector<double> curvature(mesh.positions.size(), 1.5 * kPi);
		curvature[1] = -1.5 * kPi * static_cast<double>(mesh.positions.size() - 1);
		const FlippedFlow flow(mesh, prescribed(curvature));
		const EdgeCrossings x(flow.result);
		for (const EdgeCrossings::Curve& curve : x.endCurves)
			longest = std::max(longest, curve.crossings.size());
		for (const Edge e : flow.result.start.mesh.triangulation.edges()) {
			double before = 0.0;
			for (int n = x.endOn.first(e); n < x.endOn.last(e); ++n) {
				const double share = x.endCrossings[n].onStart.affine();
				EXPECT_GE(share, before - 1e-12) << trial;
				before = share;
			}
			EXPECT_LE(before, 1.0);
		}
	}
	EXPECT_GT(longest, 30u); // or the test says little
}

/// A vector of R^{2,1} by weights of the corners of a start triangle, and by those of the ends of an
/// end edge.
struct TwoBases
{
	Face face;
	std::array<double, 3> inFace{0, 0, 0}; ///< [corner] of the start triangle
	EdgeWeights onEnd;
};

/// Both sides of an equation with the sum of its terms' sizes.
struct Product
{
	double value = 0.0, size = 0.0;

	void add(double term)
	{
		value += term;
		size += std::abs(term);
	}
};

/// Crossings of an end edge have one product with each other and with its ends, whether it is formed
/// by the inversive distances of a start triangle, <x_i, x_j> = -I_ij, or by that of the end edge.
TEST(EdgeCrossings, WithTheEndAreVectorsOfBothTriangulations)
{
	Random random(803);
	int crossings = 0, several = 0;
	for (const FlippedFlow& flow : closedFlows(random)) {
		const EdgeCrossings x(flow.result);
		const Triangulation& start = flow.result.start.mesh.triangulation;
		const EdgeArray<double>& startDelta = flow.result.start.delta;
		const auto corner = [&](Halfedge h) { return start.corner(h).index(); };
		const auto atVertex = [&](Halfedge h, const EdgeWeights& onEnd) {
			TwoBases p{start.face(h), {0, 0, 0}, onEnd};
			p.inFace[corner(h)] = 1.0;
			return p;
		};
		const auto onSide = [&](Halfedge h, const EndCrossing& crossing) {
			const EdgeWeights w = h.isFirst() ? crossing.onStart : crossing.onStart.reversed();
			TwoBases p{start.face(h), {0, 0, 0}, crossing.onEnd};
			p.inFace[corner(h)] = w.from;
			p.inFace[(corner(h) + 1) % 3] = w.to;
			return p;
		};
		const auto expectOneProduct = [&](const TwoBases& p, const TwoBases& q, Edge endEdge) {
			ASSERT_EQ(p.face, q.face);
			const auto sides = start.halfedges(p.face);
			Product byStart, byEnd;
			for (std::size_t k = 0; k < 3; ++k) {
				const std::size_t l = (k + 1) % 3;
				byStart.add(p.inFace[k] * q.inFace[k]);
				const double distance = 1.0 + startDelta[sides[k].edge()];
				byStart.add(-distance * p.inFace[k] * q.inFace[l]);
				byStart.add(-distance * p.inFace[l] * q.inFace[k]);
			}
			const double distance = 1.0 + flow.result.metric->delta()[endEdge];
			byEnd.add(p.onEnd.from * q.onEnd.from);
			byEnd.add(p.onEnd.to * q.onEnd.to);
			byEnd.add(-distance * p.onEnd.from * q.onEnd.to);
			byEnd.add(-distance * p.onEnd.to * q.onEnd.from);
			EXPECT_NEAR(byStart.value, byEnd.value, 1e-9 * (byStart.size + byEnd.size));
		};
		for (const Edge e : x.endCurves.indices()) {
			const EdgeCrossings::Curve& curve = x.endCurves[e];
			if (curve.crossings.empty())
				continue; // a start edge as well
			TwoBases before = atVertex(curve.first, {1.0, 0.0});
			double share = 0.0;
			for (const auto& c : curve.crossings) {
				const EndCrossing& crossing = x.endCrossings[x.endNumber(c)];
				EXPECT_GE(crossing.onEnd.affine(), share); // in order from the origin on
				share = crossing.onEnd.affine();
				const TwoBases here = onSide(c.halfedge, crossing);
				expectOneProduct(before, here, e);
				expectOneProduct(here, here, e);
				before = onSide(c.halfedge.twin(), crossing);
				++crossings;
			}
			expectOneProduct(before, atVertex(curve.last, {0.0, 1.0}), e);
			several += curve.crossings.size() > 1;
		}
		for (const Edge s : start.edges()) {
			double ratio = 0.0;
			for (int n = x.endOn.first(s); n < x.endOn.last(s); ++n) {
				const EdgeWeights& w = x.endCrossings[n].onStart;
				EXPECT_GT(w.from, 0.0);
				EXPECT_GT(w.to, 0.0);
				EXPECT_GE(w.to / w.from, ratio * (1.0 - 1e-9));
				ratio = w.to / w.from;
			}
		}
	}
	EXPECT_GT(crossings, 100); // or the test says little
	EXPECT_GT(several, 10);
}

} // namespace
} // namespace ricci::testing
