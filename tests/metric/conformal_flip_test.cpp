// SPDX-License-Identifier: GPL-3.0-or-later
// Where a packing starts, and its flips.
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/metric/area.h>
#include <ricci/metric/conformal_flip.h>

#include <gtest/gtest.h>

namespace ricci::testing {
namespace {

constexpr Vertex kI(0), kJ(1), kK(2), kL(3);

/// Two triangles ijk and jil with these inversive distances, and the edge between them.
struct Quad
{
	Triangulation t{4, {{0, 1, 2}, {1, 0, 3}}};
	EdgeArray<double> delta = EdgeArray<double>(t.edgeCount());
	Edge e = edgeBetween(t, kI, kJ);

	void flip()
	{
		delta[e] = flippedDelta(t, delta, e);
		t.flip(e);
	}
};

double powerOfTen(double bound, Random& random)
{
	return std::pow(10.0, random.real(-bound, bound));
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

/// By the formula in extended precision, whatever the header does about rounding; and twice is the identity.
TEST(ConformalFlip, KeepsTheConformalClass)
{
	Random random(33);
	for (int i = 0; i < 2000; ++i) {
		Quad quad;
		for (double& d : quad.delta)
			d = random.coin() ? 0.0 : powerOfTen(8, random);
		const double before = quad.delta[quad.e] = powerOfTen(8, random);
		const auto I = [&](Vertex a, Vertex b) {
			return 1.0L + quad.delta[edgeBetween(quad.t, a, b)];
		};
		const auto root = [&](Vertex apex) {
			const long double c = I(kI, kJ), a = I(kI, apex), b = I(kJ, apex);
			return std::sqrt(c * c + a * a + b * b + 2 * a * b * c - 1);
		};
		const long double c = I(kI, kJ), c2 = before * (before + 2.0L);
		const long double exact =
			(I(kI, kK) * I(kI, kL) + I(kJ, kK) * I(kJ, kL) +
			 c * (I(kI, kK) * I(kJ, kL) + I(kJ, kK) * I(kI, kL)) + root(kK) * root(kL)) /
			c2;
		quad.flip();
		const double across = quad.delta[quad.e];
		EXPECT_GE(across, 0.0);
		EXPECT_NEAR((1.0 + across) / static_cast<double>(exact), 1.0, 2e-15);
		if (across == 0.0)
			continue; // tangent circles cannot be flipped
		// The inversive distance of a flipped edge has a relative error of some eps. Flipping back
		// divides by delta (delta + 2) of that edge, which magnifies the error by 1 / delta.
		quad.flip();
		EXPECT_NEAR(
			quad.delta[quad.e],
			before,
			32 * std::numeric_limits<double>::epsilon() * (1.0 + 1.0 / across) * (1.0 + before));
	}
	for (const double huge : {1e160, 1e300, HUGE_VAL, std::nan("")}) {
		Quad quad;
		quad.delta.assign(5, huge);
		quad.flip();
		EXPECT_FALSE(std::isfinite(quad.delta[quad.e])) << huge; // no tangent circles
	}
}

/// Circles with equal power in one point are orthogonal to a common circle round it, the weighted form of
/// four points on a circle: flipping in the conformal class then is flipping in the plane, and a tie.
TEST(ConformalFlip, OrthogonalCirclesInThePlaneAreATieAndGiveTheOtherDiagonal)
{
	Random random(31);
	int disjoint = 0;
	for (int i = 0; i < 1000; ++i) {
		Quad quad;
		// Small circles, for the formula, which is for circles that do not intersect; and any.
		const bool isSmall = i % 2 == 0;
		const double power = random.real(isSmall ? 0.9 : 0.1, 0.98);
		VertexArray<Point3> place;
		VertexArray<double> radius, kappa;
		for (const int quarter : {0, 2, 3, 1}) { // i, l, j, k counter-clockwise round the origin
			const double angle = 0.5 * kPi * (quarter + random.real(-0.3, 0.3));
			const double d = random.real(1.0, isSmall ? 1.1 : 3.0);
			place.push_back({d * std::cos(angle), d * std::sin(angle), 0.0});
			radius.push_back(std::sqrt(d * d - power));
			kappa.push_back(1 / radius.back());
		}
		const auto deltaOf = [&](Vertex a, Vertex b) {
			return Euclidean::delta(distance(place[a], place[b]), radius[a], radius[b]);
		};
		for (const Edge e : quad.t.edges())
			quad.delta[e] = deltaOf(quad.t.ends(e)[0], quad.t.ends(e)[1]);
		EXPECT_NEAR(relativeTilt(quad.t, quad.delta, kappa, quad.e), 0.0, 1e-13);
		const double diagonal = deltaOf(kK, kL);
		if (*std::min_element(quad.delta.begin(), quad.delta.end()) < 1e-3 || diagonal < 1e-3)
			continue;
		++disjoint;
		quad.flip();
		EXPECT_NEAR(quad.delta[quad.e] / diagonal, 1.0, 1e-10);
	}
	EXPECT_GT(disjoint, 100);
}

TEST(ConformalFlip, DelaunayEdgesAreThoseWithoutNegativeWeight)
{
	Random random(34);
	int negative = 0, positive = 0;
	for (int trial = 0; trial < 20; ++trial) {
		const Packed packed(trial % 2 ? bumpyTorus(10, 8, random) : randomPlanarDisk(9, random));
		VertexVector u = packed.u();
		VertexArray<double> kappa;
		for (double& x : u) {
			x += random.real(-0.15, 0.15);
			kappa.push_back(Euclidean::circle(x).kappa);
		}
		auto map = packed.map();
		map.evaluate(u);
		if (map.brokenTriangles() > 0)
			continue; // the statement is about true triangles
		const Triangulation& t = map.triangulation();
		for (const Edge e : t.edges()) {
			const double tilt = relativeTilt(t, map.delta(), kappa, e);
			if (!t.isFlippable(e) || std::abs(tilt) < 1e-12)
				continue;
			const bool good = isWeightedDelaunay(t, map.delta(), kappa, e);
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
		Quad quad;
		VertexArray<double> kappa(4);
		for (double& d : quad.delta)
			d = powerOfTen(3, random);
		for (double& k : kappa)
			k = powerOfTen(3, random);
		const double tilt = relativeTilt(quad.t, quad.delta, kappa, quad.e);
		if (std::abs(tilt) < 1e-9)
			continue;
		++(tilt > 0 ? positive : negative);
		EXPECT_EQ(isWeightedDelaunay(quad.t, quad.delta, kappa, quad.e), tilt > 0);
		quad.flip();
		EXPECT_EQ(isWeightedDelaunay(quad.t, quad.delta, kappa, quad.e), tilt < 0);
	}
	EXPECT_GT(negative, 100);
	EXPECT_GT(positive, 100);
	const VertexArray<double> kappa{1, 1, 1e9, 1e9};
	const Quad quad;
	for (const Edge e : quad.t.edges()) // edges of the boundary, and glued to themselves
		EXPECT_EQ(
			isWeightedDelaunay(quad.t, EdgeArray<double>(5, 1.0), kappa, e), quad.t.isBoundary(e));
	const Triangulation cone = glued(2, {{0, 1, 0}}, {1, 0, -1});
	EXPECT_TRUE(isWeightedDelaunay(cone, {1.0, 1.0}, {1e9, 1.0}, Edge(0)));
}

TEST(CirclePacking, ThurstonClampsTheInversiveDistance)
{
	// Equilateral triangle: I = 1 / (2 r^2) - 1 for circles of equal radius r.
	const Triangulation t(3, {{0, 1, 2}});
	for (const double r : {0.4, 0.5, 0.6, 0.7, 0.8}) {
		const double clamped = std::clamp(0.5 / (r * r) - 1.0, 0.0, 1.0);
		for (const double delta : thurstonDistancesLessOne(t, {1, 1, 1}, {r, r, r}))
			EXPECT_NEAR(1.0 + delta, clamped, 1e-15);
	}
}

/// Sides of length 1, and as wound round a torus of this \p height so many \p turns.
IntrinsicMesh wound(double turns, double height)
{
	IntrinsicMesh mesh{oneVertexTorus(), EdgeArray<double>(3)};
	const auto h = mesh.triangulation.halfedges(Face(0));
	mesh.lengths[h[0].edge()] = 1.0;
	mesh.lengths[h[1].edge()] = std::hypot(turns, height);
	mesh.lengths[h[2].edge()] = std::hypot(turns + 1.0, height);
	return mesh;
}

TEST(DelaunayPacking, UnwindsANeedleOfManyTurns)
{
	// A torus of one vertex, 1 by 30, whose triangles are wound round it: every flip takes one turn off,
	// however few edges there are.
	for (const double turns : {10.0, 1000.0, 20000.0}) {
		const auto start = delaunayPacking(wound(turns, 30.0), {});
		EXPECT_EQ(start.lengthened.largest, 0.0);
		EXPECT_GE(start.flips.size(), static_cast<std::size_t>(turns) - 1);
		std::vector<double> lengths = start.mesh.lengths.values();
		std::sort(lengths.begin(), lengths.end());
		EXPECT_NEAR(lengths[0], 1.0, 1e-4);
		EXPECT_NEAR(lengths[1], 30.0, 1e-2);
		EXPECT_NEAR(lengths[2], std::hypot(1.0, 30.0), 1e-2);
	}
	for (const double length : {std::nan(""), HUGE_VAL})
		EXPECT_THROW(delaunayPacking({oneVertexTorus(), {1.0, length, 1.0}}, {}), InternalError);
}

/// Any triangulation is Delaunay; rounding must not make another one of it for ever.
TEST(DelaunayPacking, EndsWhereAllVerticesLieOnACircle)
{
	const int n = 1000;
	SurfaceMesh fan;
	for (int i = 0; i < n; ++i)
		fan.positions.push_back({std::cos(2 * kPi * i / n), std::sin(2 * kPi * i / n), 0.0});
	for (int i = 1; i + 1 < n; ++i)
		fan.triangles.push_back({0, i, i + 1});
	const Triangulation t = glued(fan);
	const auto start = delaunayPacking({t, edgeLengths(t, fan)}, {});
	EXPECT_LT(start.flips.size(), std::size_t(150 * t.edgeCount()));
	EXPECT_NEAR(
		euclideanArea(start.mesh.triangulation, start.mesh.lengths),
		0.5 * n * std::sin(2 * kPi / n),
		1e-9);
}

/// Sum of the two sides at the origin of h less the third.
double excessAt(const Triangulation& t, const EdgeArray<double>& lengths, Halfedge h)
{
	const double next = lengths[t.next(h).edge()], own = lengths[h.edge()];
	return (own - next) + lengths[t.previous(h).edge()];
}

/// What mollify() does to lengths: every corner then has the excess it had and twice what its vertex got, and
/// edges what their ends got.
struct Mollified
{
	Triangulation t;
	EdgeArray<double> before, after;
	Lengthening added;

	Mollified(const Triangulation& triangulation, const EdgeArray<double>& lengths) :
			t(triangulation), before(lengths), after(lengths), added(mollify(t, after))
	{
		double largest = 0.0;
		for (const Edge e : t.edges()) {
			EXPECT_EQ(after[e], added.lengthOf(t, e, before[e]));
			largest = std::max(largest, (after[e] - before[e]) / after[e]);
		}
		EXPECT_EQ(added.largest, largest);
		for (const Face f : t.faces())
			for (const Halfedge h : t.halfedges(f)) {
				const double sides = after[h.edge()] + after[t.previous(h).edge()];
				const double excess = excessAt(t, before, h) + 2 * addedAt(t.origin(h));
				EXPECT_NEAR(excessAt(t, after, h), excess, 1e-15 * sides);
				EXPECT_GT(excessAt(t, after, h), 1e-12 * sides);
			}
	}
	explicit Mollified(const SurfaceMesh& mesh) :
			Mollified(glued(mesh), edgeLengths(glued(mesh), mesh))
	{
	}

	double addedAt(Vertex v) const { return added.atVertex.empty() ? 0.0 : added.atVertex[v]; }
};

/// Of one triangle.
Mollified mollified(const std::array<double, 3>& sides)
{
	const Triangulation t(3, {{0, 1, 2}});
	EdgeArray<double> lengths(3);
	for (std::size_t k = 0; k < 3; ++k)
		lengths[t.halfedges(Face(0))[k].edge()] = sides[k];
	return {t, lengths};
}

TEST(Mollify, GivesATriangleTheExcessThatIsMissing)
{
	// Needles: two sides longer than the third by 2e-7, by nothing, and shorter by 1e-3. Both corners at the
	// short side get an excess of 1e-4 of the longest where they have less, the third nothing.
	const auto corners = Triangulation(3, {{0, 1, 2}}).halfedges(Face(0));
	for (const double third : {1.0 - 3e-7, 1.0 - 5e-7, 0.999 - 5e-7}) {
		const Mollified m = mollified({1.0, third, 5e-7});
		EXPECT_NEAR(excessAt(m.t, m.after, corners[0]), std::max(1e-4, 1.0 - third + 5e-7), 1e-15);
		EXPECT_EQ(m.addedAt(m.t.origin(corners[1])), 0.0);
		EXPECT_NEAR(excessAt(m.t, m.after, corners[2]), 1e-4, 1e-15);
	}
	// 1e-5 of the shorter side at a flat corner, however long the others are; no other corner changes.
	for (const double shorter : {0.5, 1e-3, 1e-5})
		for (const double excess : {0.0, -1e-6}) {
			const Mollified m = mollified({1.0, 1.0 - shorter, shorter + excess});
			const double wanted = 1e-5 * std::min(1 - shorter, shorter + excess);
			EXPECT_NEAR(excessAt(m.t, m.after, corners[2]), wanted, 1e-15);
			EXPECT_EQ(m.addedAt(m.t.origin(corners[0])), 0.0);
			EXPECT_EQ(m.addedAt(m.t.origin(corners[1])), 0.0);
		}
}

TEST(Mollify, VerticesAtOnePlaceGetTheSame)
{
	SurfaceMesh mesh = rectangle(12, 12, 1, 1);
	const auto isOne = [](int v) { return v % 13 > 3 && v % 13 < 9 && v / 13 > 3 && v / 13 < 9; };
	for (int v = 0; v < 13 * 13; ++v)
		if (isOne(v))
			mesh.positions[at(v)] = {0.5, 0.5, 0.0};
	const Mollified m(mesh);
	const double there = m.addedAt(Vertex(6 * 13 + 6));
	EXPECT_GT(there, 0.0);
	for (const Vertex v : m.t.vertices())
		EXPECT_TRUE(!isOne(v.number()) || m.addedAt(v) == there);
}

} // namespace
} // namespace ricci::testing
