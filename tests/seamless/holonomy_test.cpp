// SPDX-License-Identifier: GPL-3.0-or-later
#include "../support/intrinsic.h"
#include "../support/random.h"
#include "../support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/seamless/holonomy.h>
#include <ricci/surface/flow_domain.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

namespace ricci::testing {
namespace {

EmbeddedSurface surfaceOf(const SurfaceMesh& mesh)
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

TEST(HomologyLoops, AreTwoForEachHandleAndOneForEachFurtherHole)
{
	for (int genus = 0; genus <= 3; ++genus) {
		const SurfaceMesh closed = perforatedSlab(genus, 6);
		const SurfaceMesh open = withoutStars(closed, {0, 100, 200});
		const Triangulation &t = surfaceOf(closed).triangulation,
							&o = surfaceOf(open).triangulation;
		const std::size_t holes = o.boundaryLoops().size();
		ASSERT_GT(holes, 1u);
		EXPECT_EQ(homologyLoops(t, true).size(), at(2 * genus));
		EXPECT_EQ(homologyLoops(o, false).size(), at(2 * genus));
		EXPECT_EQ(homologyLoops(o, true).size(), at(2 * genus) + holes - 1);
		for (const FaceLoop& loop : homologyLoops(o, true))
			for (std::size_t i = 0; i < loop.size(); ++i) {
				const Face next = o.face(loop[(i + 1) % loop.size()]);
				EXPECT_TRUE(next.isValid());
				EXPECT_EQ(o.face(loop[i].twin()), next);
			}
	}
}

TEST(HolonomyOfALoop, IsZeroOnAFlatTorus)
{
	// The torus as a grid of squares, whatever its image in space.
	const EmbeddedSurface surface = surfaceOf(torus(3, 1, 9, 7));
	const Triangulation& t = surface.triangulation;
	const auto gridDistance = [](double angle, double other, int places) {
		const double apart = std::remainder(angle - other, 2 * kPi) * places / (2 * kPi);
		return std::round(std::abs(apart));
	};
	EdgeArray<double> lengths(t.edgeCount(), 1.0);
	for (const Edge e : t.edges()) {
		const auto [i, j] = t.ends(e);
		const Point3 &p = surface.positions[i], &q = surface.positions[j];
		const auto round = [](const Point3& a) { return std::atan2(a[1], a[0]); };
		const auto across = [](const Point3& a) {
			return std::atan2(a[2], std::hypot(a[0], a[1]) - 3.0);
		};
		lengths[e] =
			std::hypot(gridDistance(round(p), round(q), 9), gridDistance(across(p), across(q), 7));
	}
	for (const FaceLoop& loop : homologyLoops(t, false))
		EXPECT_NEAR(
			std::remainder(sumOfAngles(turnedCorners(t, loop), anglesOf(t, lengths)), 2 * kPi),
			0.0,
			1e-12);
}

TEST(HolonomyOfALoop, IsThatBeforeIsometricFlips)
{
	// The loops keep their homotopy class off the vertices.
	EmbeddedSurface surface = surfaceOf(perforatedSlab(2, 3));
	Triangulation t = surface.triangulation;
	EdgeArray<double> lengths = surface.lengths;
	std::vector<FaceLoop> loops = homologyLoops(t, false);
	std::vector<double> holonomies;
	for (const FaceLoop& loop : loops)
		holonomies.push_back(sumOfAngles(turnedCorners(t, loop), anglesOf(t, lengths)));
	Random random(7);
	int flips = 0;
	for (int trial = 0; trial < 2000; ++trial) {
		const Edge e(random.index(t.edgeCount()));
		if (!t.isFlippable(e))
			continue;
		const HalfedgeArray<double> angles = anglesOf(t, lengths);
		const Halfedge h = e.halfedge(), g = h.twin();
		const double atOrigin = angles[h] + angles[t.next(g)];
		const double atTarget = angles[t.next(h)] + angles[g];
		if (!(atOrigin < kPi - 0.1 && atTarget < kPi - 0.1))
			continue;
		const double a = lengths[t.previous(h).edge()], b = lengths[t.next(g).edge()];
		lengths[e] = std::sqrt(a * a + b * b - 2 * a * b * std::cos(atOrigin));
		flip(t, loops, e);
		++flips;
	}
	EXPECT_GT(flips, 100);
	for (std::size_t i = 0; i < loops.size(); ++i)
		EXPECT_NEAR(
			sumOfAngles(turnedCorners(t, loops[i]), anglesOf(t, lengths)), holonomies[i], 1e-9);
}

TEST(SumOfAngles, HasTheDerivativeOfDifferences)
{
	const EmbeddedSurface surface = surfaceOf(perforatedSlab(1, 2));
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
