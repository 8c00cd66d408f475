// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/listener.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/error.h>
#include <ricci/metric/conformal_flip.h>
#include <ricci/metric/delaunay_queue.h>
#include <ricci/metric/initial_packing.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

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
	for (const SurfaceMesh& mesh : surfaces()) {
		const Packed packed(mesh);
		const auto start = startOf(packed);
		EXPECT_GT(start.flips.size(), 0u);
		EXPECT_EQ(start.lengthened, 0.0);
		const VertexVector before = curvatureOf(packed.triangulation, packed.lengths);
		const VertexVector after = curvatureOf(start.mesh.triangulation, start.mesh.lengths);
		EXPECT_LT((before - after).lpNorm<Eigen::Infinity>(), 1e-9);
	}
}

TEST(DelaunayPacking, IsWeightedDelaunayWithDisjointCircles)
{
	// Two independent forms of the test: by heights of power centres in the metric here, by tilts in
	// the conformal class there.
	for (const SurfaceMesh& mesh : surfaces()) {
		const auto start = startOf(Packed(mesh));
		const auto packing =
			inversiveDistancePacking(start.mesh.triangulation, start.mesh.lengths, start.radii);
		VertexArray<double> kappa;
		int good = 0;
		for (double r : start.radii)
			kappa.push_back(1 / r);
		for (const Edge e : packing.triangulation.edges()) {
			EXPECT_GT(packing.delta[e], 0.0);
			if (isWeightedDelaunay(packing.triangulation, packing.delta, kappa, e)) {
				++good;
				continue;
			}
			// Only where both forms are within rounding of a tie.
			Triangulation t = packing.triangulation;
			const double delta = flippedDelta(t, packing.delta, e);
			const Vertex k = t.apex(e.halfedge()), l = t.apex(e.halfedge().twin());
			EXPECT_NEAR(
				Euclidean::delta(flippedLength(start.mesh, e), start.radii[k], start.radii[l]) /
					delta,
				1.0,
				1e-8);
		}
		// Ties are few.
		EXPECT_GT(10 * good, 9 * packing.triangulation.edgeCount());
	}
}

TEST(DelaunayPacking, FlipsLeadFromTheInputToTheStart)
{
	for (const SurfaceMesh& mesh : surfaces()) {
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
		EXPECT_EQ(start.lengthened, 0.0);
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
	try {
		queue.flipFrom(
			Edge(0), t, flips, [](Edge) { return false; }, [&](Edge e) { t.flip(e); });
		ADD_FAILURE() << "ended after " << flips;
	}
	catch (const NotConverged& error) {
		EXPECT_EQ(error.problem, NotConverged::FlipsUsedUp);
		EXPECT_EQ(error.count, static_cast<std::size_t>(flips));
		EXPECT_EQ(flips, maxFlips(3));
	}
	EXPECT_EQ(maxFlips(1500000), 1500000000);
}

TEST(Mollify, LeavesASoundMeshAlone)
{
	for (const SurfaceMesh& mesh : surfaces()) {
		const Packed packed(mesh);
		EdgeArray<double> lengths = packed.lengths;
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
		EdgeArray<double> lengths(3);
		const auto h = t.halfedges(Face(0));
		lengths[h[0].edge()] = 1.0;
		lengths[h[1].edge()] = third;
		lengths[h[2].edge()] = 5e-7;
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
	const Triangulation t = glued(mesh);
	const auto original = edgeLengths(t, mesh);
	auto lengths = original;
	const double added = mollify(t, lengths);
	EXPECT_GT(added, 0.0);
	EXPECT_LT(added, 1e-3);
	for (const Edge e : t.edges())
		EXPECT_NEAR(lengths[e] - original[e], added, 1e-15);
	for (const Face f : t.faces()) {
		double sum = 0.0, longest = 0.0;
		for (const Halfedge h : t.halfedges(f)) {
			sum += lengths[h.edge()];
			longest = std::max(longest, lengths[h.edge()]);
		}
		EXPECT_GT(sum - 2 * longest, 0.0);
	}
}

} // namespace
} // namespace ricci::testing
