// SPDX-License-Identifier: GPL-3.0-or-later
// The common refinement and the layout of hyperbolic results.
#include "support/bolza.h"
#include "support/complex.h"
#include "support/flipped_flow.h"
#include "support/implicit_surface.h"
#include "support/intrinsic.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/wide.h"

#include <ricci/base/numbers.h>
#include <ricci/layout/common_refinement.h>
#include <ricci/layout/corner_layout.h>
#include <ricci/layout/hyperbolic_layout.h>
#include <ricci/metric/conformal_flip.h>
#include <ricci/metric/hyperbolic.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

struct Problem
{
	std::string name;
	SurfaceMesh mesh;
	HyperbolicRequest request;
	bool cutAnywhere = false;
};

std::vector<Problem> problems()
{
	Random random(600);
	const SurfaceMesh sphere = shaken(perforatedSlab(0, 3), 0.05, random);
	const SurfaceMesh donut = bumpyTorus(12, 9, random);
	std::vector<double> onSphere(sphere.positions.size(), 0.0),
		onTorus(donut.positions.size(), 0.0);
	onSphere[3] = onSphere[20] = 5.0;
	onSphere[40] = 4.0;
	onSphere[11] = -1.0;
	onTorus[5] = 4.0;
	onTorus[60] = -2.0;
	std::vector<Problem> all{
		{"genus 2", shaken(perforatedSlab(2, 3), 0.06, random), hyperbolicMetric()},
		{"genus 2, slivers", implicitClosed(2, 4, 3), hyperbolicMetric()},
		{"genus 3", shaken(perforatedSlab(3, 2), 0.06, random), hyperbolicMetric()},
		{"one hole",
		 withoutStars(shaken(perforatedSlab(1, 4), 0.04, random), {0}),
		 hyperbolicMetric()},
		{"three holes",
		 withoutStars(shaken(perforatedSlab(0, 5), 0.04, random), {0, 60, 120}),
		 hyperbolicMetric()},
		{"sphere with cones", sphere, hyperbolicPrescribed(onSphere)},
		{"torus with cones", donut, hyperbolicPrescribed(onTorus)}};
	// A cut that crosses end edges more often than it must, see common_refinement_test.cpp.
	for (int i = 0; i < 60; ++i) {
		std::vector<double> cones(9, 0.0);
		for (int k = 0; k < 3; ++k)
			cones[at(random.index(9))] = 4.0;
		all.push_back(
			{"folded torus " + std::to_string(i),
			 foldedTorus(3, 3, 0.1, random),
			 hyperbolicPrescribed(cones),
			 true});
	}
	return all;
}

TEST(HyperbolicLayout, TrianglesHaveTheLengthsAndAnglesOfTheMetric)
{
	for (const Problem& p : problems()) {
		SCOPED_TRACE(p.name);
		const FlippedFlow flow(p.mesh, p.request);
		const CurvatureMap& metric = *flow.result.metric;
		const Triangulation& t = metric.triangulation();
		VertexArray<char> cones = flow.cones();
		cones.resize(t.vertexCount(), 0);
		const CutGraph cut = cutToDisk(t, metric.lengths(), cones);
		const HyperbolicLayout layout =
			layOutInDisk(t, metric.lengths(), metric.angles(), cut.isCut);
		std::complex<long double> moment = 0.0L;
		for (const Halfedge h : t.interiorHalfedges()) {
			const auto z = wide(layout.frame[h].origin());
			const auto w = wide(layout.frame[t.next(h)].origin());
			const auto x = wide(layout.frame[t.previous(h)].origin());
			ASSERT_LT(std::abs(z), 1.0L);
			const double length = metric.lengths()[h.edge()];
			EXPECT_NEAR(static_cast<double>(distanceInDisk(z, w)) / length, 1.0, 1e-11);
			EXPECT_NEAR(
				chordLength(layout[h], layout[t.next(h)]) / (2 * std::sinh(length / 2)), 1.0, 1e-8);
			EXPECT_NEAR(static_cast<double>(angleInDisk(z, w, x)), metric.angles()[h], 1e-10);
			EXPECT_EQ(
				hyperbolicOrientation(layout[h], layout[t.next(h)], layout[t.previous(h)]), 1);
			// The frame looks along the halfedge.
			const auto ahead = wide(layout.frame[h].inverse()(layout.frame[t.next(h)].origin()));
			EXPECT_LT(static_cast<double>(std::abs(ahead.imag())), 1e-12);
			EXPECT_GT(ahead.real(), 0.0L);
			// Its vector on the hyperboloid, by the area round it.
			double area = kPi;
			for (const Halfedge side : t.loop(h))
				area -= metric.angles()[side];
			moment += static_cast<long double>(2 * area) * z / (1.0L - std::norm(z));
		}
		// The middle is at 0.
		EXPECT_LT(static_cast<double>(std::abs(moment)) / flow.result.area, 1e-9);
		// Across the cut the two sides differ by the side pairing, across the rest by nothing.
		for (const Edge e : t.edges()) {
			if (t.isBoundary(e))
				continue;
			const Halfedge h = e.halfedge(), g = h.twin();
			SidePairing pairing;
			offerPairing(layout, metric.lengths()[e], h, g, pairing);
			EXPECT_LT(
				std::abs(Complex(pairing.isometry()(layout.frame[t.next(g)].origin())) - layout[h]),
				1e-10);
			EXPECT_LT(
				std::abs(Complex(pairing.isometry()(layout.frame[g].origin())) - layout[t.next(h)]),
				1e-10);
			if (!cut.isCut[e]) {
				EXPECT_LT(static_cast<double>(pairing.isometry().distanceFromIdentity()), 1e-9);
			}
		}
	}
}

TEST(HyperbolicLayout, OrientationIsThatOfTheGeodesicTriangle)
{
	Random random(610);
	int clear = 0;
	for (int i = 0; i < 1000; ++i) {
		const auto point = [&] {
			return std::polar(std::sqrt(random.real(0.0, 0.95)), random.real(0.0, 6.28));
		};
		const Complex p = point(), q = point(), r = point();
		const int sign = hyperbolicOrientation(p, q, r);
		EXPECT_EQ(hyperbolicOrientation(q, r, p), sign);
		EXPECT_EQ(hyperbolicOrientation(q, p, r), -sign);
		// In the Klein model geodesics are straight.
		const auto klein = [](Complex z) { return 2.0 * z / (1.0 + std::norm(z)); };
		const double area = (std::conj(klein(q) - klein(p)) * (klein(r) - klein(p))).imag();
		if (std::abs(area) > 1e-12) {
			EXPECT_EQ(sign, area > 0 ? 1 : -1);
			++clear;
		}
	}
	EXPECT_GT(clear, 900);
	EXPECT_EQ(hyperbolicOrientation(0.0, 0.25, 0.5), 0);
}

TEST(HyperbolicRefinement, IsAMetricOfCurvatureMinusOneOnTheInput)
{
	std::size_t crossings = 0;
	Random random(615);
	for (const Problem& p : problems()) {
		SCOPED_TRACE(p.name);
		const FlippedFlow flow(p.mesh, p.request, 1e-12);
		const CutGraph cut = p.cutAnywhere ? flow.cutAnywhere(random) : flow.cut();
		const SurfaceLayout r = flow.refinement(cut);
		crossings += r.refinement.source.values().size() - p.mesh.positions.size();
		const Triangulation t(r.refinement.source.size(), r.refinement.vertices.values());
		const int chi = flow.surface().topology.type.eulerCharacteristic();
		EXPECT_EQ(t.eulerCharacteristic(), chi);
		const VertexArray<char> boundary = t.boundaryVertices();
		HalfedgeArray<Complex> place(t.halfedgeCount());
		VertexArray<long double> defect(r.refinement.source.size(), 2 * std::acos(-1.0L));
		long double area = 0.0L;
		for (const Face f : t.faces()) {
			const auto h = t.halfedges(f);
			EXPECT_EQ(
				hyperbolicOrientation(
					asComplex(r.refinement.at(f.number())[0]),
					asComplex(r.refinement.at(f.number())[1]),
					asComplex(r.refinement.at(f.number())[2])),
				1);
			area += std::acos(-1.0L);
			for (std::size_t k = 0; k < 3; ++k) {
				place[h[k]] = asComplex(r.refinement.at(f.number())[k]);
				const long double angle = angleInDisk(
					asComplex(r.refinement.at(f.number())[k]),
					asComplex(r.refinement.at(f.number())[(k + 1) % 3]),
					asComplex(r.refinement.at(f.number())[(k + 2) % 3]));
				defect[t.origin(h[k])] -= angle;
				area -= angle;
			}
		}
		for (const Vertex v : defect.indices()) {
			if (boundary[v])
				defect[v] -= kPi; // other points of the boundary lie on its straight line
			const bool isOfInput = v < Vertex(p.mesh.positions.size());
			const double target = isOfInput ? flow.result.target.curvature[v] : 0.0;
			EXPECT_NEAR(static_cast<double>(defect[v]), target, 1e-8) << "point " << v.number();
		}
		EXPECT_NEAR(
			static_cast<double>(area) / (flow.result.target.curvature.sum() - 2 * kPi * chi),
			1.0,
			1e-9);
		// The sides of a seam are as long as each other.
		int seams = 0;
		for (const Edge e : t.edges()) {
			if (t.isBoundary(e))
				continue;
			const Halfedge h = e.halfedge(), g = h.twin();
			if (place[h] == place[t.next(g)] && place[t.next(h)] == place[g])
				continue;
			++seams;
			const double left = chordLength(place[h], place[t.next(h)]);
			const double right = chordLength(place[g], place[t.next(g)]);
			const auto rounding = [](Complex z) { return 4e-16 / (1.0 - std::norm(z)); };
			EXPECT_NEAR(left, right, 1e-9 * left + rounding(place[h]) + rounding(place[g]));
		}
		EXPECT_GE(seams, cut.edgeCount);
		// ... and differ by the isometry that is reported.
		const Triangulation& input = flow.base();
		const auto expectPairing = [&](const PlanarLayout& layout,
									   const EdgeArray<SidePairing>& pairing) {
			const auto at = [&](Halfedge h) { return asComplex(layout[h]); };
			for (const Edge e : input.edges()) {
				if (!cut.isCut[e])
					continue;
				const Halfedge h = e.halfedge(), g = h.twin();
				const DiskIsometry isometry = rounded(pairing[e].isometry());
				EXPECT_LT(std::abs(isometry(at(input.next(g))) - at(h)), 1e-9);
				EXPECT_LT(std::abs(isometry(at(g)) - at(input.next(h))), 1e-9);
			}
		};
		expectPairing(r.corners, r.pairing);
		// The layout of the corners alone is the same figure.
		const SurfaceLayout disk = layOutCorners(flow.domain, flow.result, cut.isCut);
		expectPairing(disk.corners, disk.pairing);
		for (const Halfedge h : input.interiorHalfedges()) {
			const auto fromFirst = [&](const PlanarLayout& layout) {
				return static_cast<double>(
					distanceInDisk(asComplex(layout[h]), asComplex(layout.points[0])));
			};
			const auto rounding = [&](const PlanarLayout& layout) {
				return 1e-14 / (1.0 - std::norm(asComplex(layout[h]))) +
					   1e-14 / (1.0 - std::norm(asComplex(layout.points[0])));
			};
			EXPECT_NEAR(
				fromFirst(disk.corners),
				fromFirst(r.corners),
				1e-9 + rounding(disk.corners) + rounding(r.corners));
		}
	}
	EXPECT_GT(crossings, 200u);
}

/// Where an edge is just about to flip both diagonals of its quad are geodesics of one metric, and
/// the crossing is where they meet.
TEST(HyperbolicRefinement, CrossingsAreWhereGeodesicsMeet)
{
	Random random(620);
	int met = 0;
	for (int trial = 0; trial < 200; ++trial) {
		SurfaceMesh mesh = rectangle(1, 1, 1.0, 1.0);
		for (Point3& p : mesh.positions)
			for (std::size_t k = 0; k < 2; ++k)
				p[k] += random.real(-0.2, 0.2);
		const Triangulation t = glued(mesh);
		const EdgeArray<double> lengths = edgeLengths(t, mesh);
		VertexArray<double> radii = initialRadii(t, lengths);
		for (double& r : radii)
			r *= 0.5;
		const CirclePacking packing{t, inversiveDistancesLessOne(t, lengths, radii)};
		Edge e(0);
		while (!t.isFlippable(e))
			e = Edge(e.number() + 1);
		// Circles of hyperbolic size; one of those beside the diagonal is made to fit.
		const Vertex apex = t.apex(e.halfedge());
		VertexVector u(4);
		for (const Vertex v : t.vertices())
			u[v] = std::log(radii[v]) + random.real(-0.3, 0.3);
		GeometricCurvatureMap<Hyperbolic> before(packing);
		const auto weightAt = [&](double x) {
			u[apex] = x;
			before.evaluate(u);
			return before.brokenTriangles() > 0 ? -1.0 : before.weights()[e];
		};
		double low = u[apex] - 1.5, high = std::min(u[apex] + 1.5, -0.05);
		if (weightAt(low) * weightAt(high) > 0.0)
			continue;
		const bool rising = weightAt(high) > 0.0;
		for (int step = 0; step < 80; ++step) {
			const double middle = 0.5 * (low + high);
			((weightAt(middle) > 0.0) == rising ? high : low) = middle;
		}
		if (std::abs(weightAt(low)) > 1e-12)
			continue; // a triangle breaks there
		CirclePacking flipped = packing;
		flipped.delta[e] = flippedDelta(t, packing.delta, e);
		flipped.triangulation.flip(e);
		const auto after = std::make_shared<GeometricCurvatureMap<Hyperbolic>>(flipped);
		after->evaluate(u);
		ASSERT_EQ(after->brokenTriangles(), 0);
		++met;
		FlowDomain domain;
		domain.surface = embeddedSurface(VertexArray<Point3>(mesh.positions), mesh.triangles);
		domain.onHole.assign(t.vertexCount(), 0);
		FlowResult flow;
		flow.target.background = Background::HyperbolicPlane;
		flow.metric = after;
		flow.u = u;
		flow.input = t;
		flow.start.mesh = {t, lengths};
		flow.start.delta = packing.delta;
		flow.start.radii = radii;
		flow.flips = {e};
		const SurfaceLayout r = layOutRefinement(
			domain,
			flow,
			divideStartTriangles(flow, domain.surface.triangulation.faceCount()),
			EdgeArray<char>(5, 0));
		ASSERT_EQ(r.refinement.source.size(), 5);
		ASSERT_EQ(r.refinement.size(), 4);
		std::vector<Complex> place(5);
		for (int f = 0; f < 4; ++f)
			for (std::size_t k = 0; k < 3; ++k)
				place[at(r.refinement.vertices[f][k])] = asComplex(r.refinement.at(f)[k]);
		for (int diagonal : {0, 1}) {
			const auto ends = (diagonal == 0 ? t : after->triangulation()).ends(e);
			const Complex from = place[at(ends[0])], to = place[at(ends[1])];
			EXPECT_NEAR(
				static_cast<double>(angleInDisk(place[4], from, to)),
				kPi,
				1e-6); // the root of what rounding leaves of the straight line's length
			const double length = diagonal == 0 ? before.lengths()[e] : after->lengths()[e];
			EXPECT_NEAR(
				static_cast<double>(distanceInDisk(place[4], from) + distanceInDisk(place[4], to)) /
					length,
				1.0,
				1e-11);
		}
	}
	EXPECT_GT(met, 30);
}

} // namespace
} // namespace ricci::testing
