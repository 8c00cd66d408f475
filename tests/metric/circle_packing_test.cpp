// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/intrinsic.h"
#include "support/listener.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/error.h>
#include <ricci/metric/circle_packing.h>
#include <ricci/metric/conformal_flip.h>
#include <ricci/metric/euclidean.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

std::vector<SurfaceMesh> surfaces()
{
	Random random(10);
	return {
		tetrahedron(),
		bumpyTorus(12, 8, random),
		randomPlanarDisk(8, random),
		sliverDisk(12, 3.0, random),
		shaken(perforatedSlab(2, 2), 0.05, random)};
}

/// Length of an edge between circles of radii \p gi, \p gj.
double packedLength(double gi, double gj, double delta)
{
	return Euclidean::edge(Euclidean::circle(std::log(gi)), Euclidean::circle(std::log(gj)), delta)
		.length;
}

/// Inversive distance by its definition (Eq. 3), in extended precision.
long double inversiveDistance(const Packed& mesh, Edge e, double factor = 1.0)
{
	const auto [i, j] = mesh.triangulation.ends(e);
	const long double l = mesh.lengths[e];
	const long double gi = factor * mesh.radii[i], gj = factor * mesh.radii[j];
	return (l * l - gi * gi - gj * gj) / (2 * gi * gj);
}

/// How far rounding may let the circles of the radii of paper 4.1 overlap across edge e: a radius
/// is rounded at the size of the sides that it is the difference of.
double overlapByRounding(const Packed& mesh, Edge e)
{
	const Triangulation& t = mesh.triangulation;
	double longest = 0.0;
	for (const Halfedge h : {e.halfedge(), e.halfedge().twin()})
		if (!t.isExterior(h))
			for (const Halfedge side : t.halfedges(t.face(h)))
				longest = std::max(longest, mesh.lengths[side.edge()]);
	return 4 * kEpsilon * longest;
}

TEST(CirclePacking, EdgeLengthsAreDistances)
{
	const SurfaceMesh mesh{{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}};
	const Packed packed(mesh);
	std::vector<double> sorted = packed.lengths.values();
	std::sort(sorted.begin(), sorted.end());
	EXPECT_EQ(sorted, (std::vector<double>{3, 4, 5}));
	// The circles of radii 1, 2, 3 of the 3-4-5 triangle touch one another.
	EXPECT_EQ(packed.radii, (VertexArray<double>{1, 2, 3}));
	for (double delta : packed.packing.delta)
		EXPECT_EQ(delta, 0.0);
}

TEST(CirclePacking, ReproducesTheLengthsOfTheMesh)
{
	for (const SurfaceMesh& mesh : surfaces()) {
		const Packed packed(mesh);
		for (const Edge e : packed.triangulation.edges()) {
			const auto [i, j] = packed.triangulation.ends(e);
			const double length =
				packedLength(packed.radii[i], packed.radii[j], packed.packing.delta[e]);
			EXPECT_NEAR(length / packed.lengths[e], 1.0, 1e-14);
		}
	}
}

TEST(CirclePacking, RadiusIsTheLeastTangentLengthOfTheTrianglesAtTheVertex)
{
	for (const SurfaceMesh& mesh : surfaces()) {
		const Packed packed(mesh);
		VertexArray<long double> least(
			mesh.positions.size(), std::numeric_limits<long double>::infinity());
		for (const Triangle& t : mesh.triangles)
			for (std::size_t k = 0; k < 3; ++k) {
				const auto length = [&](std::size_t a, std::size_t b) -> long double {
					return distance(mesh.positions[at(t[a])], mesh.positions[at(t[b])]);
				};
				const std::size_t j = (k + 1) % 3, m = (k + 2) % 3;
				long double& l = least[Vertex(t[k])];
				l = std::min(l, (length(k, j) + length(m, k) - length(j, m)) / 2);
			}
		for (const Vertex v : least.indices()) {
			// The sum of three lengths is rounded at their own size, not at the radius's.
			EXPECT_NEAR(packed.radii[v], static_cast<double>(least[v]), 4 * kEpsilon * 4.0);
			EXPECT_GT(packed.radii[v], 0.0);
		}
	}
}

TEST(CirclePacking, CirclesOfTheInitialRadiiDoNotOverlap)
{
	for (const SurfaceMesh& mesh : surfaces()) {
		const Packed packed(mesh);
		for (const Edge e : packed.triangulation.edges()) {
			const auto [i, j] = packed.triangulation.ends(e);
			const double gi = packed.radii[i], gj = packed.radii[j];
			const double rounding = overlapByRounding(packed, e);
			EXPECT_LE(gi + gj, packed.lengths[e] + rounding);
			const long double exact = inversiveDistance(packed, e);
			EXPECT_GE(packed.packing.delta[e], 0.0);
			EXPECT_NEAR(
				packed.packing.delta[e],
				static_cast<double>(exact - 1),
				rounding * packed.lengths[e] / (gi * gj));
		}
	}
}

TEST(CirclePacking, ScalesWithTheMesh)
{
	Random random(11);
	const SurfaceMesh mesh = sliverDisk(8, 2.0, random);
	const Packed original(mesh);
	for (double factor : {0x1p-30, 0x1p30}) { // powers of two: exact
		const Packed other(scaled(mesh, factor));
		EXPECT_EQ(other.packing.delta, original.packing.delta);
		for (const Vertex v : original.radii.indices())
			EXPECT_EQ(other.radii[v], factor * original.radii[v]);
	}
}

TEST(CirclePacking, ThurstonClampsTheInversiveDistance)
{
	for (const SurfaceMesh& mesh : surfaces()) {
		const Packed packed(mesh);
		int below = 0, inside = 0;
		// Radii of paper 4.1 make every circle pair tangent; larger ones intersect, then at more
		// than a right angle.
		for (double factor : {1.0, 1.5, 4.0}) {
			VertexArray<double> radii = packed.radii;
			for (double& r : radii)
				r *= factor;
			const EdgeArray<double> delta =
				thurstonDistancesLessOne(packed.triangulation, packed.lengths, radii);
			for (const Edge e : packed.triangulation.edges()) {
				const long double exact = inversiveDistance(packed, e, factor);
				const long double clamped = std::clamp(exact, 0.0L, 1.0L);
				EXPECT_NEAR(1.0 + delta[e], static_cast<double>(clamped), 1e-13);
				below += exact < 0;
				inside += exact > 0 && exact < 1;
				if (factor == 1.0) {
					const auto [i, j] = packed.triangulation.ends(e);
					const double gi = radii[i], gj = radii[j];
					EXPECT_LE(delta[e], 0.0);
					EXPECT_GE(
						delta[e], -overlapByRounding(packed, e) * packed.lengths[e] / (gi * gj));
				}
			}
		}
		EXPECT_GT(below, 0);
		EXPECT_GT(inside, 0);
	}
}

TEST(CirclePacking, ThurstonKeepsLengthsOfIntersectingCircles)
{
	// Equilateral triangle, radii 0.6: I = (1 - 0.72) / 0.72 = 7/18 lies between the clamps.
	const Triangulation t(3, {{0, 1, 2}});
	const EdgeArray<double> delta = thurstonDistancesLessOne(t, {1, 1, 1}, {0.6, 0.6, 0.6});
	for (const Edge e : t.edges()) {
		EXPECT_NEAR(delta[e], 7.0 / 18 - 1, 1e-15);
		EXPECT_NEAR(packedLength(0.6, 0.6, delta[e]), 1.0, 1e-15);
	}
}

std::vector<SurfaceMesh> surfacesToFlip()
{
	Random random(160);
	return {
		bumpyTorus(14, 9, random),
		randomPlanarDisk(10, random),
		sliverDisk(12, 3.0, random),
		shaken(perforatedSlab(2, 3), 0.05, random)};
}

InitialPacking startOf(const Packed& mesh)
{
	return delaunayPacking({mesh.triangulation, mesh.lengths}, {});
}

/// Sides of length 1, and as wound round a torus of this \p height so many \p turns.
EdgeArray<double> woundLengths(double turns, double height)
{
	EdgeArray<double> lengths(3);
	const auto h = oneVertexTorus().halfedges(Face(0));
	lengths[h[0].edge()] = 1.0;
	lengths[h[1].edge()] = std::hypot(turns, height);
	lengths[h[2].edge()] = std::hypot(turns + 1.0, height);
	return lengths;
}

VertexVector curvatureOf(const Triangulation& t, const EdgeArray<double>& lengths)
{
	const Packed packed(t, lengths);
	auto map = packed.map();
	map.evaluate(packed.u());
	EXPECT_EQ(map.brokenTriangles(), 0);
	return map.curvature();
}

TEST(DelaunayPacking, FlippedEdgesInThePlaneAreStraight)
{
	Random random(161);
	const SurfaceMesh mesh = randomPlanarDisk(14, random);
	const Packed packed(mesh);
	const auto start = startOf(packed);
	EXPECT_GT(start.flips.size(), 20u);
	const Triangulation& t = start.mesh.triangulation;
	for (const Edge e : t.edges()) {
		const auto [i, j] = t.ends(e);
		EXPECT_NEAR(
			start.mesh.lengths[e], distance(mesh.positions[at(i)], mesh.positions[at(j)]), 1e-13);
	}
}

TEST(DelaunayPacking, KeepsTheMetricOfTheSurface)
{
	for (const SurfaceMesh& mesh : surfacesToFlip()) {
		const Packed packed(mesh);
		const auto start = startOf(packed);
		EXPECT_GT(start.flips.size(), 0u);
		EXPECT_EQ(start.lengthened.largest, 0.0);
		const VertexVector before = curvatureOf(packed.triangulation, packed.lengths);
		const VertexVector after = curvatureOf(start.mesh.triangulation, start.mesh.lengths);
		EXPECT_LT((before - after).lpNorm<Eigen::Infinity>(), 1e-9);
	}
}

TEST(DelaunayPacking, IsWeightedDelaunayWithDisjointCircles)
{
	// Two independent forms of the test: by heights of power centres in the metric here, by tilts in
	// the conformal class there.
	for (const SurfaceMesh& mesh : surfacesToFlip()) {
		const auto start = startOf(Packed(mesh));
		const Triangulation& t = start.mesh.triangulation;
		VertexArray<double> kappa;
		int good = 0;
		for (double r : start.radii)
			kappa.push_back(1 / r);
		for (const Edge e : t.edges()) {
			EXPECT_GT(start.delta[e], 0.0);
			if (isWeightedDelaunay(t, start.delta, kappa, e)) {
				++good;
				continue;
			}
			// Only where both forms are within rounding of a tie.
			const double delta = flippedDelta(t, start.delta, e);
			const Vertex k = t.apex(e.halfedge()), l = t.apex(e.halfedge().twin());
			EXPECT_NEAR(
				Euclidean::delta(flippedLength(start.mesh, e), start.radii[k], start.radii[l]) /
					delta,
				1.0,
				1e-8);
		}
		// Ties are few.
		EXPECT_GT(10 * good, 9 * t.edgeCount());
	}
}

TEST(DelaunayPacking, FlipsLeadFromTheInputToTheStart)
{
	for (const SurfaceMesh& mesh : surfacesToFlip()) {
		const Packed packed(mesh);
		const auto start = startOf(packed);
		Triangulation t = packed.triangulation;
		for (const Edge e : start.flips)
			t.flip(e);
		for (const Halfedge h : t.halfedges()) {
			ASSERT_EQ(t.next(h), start.mesh.triangulation.next(h));
			ASSERT_EQ(t.origin(h), start.mesh.triangulation.origin(h));
		}
	}
}

TEST(DelaunayPacking, RadiiAgreeAcrossTheMirror)
{
	Random random(162);
	const Packed packed(bumpyTorus(10, 8, random));
	VertexArray<Vertex> mirror;
	for (const Vertex v : packed.triangulation.vertices())
		mirror.push_back(v);
	for (int v = 0; v + 1 < mirror.size(); v += 4)
		std::swap(mirror[Vertex(v)], mirror[Vertex(v + 1)]);
	const auto start = delaunayPacking({packed.triangulation, packed.lengths}, mirror);
	for (const Vertex v : mirror.indices())
		EXPECT_EQ(start.radii[v], start.radii[mirror[v]]);
}

TEST(DelaunayPacking, UnwindsANeedleOfManyTurns)
{
	// A torus of one vertex, 1 by 30, whose triangles are wound round it: every flip takes one turn off,
	// however few edges there are.
	for (const double turns : {10.0, 1000.0, 20000.0}) {
		const Packed wound(oneVertexTorus(), woundLengths(turns, 30.0));
		const auto start = startOf(wound);
		EXPECT_EQ(start.lengthened.largest, 0.0);
		EXPECT_GE(start.flips.size(), static_cast<std::size_t>(turns) - 1);
		std::vector<double> lengths = start.mesh.lengths.values();
		std::sort(lengths.begin(), lengths.end());
		EXPECT_NEAR(lengths[0], 1.0, 1e-4);
		EXPECT_NEAR(lengths[1], 30.0, 1e-2);
		EXPECT_NEAR(lengths[2], std::hypot(1.0, 30.0), 1e-2);
	}
}

TEST(DelaunayPacking, RefusesLengthsThatAreNoNumbers)
{
	for (const double length : {std::nan(""), HUGE_VAL}) {
		EdgeArray<double> lengths(3, 1.0);
		lengths[Edge(1)] = length;
		EXPECT_THROW(delaunayPacking({oneVertexTorus(), lengths}, {}), InternalError);
	}
}

TEST(DelaunayPacking, TicksWhileItFlips)
{
	const IntrinsicMesh wound{oneVertexTorus(), woundLengths(200000.0, 3000.0)};
	Listener ticks;
	const auto start = heard(ticks, [&] { return delaunayPacking(wound, {}); });
	EXPECT_GE(static_cast<std::size_t>(ticks.calls()), start.flips.size() / 65536);
	EXPECT_GE(ticks.calls(), 3);
	for (int last = 0; last < ticks.calls(); ++last) {
		Listener impatient(last + 1);
		EXPECT_THROW(heard(impatient, [&] { delaunayPacking(wound, {}); }), Cancelled);
	}
}

TEST(DelaunayQueue, FlipsThatDoNotEndAreAnError)
{
	Triangulation t = oneVertexTorus();
	DelaunayQueue queue;
	queue.queued.assign(t.edgeCount(), 0);
	std::int64_t flips = 0;
	const auto error = refusalOf<NotConverged>([&] {
		queue.flipFrom(
			Edge(0), t, flips, [](Edge) { return false; }, [&](Edge e) { t.flip(e); });
	});
	EXPECT_EQ(error.problem, NotConverged::FlipsUsedUp);
	EXPECT_EQ(error.count, static_cast<std::size_t>(flips));
	EXPECT_EQ(flips, maxFlips(3));
	EXPECT_EQ(maxFlips(1500000), 1500000000);
}

/// Sum of the two sides at the origin of h less the third.
double excessAt(const Triangulation& t, const EdgeArray<double>& lengths, Halfedge h)
{
	const double next = lengths[t.next(h).edge()], own = lengths[h.edge()];
	return (own - next) + lengths[t.previous(h).edge()];
}

/// That every corner has the excess it had and twice what its vertex got, and edges what their ends got.
void expectAddedAtVertices(
	const Triangulation& t,
	const EdgeArray<double>& before,
	const EdgeArray<double>& after,
	const Lengthening& added)
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
			EXPECT_NEAR(
				excessAt(t, after, h),
				excessAt(t, before, h) + 2 * added.atVertex[t.origin(h)],
				1e-15 * sides);
			EXPECT_GT(excessAt(t, after, h), 1e-12 * sides);
		}
}

EdgeArray<double> sidesOf(const Triangulation& t, const std::array<double, 3>& sides)
{
	EdgeArray<double> lengths(3);
	for (std::size_t k = 0; k < 3; ++k)
		lengths[t.halfedges(Face(0))[k].edge()] = sides[k];
	return lengths;
}

TEST(Mollify, LeavesAValidMeshAlone)
{
	for (const SurfaceMesh& mesh : surfacesToFlip()) {
		const Packed packed(mesh);
		EdgeArray<double> lengths = packed.lengths;
		const Lengthening added = mollify(packed.triangulation, lengths);
		EXPECT_TRUE(added.atVertex.empty());
		EXPECT_EQ(added.largest, 0.0);
		EXPECT_EQ(lengths, packed.lengths);
		EXPECT_EQ(added.lengthOf(packed.triangulation, Edge(3), 2.5), 2.5);
	}
}

TEST(Mollify, GivesANeedleTheExcessThatIsMissing)
{
	// Two sides longer than the third by 2e-7, by nothing, and shorter by 1e-3: both corners at the short
	// side get an excess of 1e-4 of the longest where they have less, the third nothing.
	const Triangulation t(3, {{0, 1, 2}});
	for (const double third : {1.0 - 3e-7, 1.0 - 5e-7, 0.999 - 5e-7}) {
		const EdgeArray<double> before = sidesOf(t, {1.0, third, 5e-7});
		EdgeArray<double> lengths = before;
		const Lengthening added = mollify(t, lengths);
		expectAddedAtVertices(t, before, lengths, added);
		const auto h = t.halfedges(Face(0));
		EXPECT_NEAR(excessAt(t, lengths, h[0]), std::max(1e-4, 1.0 - third + 5e-7), 1e-15);
		EXPECT_EQ(added.atVertex[t.origin(h[1])], 0.0);
		EXPECT_NEAR(excessAt(t, lengths, h[2]), 1e-4, 1e-15);
	}
}

TEST(Mollify, GivesAFlatTriangleTheExcessThatIsMissing)
{
	// 1e-5 of the shorter side at the flat corner, however long the others are; no other corner changes.
	const Triangulation t(3, {{0, 1, 2}});
	for (const double shorter : {0.5, 1e-3, 1e-5})
		for (const double excess : {0.0, -1e-6}) {
			const EdgeArray<double> before = sidesOf(t, {1.0, 1.0 - shorter, shorter + excess});
			EdgeArray<double> lengths = before;
			const Lengthening added = mollify(t, lengths);
			expectAddedAtVertices(t, before, lengths, added);
			const auto h = t.halfedges(Face(0));
			EXPECT_NEAR(
				excessAt(t, lengths, h[2]), 1e-5 * std::min(1 - shorter, shorter + excess), 1e-15);
			EXPECT_EQ(added.atVertex[t.origin(h[0])], 0.0);
			EXPECT_EQ(added.atVertex[t.origin(h[1])], 0.0);
		}
}

TEST(Mollify, GivesDegenerateTrianglesAnArea)
{
	SurfaceMesh mesh = rectangle(8, 8, 1, 1);
	mesh.positions[12] = mesh.positions[13];   // an edge without length
	mesh.positions[40] = {0.4375, 0.375, 0.0}; // a face folded into a line
	const Triangulation t = glued(mesh);
	const auto original = edgeLengths(t, mesh);
	auto lengths = original;
	const Lengthening added = mollify(t, lengths);
	EXPECT_EQ(added.largest, 1.0);
	expectAddedAtVertices(t, original, lengths, added);
	// Only at degenerate faces.
	VertexArray<char> isNear(t.vertexCount(), 0);
	for (const Face f : t.faces()) {
		const auto [a, b, c] = t.vertices(f);
		const Point3& p = mesh.positions[at(a)];
		if (length(cross(mesh.positions[at(b)] - p, mesh.positions[at(c)] - p)) < 1e-12)
			for (const Vertex v : t.vertices(f))
				isNear[v] = 1;
	}
	for (const Vertex v : t.vertices())
		EXPECT_TRUE(isNear[v] || added.atVertex[v] == 0.0) << v.number();
}

TEST(Mollify, VerticesAtOnePlaceGetTheSame)
{
	SurfaceMesh mesh = rectangle(12, 12, 1, 1);
	const auto isOne = [](int v) { return v % 13 > 3 && v % 13 < 9 && v / 13 > 3 && v / 13 < 9; };
	for (int v = 0; v < 13 * 13; ++v)
		if (isOne(v))
			mesh.positions[at(v)] = {0.5, 0.5, 0.0};
	const Triangulation t = glued(mesh);
	const auto original = edgeLengths(t, mesh);
	auto lengths = original;
	const Lengthening added = mollify(t, lengths);
	expectAddedAtVertices(t, original, lengths, added);
	EXPECT_GT(added.atVertex[Vertex(6 * 13 + 6)], 0.0);
	for (const Vertex v : t.vertices())
		if (isOne(v.number())) {
			EXPECT_EQ(added.atVertex[v], added.atVertex[Vertex(6 * 13 + 6)]);
		}
}

TEST(Mollify, KeepsTheAnglesAwayFromALongDegenerateFace)
{
	// Cells of 0.02 by 0.001, and at a corner a needle and a flat triangle 1000 long.
	const SurfaceMesh mesh =
		withFlatTail(rectangle(50, 50, 1, 0.05), 51 * 51 - 2, 51 * 51 - 1, 1000.0);
	const Triangulation t = glued(mesh);
	const auto original = edgeLengths(t, mesh);
	auto lengths = original;
	const Lengthening added = mollify(t, lengths);
	expectAddedAtVertices(t, original, lengths, added);
	int touched = 0;
	for (const Vertex v : t.vertices())
		touched += added.atVertex[v] > 0.0;
	EXPECT_LE(touched, 4);
	EXPECT_GE(touched, 1);
}

} // namespace
} // namespace ricci::testing
