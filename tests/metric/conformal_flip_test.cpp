// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/listener.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/error.h>
#include <ricci/metric/conformal_flip.h>
#include <ricci/metric/euclidean.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

constexpr Vertex kI(0), kJ(1), kK(2), kL(3);

/// Two triangles ijk and jil.
Triangulation quad()
{
	return Triangulation(4, {{0, 1, 2}, {1, 0, 3}});
}

/// Of circles with these u, as a VertexArray or a VertexVector.
template<class Values>
VertexArray<double> curvatures(const Values& u)
{
	VertexArray<double> kappa;
	for (double x : u)
		kappa.push_back(Euclidean::circle(x).kappa);
	return kappa;
}

/// T_k + T_l of conformal_flip.h in extended precision, relative to the sum of its terms.
double relativeTilt(
	const Triangulation& t,
	const EdgeArray<double>& delta,
	const VertexArray<double>& kappa,
	Edge e)
{
	const long double c = 1.0L + delta[e];
	long double sum = 0, size = 0;
	for (const Halfedge h : {e.halfedge(), e.halfedge().twin()}) {
		const Halfedge next = t.next(h), last = t.previous(h);
		const long double jk = 1.0L + delta[next.edge()];
		const long double ik = 1.0L + delta[last.edge()];
		const long double D = c * c + ik * ik + jk * jk + 2 * c * ik * jk - 1;
		const long double plus =
			kappa[t.origin(h)] * (ik + c * jk) + kappa[t.target(h)] * (jk + c * ik);
		const long double minus = kappa[t.origin(last)] * (c * c - 1);
		sum += (plus - minus) / std::sqrt(D);
		size += (plus + minus) / std::sqrt(D);
	}
	return static_cast<double>(sum / size);
}

TEST(ConformalFlip, FlippingTwiceIsTheIdentity)
{
	Random random(30);
	for (int i = 0; i < 2000; ++i) {
		Triangulation t = quad();
		EdgeArray<double> delta(t.edgeCount());
		for (double& d : delta)
			d = std::pow(10.0, random.real(-8, 8));
		const Edge e = edgeBetween(t, kI, kJ);
		const double before = delta[e];
		delta[e] = flippedDelta(t, delta, e);
		const double across = delta[e];
		t.flip(e);
		// The inversive distance of a flipped edge has a relative error of some eps. Flipping back
		// divides by delta (delta + 2) of that edge, which magnifies the error by 1 / delta.
		const double error = 32 * kEpsilon * (1.0 + 1.0 / across) * (1.0 + before);
		EXPECT_NEAR(flippedDelta(t, delta, e), before, error) << "across " << across;
	}
}

TEST(ConformalFlip, OrthogonalCirclesInThePlaneGiveTheOtherDiagonal)
{
	// Circles with equal power in one point (orthogonal to a common circle round it) are the case
	// where flipping in the conformal class is flipping in the plane.
	Random random(31);
	int cases = 0;
	while (cases < 100) {
		std::array<Point3, 4> p; // i, l, j, k counter-clockwise round the origin
		std::array<double, 4> radius;
		const double power = random.real(0.1, 0.95);
		for (int n = 0; n < 4; ++n) {
			const double angle = 1.5707963267948966 * (n + random.real(-0.3, 0.3));
			const double d = random.real(1.0, 3.0);
			p[at(n)] = {d * std::cos(angle), d * std::sin(angle), 0.0};
			radius[at(n)] = std::sqrt(d * d - power);
		}
		const VertexArray<std::size_t> place{0, 2, 3, 1}; // of i, j, k, l
		Triangulation t = quad();
		const auto deltaOf = [&](Vertex a, Vertex b) {
			const std::size_t x = place[a], y = place[b];
			return Euclidean::delta(distance(p[x], p[y]), radius[x], radius[y]);
		};
		EdgeArray<double> delta(t.edgeCount());
		for (const Edge e : t.edges())
			delta[e] = deltaOf(t.ends(e)[0], t.ends(e)[1]);
		const double diagonal = deltaOf(kK, kL);
		if (*std::min_element(delta.begin(), delta.end()) < 1e-3 || diagonal < 1e-3)
			continue; // the formula is for circles that do not intersect
		++cases;
		EXPECT_NEAR(flippedDelta(t, delta, edgeBetween(t, kI, kJ)) / diagonal, 1.0, 1e-10);
	}
}

TEST(ConformalFlip, OrthogonalCirclesInThePlaneAreATie)
{
	// A common orthogonal circle of both triangles is the weighted form of four points on a circle.
	Random random(32);
	for (int i = 0; i < 200; ++i) {
		const Triangulation t = quad();
		const double power = random.real(0.1, 0.9);
		VertexArray<Point2> place;
		VertexArray<double> u;
		EdgeArray<double> delta(t.edgeCount());
		const std::array<int, 4> quarter{0, 2, 1, 3};
		for (std::size_t n = 0; n < 4; ++n) {
			const double a = 1.5707963267948966 * (quarter[n] + random.real(-0.3, 0.3));
			const double d = random.real(1.0, 3.0);
			place.push_back({d * std::cos(a), d * std::sin(a)});
			u.push_back(0.5 * std::log(d * d - power));
		}
		for (const Edge e : t.edges()) {
			const auto [a, b] = t.ends(e);
			delta[e] =
				Euclidean::delta(distance(place[a], place[b]), std::exp(u[a]), std::exp(u[b]));
		}
		EXPECT_NEAR(relativeTilt(t, delta, curvatures(u), edgeBetween(t, kI, kJ)), 0.0, 1e-13);
	}
}

TEST(ConformalFlip, CirclesStayDisjoint)
{
	Random random(33);
	for (int i = 0; i < 2000; ++i) {
		Triangulation t = quad();
		EdgeArray<double> delta(t.edgeCount());
		for (double& d : delta)
			d = random.coin() ? 0.0 : std::pow(10.0, random.real(-10, 10));
		const Edge e = edgeBetween(t, kI, kJ);
		delta[e] = std::pow(10.0, random.real(-10, 10));
		// By the formula in extended precision; the header's clamp must only ever remove rounding.
		const auto I = [&](Vertex a, Vertex b) { return 1.0L + delta[edgeBetween(t, a, b)]; };
		const auto root = [&](Vertex apex) {
			const long double c = I(kI, kJ), a = I(kI, apex), b = I(kJ, apex);
			return std::sqrt(c * c + a * a + b * b + 2 * a * b * c - 1);
		};
		const long double c = I(kI, kJ), c2 = delta[e] * (delta[e] + 2.0L);
		const long double exact =
			(I(kI, kK) * I(kI, kL) + I(kJ, kK) * I(kJ, kL) +
			 c * (I(kI, kK) * I(kJ, kL) + I(kJ, kK) * I(kI, kL)) + root(kK) * root(kL)) /
			c2;
		EXPECT_GT(exact, 1.0L - 1e-15L);
		EXPECT_GE(flippedDelta(t, delta, e), 0.0);
		EXPECT_NEAR((1.0 + flippedDelta(t, delta, e)) / static_cast<double>(exact), 1.0, 2e-15);
	}
}

TEST(ConformalFlip, ValuesOutOfRangeAreNotTangentCircles)
{
	const Triangulation t = quad();
	for (const double huge : {1e160, 1e300, HUGE_VAL, std::nan("")}) {
		const double flipped = flippedDelta(t, EdgeArray<double>(5, huge), edgeBetween(t, kI, kJ));
		EXPECT_FALSE(std::isfinite(flipped)) << flipped;
	}
}

TEST(ConformalFlip, UnwindsANeedleOfManyTurns)
{
	// However few edges there are, the flips end, with all edges Delaunay; and they can be cancelled.
	for (const double turns : {100.0, 20000.0, 200000.0}) {
		const double radius = 0.25, height = 0.005 * turns;
		Triangulation t = oneVertexTorus();
		EdgeArray<double> delta(3);
		const std::array<double, 3> sides{
			1.0, std::hypot(turns, height), std::hypot(turns + 1.0, height)};
		for (std::size_t k = 0; k < 3; ++k)
			delta[t.halfedges(Face(0))[k].edge()] = Euclidean::delta(sides[k], radius, radius);
		const VertexArray<double> kappa(1, 1.0 / radius);
		const Triangulation wound = t;
		const EdgeArray<double> woundDelta = delta;
		FlipJournal journal;
		DelaunayQueue queue;
		Listener ticks;
		const int flips =
			heard(ticks, [&] { return makeWeightedDelaunay(t, delta, kappa, journal, queue, 1); });
		EXPECT_GE(flips, static_cast<int>(0.5 * turns));
		EXPECT_GE(ticks.calls(), flips / 65536);
		for (const Edge e : t.edges())
			EXPECT_TRUE(isWeightedDelaunay(t, delta, kappa, e));
		t = wound;
		delta = woundDelta;
		journal.clear();
		Listener impatient(1);
		const Task task(impatient);
		EXPECT_THROW(makeWeightedDelaunay(t, delta, kappa, journal, queue, 1), Cancelled);
		rewind(journal, t, delta);
		EXPECT_EQ(delta, woundDelta);
	}
}

TEST(ConformalFlip, DelaunayEdgesAreThoseWithoutNegativeWeight)
{
	Random random(34);
	int negative = 0, positive = 0;
	for (int trial = 0; trial < 20; ++trial) {
		const Packed packed(trial % 2 ? bumpyTorus(10, 8, random) : randomPlanarDisk(9, random));
		VertexVector u = packed.u();
		auto map = packed.map();
		for (double& x : u)
			x += random.real(-0.15, 0.15);
		map.evaluate(u);
		if (map.brokenTriangles() > 0)
			continue; // the statement is about true triangles
		const auto kappa = curvatures(u);
		for (const Edge e : map.triangulation().edges()) {
			const double tilt = relativeTilt(map.triangulation(), map.delta(), kappa, e);
			if (!map.triangulation().isFlippable(e) || std::abs(tilt) < 1e-12)
				continue;
			const bool good = isWeightedDelaunay(map.triangulation(), map.delta(), kappa, e);
			EXPECT_EQ(good, tilt > 0);
			EXPECT_EQ(good, map.weights()[e] > 0) << map.weights()[e];
			++(good ? positive : negative);
		}
	}
	EXPECT_GT(negative, 100);
	EXPECT_GT(positive, 100);
}

TEST(ConformalFlip, TheFlippedEdgeIsDelaunayWhereTheOldOneWasNot)
{
	Random random(35);
	int negative = 0, positive = 0;
	for (int i = 0; i < 1000; ++i) {
		Triangulation t = quad();
		EdgeArray<double> delta(t.edgeCount());
		VertexArray<double> kappa(4);
		for (double& d : delta)
			d = std::pow(10.0, random.real(-3, 3));
		for (double& k : kappa)
			k = std::pow(10.0, random.real(-3, 3));
		const Edge e = edgeBetween(t, kI, kJ);
		const double tilt = relativeTilt(t, delta, kappa, e);
		if (std::abs(tilt) < 1e-9)
			continue;
		++(tilt > 0 ? positive : negative);
		EXPECT_EQ(isWeightedDelaunay(t, delta, kappa, e), tilt > 0);
		delta[e] = flippedDelta(t, delta, e);
		t.flip(e);
		EXPECT_EQ(isWeightedDelaunay(t, delta, kappa, e), tilt < 0);
	}
	EXPECT_GT(negative, 100);
	EXPECT_GT(positive, 100);
}

TEST(ConformalFlip, BoundaryAndSelfGluedEdgesAreDelaunay)
{
	const Triangulation t = quad();
	const EdgeArray<double> delta(5, 1.0);
	const VertexArray<double> kappa{1, 1, 1e9, 1e9};
	for (const Edge e : t.edges())
		EXPECT_EQ(isWeightedDelaunay(t, delta, kappa, e), t.isBoundary(e));
	const Triangulation cone = glued(2, {{0, 1, 0}}, {1, 0, -1});
	EXPECT_TRUE(isWeightedDelaunay(cone, {1.0, 1.0}, {1e9, 1.0}, Edge(0)));
}

/// Ends and inversive distance of all edges that are not ties, in a canonical order: the Delaunay
/// tessellation, whose polygons with more than three corners have no preferred triangulation.
std::vector<std::tuple<int, int, double>> tessellation(
	const Triangulation& t,
	const EdgeArray<double>& delta,
	const VertexArray<double>& kappa,
	const VertexArray<int>& name)
{
	std::vector<std::tuple<int, int, double>> edges;
	for (const Edge e : t.edges()) {
		if (t.isFlippable(e) && std::abs(relativeTilt(t, delta, kappa, e)) < 1e-10)
			continue;
		const auto [i, j] = t.ends(e);
		const int a = name[i], b = name[j];
		edges.emplace_back(std::min(a, b), std::max(a, b), delta[e]);
	}
	std::sort(edges.begin(), edges.end());
	return edges;
}

TEST(ConformalFlip, DelaunayTessellationDoesNotDependOnTheOrderOfFlips)
{
	Random random(36);
	std::vector<SurfaceMesh> meshes{
		bumpyTorus(10, 8, random),
		randomPlanarDisk(9, random),
		torus(3, 1, 12, 10), // symmetric: many ties
		rectangle(7, 7, 1, 1)};
	for (const SurfaceMesh& mesh : meshes) {
		std::vector<std::tuple<int, int, double>> first;
		for (int trial = 0; trial < 4; ++trial) {
			// Other numbers, and random flips beforehand, change the order of everything.
			const Renumbered other = renumbered(mesh, random);
			Packed packed(trial == 0 ? mesh : other.mesh);
			VertexArray<int> name(other.vertex);
			if (trial == 0)
				for (const Vertex v : name.indices())
					name[v] = v.number();
			Triangulation& t = packed.packing.triangulation;
			EdgeArray<double>& delta = packed.packing.delta;
			FlipJournal journal;
			DelaunayQueue queue;
			int scrambled = 0;
			for (int scramble = 0; scramble < 60 * trial; ++scramble) {
				const Edge e(random.index(t.edgeCount()));
				if (!t.isFlippable(e) || delta[e] < 1e-2)
					continue;
				++scrambled;
				delta[e] = flippedDelta(t, delta, e);
				t.flip(e);
			}
			VertexArray<double> u(name.size());
			for (const Vertex v : u.indices()) // a smooth function of the place
				u[v] =
					std::log(packed.radii[v]) + 0.3 * std::sin(2 * mesh.positions[at(name[v])][0]);
			const auto kappa = curvatures(u);
			makeWeightedDelaunay(t, delta, kappa, journal, queue);
			for (const Edge e : t.edges())
				EXPECT_TRUE(isWeightedDelaunay(t, delta, kappa, e));
			EXPECT_GE(scrambled, 20 * trial);
			const auto edges = tessellation(t, delta, kappa, name);
			EXPECT_GT(edges.size(), 50u);
			if (trial == 0)
				first = edges;
			ASSERT_EQ(edges.size(), first.size());
			for (std::size_t i = 0; i < edges.size(); ++i) {
				EXPECT_EQ(std::get<0>(edges[i]), std::get<0>(first[i]));
				EXPECT_EQ(std::get<1>(edges[i]), std::get<1>(first[i]));
				EXPECT_NEAR(
					std::get<2>(edges[i]),
					std::get<2>(first[i]),
					1e-9 * (1 + std::get<2>(first[i])));
			}
		}
	}
}

TEST(ConformalFlip, NoTriangleBreaksOnADelaunayTriangulation)
{
	Random random(37);
	for (const SurfaceMesh& mesh : {torus(3, 1, 12, 10), bumpyTorus(10, 8, random)}) {
		const Packed packed(mesh);
		for (double spread : {0.5, 2.0, 6.0}) {
			CirclePacking packing = packed.packing;
			VertexVector u = packed.u();
			for (double& x : u)
				x += random.real(-spread, spread);
			const auto kappa =
				curvatures(VertexArray<double>(std::vector<double>(u.begin(), u.end())));
			GeometricCurvatureMap<Euclidean> fixed(packing);
			fixed.evaluate(u);
			if (spread > 1.0) {
				EXPECT_GT(fixed.brokenTriangles(), 0);
			}
			FlipJournal journal;
			DelaunayQueue queue;
			const int flips =
				makeWeightedDelaunay(packing.triangulation, packing.delta, kappa, journal, queue);
			EXPECT_EQ(flips, static_cast<int>(journal.size()));
			EXPECT_GT(flips, 0);
			GeometricCurvatureMap<Euclidean> map(packing);
			map.evaluate(u);
			EXPECT_EQ(map.brokenTriangles(), 0);
			const double largest = *std::max_element(map.weights().begin(), map.weights().end());
			for (double w : map.weights())
				EXPECT_GE(w, -1e-12 * largest);
		}
	}
}

TEST(ConformalFlip, CurvatureIsTheSameOnBothSidesOfAFlip)
{
	// Where an edge is exactly between Delaunay and not, flipping it is an isometry.
	Random random(38);
	int crossings = 0;
	for (int trial = 0; trial < 40; ++trial) {
		const Packed packed(bumpyTorus(8, 6, random));
		VertexVector from = packed.u(), to = from;
		for (double& x : to)
			x += random.real(-0.3, 0.3);
		const Triangulation& t = packed.packing.triangulation;
		const auto tilt = [&](const VertexVector& u, Edge e) {
			return relativeTilt(t, packed.packing.delta, curvatures(u), e);
		};
		for (const Edge e : t.edges()) {
			if ((tilt(from, e) > 0) == (tilt(to, e) > 0))
				continue;
			VertexVector a = from, b = to;
			for (int i = 0; i < 60; ++i) {
				const VertexVector middle = 0.5 * (a + b);
				((tilt(middle, e) > 0) == (tilt(a, e) > 0) ? a : b) = middle;
			}
			GeometricCurvatureMap<Euclidean> before(packed.packing), after(packed.packing);
			before.evaluate(a);
			if (before.brokenTriangles() > 0)
				continue;
			after.swapEdge(e, flippedDelta(t, packed.packing.delta, e));
			after.evaluate(a);
			++crossings;
			EXPECT_EQ(after.brokenTriangles(), 0);
			EXPECT_LT((before.curvature() - after.curvature()).lpNorm<Eigen::Infinity>(), 1e-12);
		}
	}
	EXPECT_GT(crossings, 100);
}

TEST(ConformalFlip, RewindRestoresEveryBit)
{
	Random random(39);
	for (const SurfaceMesh& mesh : {bumpyTorus(10, 8, random), sliverDisk(8, 2.0, random)}) {
		Packed packed(mesh);
		Triangulation& t = packed.packing.triangulation;
		EdgeArray<double>& delta = packed.packing.delta;
		const Triangulation before = t;
		const EdgeArray<double> deltaBefore = delta;
		const VertexVector start = packed.u();
		VertexArray<double> u(std::vector<double>(start.begin(), start.end()));
		FlipJournal journal;
		DelaunayQueue queue;
		int flips = 0;
		for (int round = 0; round < 5; ++round) {
			for (double& x : u)
				x += random.real(-1, 1);
			flips += makeWeightedDelaunay(t, delta, curvatures(u), journal, queue);
		}
		EXPECT_EQ(static_cast<int>(journal.size()), flips);
		EXPECT_GT(flips, 50);
		rewind(journal, t, delta);
		EXPECT_TRUE(journal.empty());
		EXPECT_EQ(delta, deltaBefore);
		for (const Halfedge h : t.halfedges()) {
			ASSERT_EQ(t.next(h), before.next(h));
			ASSERT_EQ(t.origin(h), before.origin(h));
			ASSERT_EQ(t.face(h), before.face(h));
		}
	}
}

} // namespace
} // namespace ricci::testing
