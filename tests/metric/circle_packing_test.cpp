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

/// Length of edge e in the packing metric.
double packedLength(const CirclePacking& p, int e)
{
	const Triangulation& t = p.triangulation;
	return Euclidean::edge(
			   Euclidean::circle(p.u[at(t.origin(2 * e))]),
			   Euclidean::circle(p.u[at(t.target(2 * e))]),
			   p.delta[at(e)])
		.length;
}

/// Inversive distance by its definition (Eq. 3), in extended precision.
long double inversiveDistance(const Packed& mesh, int e, double factor = 1.0)
{
	const Triangulation& t = mesh.triangulation;
	const long double l = mesh.lengths[at(e)];
	const long double gi = factor * mesh.radii[at(t.origin(2 * e))];
	const long double gj = factor * mesh.radii[at(t.target(2 * e))];
	return (l * l - gi * gi - gj * gj) / (2 * gi * gj);
}

/// How far rounding may let the circles of the radii of paper 4.1 overlap across edge e: a radius
/// is rounded at the size of the sides that it is the difference of.
double overlapByRounding(const Packed& mesh, int e)
{
	const Triangulation& t = mesh.triangulation;
	double longest = 0.0;
	for (int h : {2 * e, 2 * e + 1})
		if (!t.isOuter(h))
			for (int side : t.halfedges(t.face(h)))
				longest = std::max(longest, mesh.lengths[at(Triangulation::edge(side))]);
	return 4 * kEpsilon * longest;
}

TEST(CirclePacking, EdgeLengthsAreDistances)
{
	const SurfaceMesh mesh{{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}};
	const Packed packed(mesh);
	std::vector<double> sorted = packed.lengths;
	std::sort(sorted.begin(), sorted.end());
	EXPECT_EQ(sorted, (std::vector<double>{3, 4, 5}));
	// The circles of radii 1, 2, 3 of the 3-4-5 triangle touch one another.
	EXPECT_EQ(packed.radii, (std::vector<double>{1, 2, 3}));
	for (double delta : packed.packing.delta)
		EXPECT_EQ(delta, 0.0);
}

TEST(CirclePacking, ReproducesTheLengthsOfTheMesh)
{
	for (const SurfaceMesh& mesh : surfaces()) {
		const Packed packed(mesh);
		for (int e = 0; e < packed.triangulation.edgeCount(); ++e)
			EXPECT_NEAR(packedLength(packed.packing, e) / packed.lengths[at(e)], 1.0, 1e-14);
	}
}

TEST(CirclePacking, RadiusIsTheLeastTangentLengthOfTheTrianglesAtTheVertex)
{
	for (const SurfaceMesh& mesh : surfaces()) {
		const Packed packed(mesh);
		std::vector<long double> least(
			mesh.positions.size(), std::numeric_limits<long double>::infinity());
		for (const Triangle& t : mesh.triangles)
			for (std::size_t k = 0; k < 3; ++k) {
				const auto length = [&](std::size_t a, std::size_t b) -> long double {
					return distance(mesh.positions[at(t[a])], mesh.positions[at(t[b])]);
				};
				const std::size_t j = (k + 1) % 3, m = (k + 2) % 3;
				long double& l = least[at(t[k])];
				l = std::min(l, (length(k, j) + length(m, k) - length(j, m)) / 2);
			}
		for (std::size_t v = 0; v < least.size(); ++v) {
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
		for (int e = 0; e < packed.triangulation.edgeCount(); ++e) {
			const Triangulation& t = packed.triangulation;
			const double gi = packed.radii[at(t.origin(2 * e))];
			const double gj = packed.radii[at(t.target(2 * e))];
			const double rounding = overlapByRounding(packed, e);
			EXPECT_LE(gi + gj, packed.lengths[at(e)] + rounding);
			const long double exact = inversiveDistance(packed, e);
			EXPECT_GE(packed.packing.delta[at(e)], 0.0);
			EXPECT_NEAR(
				packed.packing.delta[at(e)],
				static_cast<double>(exact - 1),
				rounding * packed.lengths[at(e)] / (gi * gj));
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
		for (std::size_t v = 0; v < original.radii.size(); ++v)
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
			std::vector<double> radii = packed.radii;
			for (double& r : radii)
				r *= factor;
			const CirclePacking thurston =
				thurstonPacking(packed.triangulation, packed.lengths, radii);
			for (int e = 0; e < packed.triangulation.edgeCount(); ++e) {
				const long double exact = inversiveDistance(packed, e, factor);
				const long double clamped = std::clamp(exact, 0.0L, 1.0L);
				EXPECT_NEAR(1.0 + thurston.delta[at(e)], static_cast<double>(clamped), 1e-13);
				below += exact < 0;
				inside += exact > 0 && exact < 1;
				if (factor == 1.0) {
					const Triangulation& t = packed.triangulation;
					const double gi = radii[at(t.origin(2 * e))], gj = radii[at(t.target(2 * e))];
					EXPECT_LE(thurston.delta[at(e)], 0.0);
					EXPECT_GE(
						thurston.delta[at(e)],
						-overlapByRounding(packed, e) * packed.lengths[at(e)] / (gi * gj));
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
	const CirclePacking packing = thurstonPacking(t, {1, 1, 1}, {0.6, 0.6, 0.6});
	for (int e = 0; e < 3; ++e) {
		EXPECT_NEAR(packing.delta[at(e)], 7.0 / 18 - 1, 1e-15);
		EXPECT_NEAR(packedLength(packing, e), 1.0, 1e-15);
	}
}

} // namespace
} // namespace ricci::testing
