// SPDX-License-Identifier: GPL-3.0-or-later
// A surface of genus 2 whose metric is known, with metrics of its conformal class: how fast the flow converges.
#include "support/bolza.h"
#include "support/flipped_flow.h"
#include "support/run_flow.h"
#include "support/siegel_distance.h"

#include <ricci/hyperbolic/group_of_cut.h>
#include <ricci/layout/hyperbolic_layout.h>
#include <ricci/measure/invariants.h>
#include <ricci/metric/geometry.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
	return fuchsianGroup(t, cut, pairingOfArcs(t, cut, pairing), true);
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
		EdgeArray<double> delta;
		VertexVector u(t.vertexCount());
		for (const Vertex v : t.vertices())
			u[v] = std::log(std::tanh(0.5 * radii[v]));
		for (const Edge e : t.edges()) {
			const auto [i, j] = t.ends(e);
			delta.push_back(
				std::max(0.0, Hyperbolic::delta(surface.lengths[e], radii[i], radii[j])));
		}
		GeometricCurvatureMap<Hyperbolic> printed(t, delta);
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

/// A bump beside the centre breaks the symmetry: the meshes then are in the conformal class only up
/// to the square of their edges' lengths. So are the shortest geodesic that the flow finds, and the period matrix.
TEST(BolzaSurface, GeodesicsAndPeriodsConvergeWithSecondOrder)
{
	const BolzaSurface::Complex centre = std::polar(0.2L, 0.3L);
	const double reach =
		BolzaSurface::inradius() - static_cast<double>(distanceInDisk(centre, 0.0L));
	const auto bump = [&](BolzaSurface::Complex z) {
		const double x = static_cast<double>(distanceInDisk(z, centre)) / reach;
		return x < 1.0 ? std::pow(1 - x * x, 4) : 0.0;
	};
	std::vector<double> traces, periods;
	for (int levels : {3, 4, 5}) {
		const IntrinsicMesh metric = BolzaSurface(levels).distorted(bump);
		const FlippedFlow flow(metric, hyperbolicMetric(), 1e-13);
		const CurvatureMap& found = *flow.result.metric;
		const Triangulation& t = found.triangulation();
		// The cut runs on the triangles of the result: the surface has no places in space.
		const CutGraph cut = cutToDisk(t, found.lengths(), VertexArray<char>(t.vertexCount(), 0));
		const HyperbolicLayout layout = layOutInDisk(t, found.lengths(), found.angles(), cut.isCut);
		double least = 1e9; // |trace| of an isometry along an axis, among the copies in a few rings
		for (const DiskIsometry& m :
			 tiling(groupOf(t, found.lengths(), cut, layout).sides, 3, 20000).deck)
			if (m.distanceFromIdentity() > 1e-3)
				least = std::min(least, std::abs(m.trace()));
		traces.push_back(std::abs(least - 2 * BolzaSurface::halfTrace()));
		const PeriodMatrix matrix = periodMatrix(metric.triangulation, metric.lengths);
		periods.push_back(classDistance(omegaOfPolygon(8), matrix.omega, 0.05));
		EXPECT_LT(periods.back(), matrix.error);
	}
	EXPECT_LT(traces.back(), 0.01);
	EXPECT_LT(periods.back(), 1e-3);
	for (std::size_t i = 1; i < traces.size(); ++i) {
		EXPECT_NEAR(std::log2(traces[i - 1] / traces[i]), 2.0, 0.3);
		EXPECT_GT(periods[i - 1] / periods[i], 3.0);
	}
}

} // namespace
} // namespace ricci::testing
