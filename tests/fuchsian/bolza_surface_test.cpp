// SPDX-License-Identifier: GPL-3.0-or-later
// A surface of genus 2 whose uniformization is known: flow, layout, group and tiling against closed
// forms.
#include "support/bolza.h"
#include "support/flipped_flow.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/fuchsian/fuchsian_group.h>
#include <ricci/fuchsian/tiling.h>
#include <ricci/layout/hyperbolic_layout.h>
#include <ricci/metric/area.h>
#include <ricci/metric/circle_packing.h>
#include <ricci/metric/hyperbolic.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

FuchsianGroup groupOf(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const CutGraph& cut,
	const HyperbolicLayout& layout)
{
	EdgeArray<SidePairing> pairing(t.edgeCount());
	for (const Edge e : t.edges())
		if (cut.isCut[e])
			offerPairing(layout, lengths[e], e.halfedge(), e.halfedge().twin(), pairing[e]);
	const VertexArray<char> cones(t.vertexCount(), 0);
	return fuchsianGroup(t, cut, pairingOfArcs(t, cut, pairing, cones), cones, true);
}

/// The surface's own metric laid out in its octagon.
struct KnownLayout
{
	BolzaSurface surface;
	HyperbolicLayout layout;
	FuchsianGroup group;

	explicit KnownLayout(int levels) : surface(levels)
	{
		const Triangulation& t = surface.triangulation;
		layout = layOutInDisk(t, surface.lengths, surface.angles, surface.cut.isCut);
		group = groupOf(t, surface.lengths, surface.cut, layout);
	}
};

/// The group that the flow finds from another metric on the surface.
FuchsianGroup groupOfFlow(const IntrinsicMesh& metric)
{
	const FlippedFlow flow(metric, hyperbolicMetric(), 1e-13);
	const CurvatureMap& found = *flow.result.metric;
	const Triangulation& t = found.triangulation();
	// The cut runs on the triangles of the result: the surface has no places in space.
	const CutGraph cut = cutToDisk(t, found.lengths(), VertexArray<char>(t.vertexCount(), 0));
	const HyperbolicLayout layout = layOutInDisk(t, found.lengths(), found.angles(), cut.isCut);
	return groupOf(t, found.lengths(), cut, layout);
}

/// Least |trace| of an isometry along an axis, among the copies of the domain in a few rings.
double minTrace(const FuchsianGroup& group)
{
	double least = std::numeric_limits<double>::infinity();
	for (const DiskIsometry& m : tiling(group.sides, 3, 20000).deck)
		if (m.distanceFromIdentity() > 1e-3)
			least = std::min(least, std::abs(m.trace()));
	return least;
}

TEST(BolzaSurface, IsSmoothAndHasTheAreaOfGenusTwo)
{
	for (int levels : {0, 1, 3}) {
		const BolzaSurface surface(levels);
		const Triangulation& t = surface.triangulation;
		EXPECT_EQ(t.eulerCharacteristic(), -2);
		EXPECT_TRUE(t.boundaryLoops().empty());
		EXPECT_EQ(t.faceCount(), 8 << (2 * levels));
		EXPECT_EQ(surface.cut.edgeCount, 4 << levels);
		EXPECT_EQ(surface.cut.generators.size(), 4u);
		const HyperbolicMeasure measure(t, surface.lengths);
		for (long double K : measure.curvature)
			EXPECT_NEAR(static_cast<double>(K), 0.0, 1e-12);
		EXPECT_NEAR(hyperbolicArea(t, surface.lengths), 4 * kPi, 1e-11);
		// Both sides of every edge say the same.
		for (const Edge e : t.edges()) {
			const Halfedge h = e.halfedge().twin();
			EXPECT_NEAR(
				static_cast<double>(distanceInDisk(surface.place[h], surface.place[t.next(h)])),
				surface.lengths[e],
				1e-14);
		}
	}
}

TEST(BolzaSurface, IsLaidOutInItsOctagon)
{
	for (int levels : {1, 3}) {
		const KnownLayout known(levels);
		const Triangulation& t = known.surface.triangulation;
		// Eight-fold symmetry puts the middle at the centre. One turn is free.
		std::complex<double> turn = 0.0;
		for (const Halfedge h : t.halfedges()) {
			const auto wanted = std::complex<double>(known.surface.place[h]);
			const auto found = known.layout[h];
			if (turn == 0.0 && std::abs(wanted) > 0.1)
				turn = found / wanted / std::abs(found / wanted);
		}
		for (const Halfedge h : t.halfedges())
			EXPECT_LT(
				std::abs(known.layout[h] - turn * std::complex<double>(known.surface.place[h])),
				1e-13);
	}
}

TEST(BolzaSurface, SidesAreGluedByTranslationsOfTheTraceOfTheShortestGeodesic)
{
	for (int levels : {0, 1, 3}) {
		const KnownLayout known(levels);
		ASSERT_EQ(known.group.sides.size(), 8u);
		for (const DiskIsometry& side : known.group.sides) {
			EXPECT_NEAR(std::abs(side.trace()), 2 * BolzaSurface::halfTrace(), 1e-12);
			// The axis goes through the centre.
			EXPECT_NEAR(side.displacement(), 2 * BolzaSurface::inradius(), 1e-12);
		}
		EXPECT_EQ(known.group.handles.size(), 4u);
		EXPECT_TRUE(known.group.peripheral.empty());
		EXPECT_LT(known.group.polygonError, 1e-11);
		EXPECT_LT(known.group.closingError, 1e-12);
		EXPECT_LT(known.group.relationError, 1e-11);
		for (const DiskIsometry& g : known.group.handles)
			EXPECT_GT(std::abs(g.trace()), 2 * BolzaSurface::halfTrace() - 1e-9);
	}
}

/// Every number is that of reduced words of a length in the group with eight generators and one
/// relation of eight letters: 8 * 7^(n - 1), until the tiles opposite at a corner (4 letters) meet.
TEST(BolzaSurface, TilingHasEveryCopyOfTheOctagonOnce)
{
	const KnownLayout known(1);
	const Tiling tiles = tiling(known.group.sides, 3, 100000);
	EXPECT_TRUE(tiles.complete);
	std::vector<int> inRing(4, 0);
	for (int ring : tiles.ring)
		++inRing[at(ring)];
	EXPECT_EQ(inRing, (std::vector<int>{1, 8, 56, 392}));
	EXPECT_EQ(tiles.deck.front().distanceFromIdentity(), 0.0);
	// Octagons do not overlap: their centres are two inradii apart, and neighbours exactly so.
	const double least = 2 * std::sinh(BolzaSurface::inradius());
	for (std::size_t i = 0; i < tiles.deck.size(); ++i) {
		double nearest = std::numeric_limits<double>::infinity();
		for (std::size_t j = 0; j < tiles.deck.size(); ++j)
			if (i != j)
				nearest =
					std::min(nearest, 2 * std::abs((tiles.deck[i].inverse() * tiles.deck[j]).b));
		EXPECT_NEAR(nearest, least, 1e-8);
	}
	const Tiling few = tiling(known.group.sides, 3, 20);
	EXPECT_FALSE(few.complete);
	EXPECT_EQ(few.deck.size(), 20u);
	// Far rings are too small to be seen.
	EXPECT_FALSE(tiling(known.group.sides, 5, 1000).complete);
	EXPECT_EQ(tiling(known.group.sides, 0, 1000).deck.size(), 1u);
}

TEST(BolzaSurface, EveryTraceIsAnIntegerOfTheFieldOfTheSquareRootOfTwo)
{
	const KnownLayout known(1);
	std::vector<double> halves;
	for (const DiskIsometry& m : tiling(known.group.sides, 3, 100000).deck) {
		const double half = 0.5 * std::abs(m.trace());
		if (m.distanceFromIdentity() < 1e-3 || half > 40.0)
			continue;
		halves.push_back(half);
		double nearest = 1.0;
		for (int n = 0; n < 60; ++n) {
			const double rest = half - n * std::sqrt(2.0);
			const double m0 = 2 * std::round((rest - 1) / 2) + 1; // odd
			// The conjugate m - n sqrt(2) is below 1 in absolute value.
			if (std::abs(m0 - n * std::sqrt(2.0)) <= 1.0)
				nearest = std::min(nearest, std::abs(rest - m0));
		}
		EXPECT_LT(nearest, 1e-8) << half;
	}
	ASSERT_GT(halves.size(), 40u);
	std::sort(halves.begin(), halves.end());
	EXPECT_NEAR(halves.front(), 1 + std::sqrt(2.0), 1e-11);
	const auto second = std::upper_bound(halves.begin(), halves.end(), halves.front() + 1e-6);
	EXPECT_NEAR(*second, 3 + 2 * std::sqrt(2.0), 1e-10);
	const auto third = std::upper_bound(halves.begin(), halves.end(), *second + 1e-6);
	EXPECT_NEAR(*third, 5 + 3 * std::sqrt(2.0), 1e-10);
}

/// Inversive distances of hyperbolic lengths (Eq. 3 as printed) know the scale: for the surface's own
/// lengths the flow has nothing to do. The flow's own start is the class of the flat triangles with
/// these sides; in the mean both agree up to the square of the lengths (the largest difference is at
/// the corner of the octagon, where 16 edges meet).
TEST(BolzaSurface, PrintedStartIsTheMetricAndTheScaleFreeOneConvergesToIt)
{
	std::vector<double> errors;
	for (int levels : {3, 4, 5}) {
		const BolzaSurface surface(levels);
		const Triangulation& t = surface.triangulation;
		const VertexArray<double> radii = initialRadii(t, surface.lengths);
		CirclePacking packing{t, {}};
		VertexVector u(t.vertexCount());
		for (const Vertex v : t.vertices())
			u[v] = std::log(std::tanh(0.5 * radii[v]));
		for (const Edge e : t.edges()) {
			const auto [i, j] = t.ends(e);
			packing.delta.push_back(
				std::max(0.0, Hyperbolic::delta(surface.lengths[e], radii[i], radii[j])));
		}
		GeometricCurvatureMap<Hyperbolic> printed(packing);
		printed.evaluate(u);
		EXPECT_LT(printed.curvature().lpNorm<Eigen::Infinity>(), 1e-11);

		FlowOptions options;
		options.method = Method::FixedTriangles;
		options.epsilon = 1e-12;
		Target target;
		target.background = Background::HyperbolicPlane;
		target.curvature = Eigen::VectorXd::Zero(t.vertexCount());
		target.fixed.assign(t.vertexCount(), 0);
		const EmbeddedSurface embedded{t, {}, surface.lengths, topologyOf(t)};
		const FlowResult flow =
			runRicciFlow(embedded, initialPacking(embedded, options), target, options);
		double squares = 0.0;
		for (const Edge e : t.edges())
			squares += std::pow(flow.metric->lengths()[e] / surface.lengths[e] - 1.0, 2);
		errors.push_back(std::sqrt(squares / t.edgeCount()));
	}
	for (std::size_t i = 1; i < errors.size(); ++i)
		EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), 2.0, 0.3) << errors[i];
}

/// A metric with the eight-fold symmetry of the octagon has the Bolza surface as its uniformization,
/// whatever the triangles are: no other surface of genus 2 has that symmetry.
TEST(BolzaSurface, FlowFindsItExactlyWhereTheSymmetryIsKept)
{
	const auto none = [](BolzaSurface::Complex) { return 0.0; };
	const auto ripples = [](BolzaSurface::Complex z) {
		const double d = static_cast<double>(distanceInDisk(z, 0.0L));
		const double x = d / BolzaSurface::inradius();
		return x < 1.0 ? 1.5 * std::cos(2.0 * d) * std::pow(1 - x * x, 4) : 0.0;
	};
	for (int levels : {1, 2, 3}) {
		const BolzaSurface surface(levels);
		for (const IntrinsicMesh& metric : {surface.distorted(none), surface.distorted(ripples)}) {
			const FuchsianGroup group = groupOfFlow(metric);
			EXPECT_LT(group.polygonError, 1e-10);
			EXPECT_LT(group.relationError, 1e-9);
			EXPECT_NEAR(minTrace(group), 2 * BolzaSurface::halfTrace(), 1e-9);
		}
	}
}

/// A bump beside the centre breaks the symmetry: the meshes then are in the conformal class only up
/// to the square of their edges' lengths.
TEST(BolzaSurface, ShortestGeodesicConvergesWithSecondOrder)
{
	const BolzaSurface::Complex centre = std::polar(0.2L, 0.3L);
	const double reach =
		BolzaSurface::inradius() - static_cast<double>(distanceInDisk(centre, 0.0L));
	const auto bump = [&](BolzaSurface::Complex z) {
		const double x = static_cast<double>(distanceInDisk(z, centre)) / reach;
		return x < 1.0 ? std::pow(1 - x * x, 4) : 0.0;
	};
	std::vector<double> errors;
	for (int levels : {2, 3, 4, 5})
		errors.push_back(std::abs(
			minTrace(groupOfFlow(BolzaSurface(levels).distorted(bump))) -
			2 * BolzaSurface::halfTrace()));
	EXPECT_LT(errors.back(), 0.01);
	for (std::size_t i = 2; i < errors.size(); ++i)
		EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), 2.0, 0.3);
}

} // namespace
} // namespace ricci::testing
