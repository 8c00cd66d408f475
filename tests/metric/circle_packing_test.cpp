// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/metric/circle_packing.h>
#include <ricci/metric/euclidean.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

} // namespace
} // namespace ricci::testing
