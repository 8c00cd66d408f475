// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/cones/seamless_metric.h>
#include <ricci/mesh/flow_domain.h>

#include <gtest/gtest.h>

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
	EdgeArray<double> lengths(t.edgeCount(), 1.0);
	for (const Edge e : t.edges()) {
		const Point3& p = surface.positions[t.ends(e)[0]];
		const Point3& q = surface.positions[t.ends(e)[1]];
		const double round = std::atan2(p[1], p[0]) - std::atan2(q[1], q[0]);
		const double rise =
			std::abs(p[2] - q[2]) + std::abs(std::hypot(p[0], p[1]) - std::hypot(q[0], q[1]));
		if (std::abs(std::remainder(round, 2 * kPi)) > 1e-9 && rise > 1e-9)
			lengths[e] = std::sqrt(2.0); // a diagonal
	}
	ASSERT_EQ(3 * std::count(lengths.begin(), lengths.end(), 1.0), 2 * t.edgeCount());
	for (const FaceLoop& loop : homologyLoops(t, false)) {
		const double holonomy = sumOfAngles(turnedCorners(t, loop), anglesOf(t, lengths));
		EXPECT_NEAR(std::remainder(holonomy, 2 * kPi), 0.0, 1e-12);
	}
}

TEST(HolonomyOfALoop, IsThatBeforeIsometricFlips)
{
	// The loops keep their homotopy class off the vertices.
	const EmbeddedSurface surface = surfaceOf(perforatedSlab(2, 3));
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
