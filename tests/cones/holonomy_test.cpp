// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/shapes.h"

#include <ricci/cones/seamless_metric.h>
#include <ricci/mesh/component.h>

#include <gtest/gtest.h>

namespace ricci::testing {
namespace {

EmbeddedSurface domainOf(const SurfaceMesh& mesh)
{
	return flowDomain(onlyComponent(mesh), Holes::Boundaries).surface;
}

/// Angles by the law of cosines.
HalfedgeArray<double> anglesOf(const Triangulation& t, const EdgeArray<double>& lengths)
{
	HalfedgeArray<double> angles(t.halfedgeCount(), 0.0);
	for (const Halfedge h : t.interiorHalfedges()) {
		const double a = lengths[t.next(h).edge()], b = lengths[h.edge()];
		const double c = lengths[t.previous(h).edge()];
		angles[h] = std::acos((b * b + c * c - a * a) / (2 * b * c));
	}
	return angles;
}

TEST(HolonomyOfALoop, IsThatBeforeIsometricFlips)
{
	// The loops keep their homotopy class off the vertices.
	const EmbeddedSurface surface = domainOf(perforatedSlab(2, 3));
	IntrinsicMesh mesh{surface.triangulation, surface.lengths};
	std::vector<FaceLoop> loops = homologyLoops(mesh.triangulation, false);
	const auto holonomies = [&] {
		std::vector<double> found;
		for (const FaceLoop& loop : loops)
			found.push_back(sumOfAngles(
				turnedCorners(mesh.triangulation, loop),
				anglesOf(mesh.triangulation, mesh.lengths)));
		return found;
	};
	const std::vector<double> before = holonomies();
	Random random(7);
	IntrinsicMesh flipped = mesh;
	const std::vector<Edge> flips = flipIsometrically(flipped, 2000, random);
	EXPECT_GT(flips.size(), 100u);
	for (const Edge e : flips)
		flip(mesh.triangulation, loops, e);
	mesh.lengths = flipped.lengths;
	for (std::size_t i = 0; i < loops.size(); ++i)
		EXPECT_NEAR(holonomies()[i], before[i], 1e-9);
}

TEST(SumOfAngles, HasTheDerivativeOfDifferences)
{
	const EmbeddedSurface surface = domainOf(perforatedSlab(1, 2));
	const Triangulation& t = surface.triangulation;
	Random random(3);
	HalfedgeArray<double> weights(t.halfedgeCount(), 0.0);
	for (const Halfedge h : t.interiorHalfedges())
		weights[h] = random.real(-1, 1);
	EdgeArray<double> lengths = surface.lengths;
	const EdgeArray<double> derivative = derivativeByLengths(t, weights, anglesOf(t, lengths));
	const double step = 1e-5;
	for (const Edge e : t.edges()) {
		const double l = lengths[e];
		lengths[e] = l * std::exp(step);
		const double above = sumOfAngles(weights, anglesOf(t, lengths));
		lengths[e] = l * std::exp(-step);
		const double below = sumOfAngles(weights, anglesOf(t, lengths));
		lengths[e] = l;
		EXPECT_NEAR(derivative[e], (above - below) / (2 * step), 1e-8);
	}
}

} // namespace
} // namespace ricci::testing
