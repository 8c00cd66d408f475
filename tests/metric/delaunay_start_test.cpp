// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/metric/conformal_flip.h>
#include <ricci/metric/delaunay_start.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ricci::testing {
namespace {

std::vector<SurfaceMesh> surfaces()
{
	Random random(160);
	return {
		bumpyTorus(14, 9, random),
		randomPlanarDisk(10, random),
		sliverDisk(12, 3.0, random),
		shaken(perforatedSlab(2, 3), 0.05, random)};
}

DelaunayStart startOf(const Packed& mesh)
{
	return delaunayStart({mesh.triangulation, mesh.lengths}, {});
}

Eigen::VectorXd curvatureOf(const Triangulation& t, const std::vector<double>& lengths)
{
	const Packed packed(t, lengths);
	auto map = packed.map();
	map.evaluate(packed.u());
	EXPECT_EQ(map.brokenTriangles(), 0);
	return map.curvature();
}

TEST(DelaunayStart, FlippedEdgesInThePlaneAreStraight)
{
	Random random(161);
	const SurfaceMesh mesh = randomPlanarDisk(14, random);
	const Packed packed(mesh);
	const auto start = startOf(packed);
	EXPECT_GT(start.flips.size(), 20u);
	const Triangulation& t = start.mesh.triangulation;
	for (int e = 0; e < t.edgeCount(); ++e)
		EXPECT_NEAR(
			start.mesh.lengths[at(e)],
			distance(mesh.positions[at(t.origin(2 * e))], mesh.positions[at(t.target(2 * e))]),
			1e-13);
}

TEST(DelaunayStart, KeepsTheMetricOfTheSurface)
{
	for (const SurfaceMesh& mesh : surfaces()) {
		const Packed packed(mesh);
		const auto start = startOf(packed);
		EXPECT_GT(start.flips.size(), 0u);
		EXPECT_EQ(start.lengthened, 0.0);
		const Eigen::VectorXd before = curvatureOf(packed.triangulation, packed.lengths);
		const Eigen::VectorXd after = curvatureOf(start.mesh.triangulation, start.mesh.lengths);
		EXPECT_LT((before - after).lpNorm<Eigen::Infinity>(), 1e-9);
	}
}

TEST(DelaunayStart, IsWeightedDelaunayWithDisjointCircles)
{
	// Two independent forms of the test: by heights of power centres in the metric here, by tilts in
	// the conformal class there.
	for (const SurfaceMesh& mesh : surfaces()) {
		const auto start = startOf(Packed(mesh));
		const auto packing =
			inversiveDistancePacking(start.mesh.triangulation, start.mesh.lengths, start.radii);
		std::vector<double> kappa;
		for (double r : start.radii)
			kappa.push_back(1 / r);
		for (int e = 0; e < packing.triangulation.edgeCount(); ++e) {
			EXPECT_GT(packing.delta[at(e)], 0.0);
			if (isWeightedDelaunay(packing.triangulation, packing.delta, kappa, e))
				continue;
			// Only where both forms are within rounding of a tie.
			Triangulation t = packing.triangulation;
			const double delta = flippedDelta(t, packing.delta, e);
			const int k = t.origin(t.previous(2 * e)), l = t.origin(t.previous(2 * e + 1));
			EXPECT_NEAR(
				Euclidean::delta(
					flippedLength(start.mesh, e), start.radii[at(k)], start.radii[at(l)]) /
					delta,
				1.0,
				1e-8);
		}
	}
}

TEST(DelaunayStart, FlipsLeadFromTheInputToTheStart)
{
	for (const SurfaceMesh& mesh : surfaces()) {
		const Packed packed(mesh);
		const auto start = startOf(packed);
		Triangulation t = packed.triangulation;
		for (int e : start.flips)
			t.flip(e);
		for (int h = 0; h < t.halfedgeCount(); ++h) {
			ASSERT_EQ(t.next(h), start.mesh.triangulation.next(h));
			ASSERT_EQ(t.origin(h), start.mesh.triangulation.origin(h));
		}
	}
}

TEST(DelaunayStart, RadiiAgreeAcrossTheMirror)
{
	Random random(162);
	const Packed packed(bumpyTorus(10, 8, random));
	std::vector<int> mirror(packed.radii.size());
	std::iota(mirror.begin(), mirror.end(), 0);
	for (std::size_t v = 0; v + 1 < mirror.size(); v += 4)
		std::swap(mirror[v], mirror[v + 1]);
	const auto start = delaunayStart({packed.triangulation, packed.lengths}, mirror);
	for (std::size_t v = 0; v < mirror.size(); ++v)
		EXPECT_EQ(start.radii[v], start.radii[at(mirror[v])]);
}

TEST(Mollify, LeavesASoundMeshAlone)
{
	for (const SurfaceMesh& mesh : surfaces()) {
		const Packed packed(mesh);
		std::vector<double> lengths = packed.lengths;
		EXPECT_EQ(mollify(packed.triangulation, lengths), 0.0);
		EXPECT_EQ(lengths, packed.lengths);
	}
}

TEST(Mollify, GivesJustTheExcessThatIsMissing)
{
	// A needle whose two sides are longer than the third by 2e-7, one without excess, and one that
	// misses the triangle inequality by 1e-3.
	const Triangulation t(3, {{0, 1, 2}});
	for (double third : {1.0 - 3e-7, 1.0 - 5e-7, 0.999 - 5e-7}) {
		std::vector<double> lengths(3);
		for (int k = 0; k < 3; ++k)
			lengths[at(Triangulation::edge(t.halfedges(0)[at(k)]))] = k == 0   ? 1.0
																	  : k == 1 ? third
																			   : 5e-7;
		const double excess = third + 5e-7 - 1.0;
		EXPECT_NEAR(mollify(t, lengths), 1e-5 - excess, 1e-15);
		double sum = 0.0;
		for (double l : lengths)
			sum += l;
		EXPECT_NEAR(sum - 2 * *std::max_element(lengths.begin(), lengths.end()), 1e-5, 1e-15);
	}
}

TEST(Mollify, GivesDegenerateTrianglesAnArea)
{
	Random random(163);
	SurfaceMesh mesh = rectangle(8, 8, 1, 1);
	mesh.positions[12] = mesh.positions[13]; // an edge without length
	mesh.positions[40] = {0.5, 0.5, 0.0};    // faces folded into a line or over each other
	const Triangulation t(static_cast<int>(mesh.positions.size()), mesh.triangles);
	const auto original = edgeLengths(t, mesh.positions);
	auto lengths = original;
	const double added = mollify(t, lengths);
	EXPECT_GT(added, 0.0);
	EXPECT_LT(added, 1e-3);
	for (std::size_t e = 0; e < lengths.size(); ++e)
		EXPECT_NEAR(lengths[e] - original[e], added, 1e-15);
	for (int f = 0; f < t.faceCount(); ++f) {
		double sum = 0.0, longest = 0.0;
		for (int h : t.halfedges(f)) {
			sum += lengths[at(Triangulation::edge(h))];
			longest = std::max(longest, lengths[at(Triangulation::edge(h))]);
		}
		EXPECT_GT(sum - 2 * longest, 0.0);
	}
}

} // namespace
} // namespace ricci::testing
