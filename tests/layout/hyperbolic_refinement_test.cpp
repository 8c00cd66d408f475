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

#include <ricci/layout/common_refinement.h>
#include <ricci/layout/hyperbolic_layout.h>
#include <ricci/metric/conformal_flip.h>
#include <ricci/metric/hyperbolic.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

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
		std::vector<char> cones = flow.cones();
		cones.resize(at(t.vertexCount()), 0);
		const CutGraph cut = cutToDisk(t, metric.lengths(), cones, {});
		const HyperbolicLayout layout =
			layOutInDisk(t, metric.lengths(), metric.angles(), cut.isCut);
		std::complex<long double> moment = 0.0L;
		for (int h = 0; h < t.halfedgeCount(); ++h) {
			if (t.isOuter(h))
				continue;
			const auto z = layout.frame[at(h)].origin();
			const auto w = layout.frame[at(t.next(h))].origin();
			const auto x = layout.frame[at(t.previous(h))].origin();
			ASSERT_LT(std::abs(z), 1.0L);
			const double length = metric.lengths()[at(Triangulation::edge(h))];
			EXPECT_NEAR(static_cast<double>(distanceInDisk(z, w)) / length, 1.0, 1e-11);
			EXPECT_NEAR(
				chordLength(layout.at(h), layout.at(t.next(h))) / (2 * std::sinh(length / 2)),
				1.0,
				1e-8);
			EXPECT_NEAR(static_cast<double>(angleInDisk(z, w, x)), metric.angles()[at(h)], 1e-10);
			EXPECT_EQ(
				hyperbolicOrientation(layout.at(h), layout.at(t.next(h)), layout.at(t.previous(h))),
				1);
			// The frame looks along the halfedge.
			const auto ahead = layout.frame[at(h)].inverse()(w);
			EXPECT_LT(static_cast<double>(std::abs(ahead.imag())), 1e-12);
			EXPECT_GT(ahead.real(), 0.0L);
			// Its vector on the hyperboloid, by the area round it.
			double area = kPi;
			for (int side : t.halfedges(t.face(h)))
				area -= metric.angles()[at(side)];
			moment += static_cast<long double>(2 * area) * z / (1.0L - std::norm(z));
		}
		// The middle is at 0.
		EXPECT_LT(static_cast<double>(std::abs(moment)) / flow.result.area, 1e-9);
		// Across the cut the two sides differ by the transition, across the rest by nothing.
		for (int e = 0; e < t.edgeCount(); ++e) {
			if (t.isBoundaryEdge(e))
				continue;
			const int h = 2 * e, g = 2 * e + 1;
			Transition transition;
			offerTransition(layout, metric.lengths()[at(e)], h, g, transition);
			EXPECT_LT(
				std::abs(
					Complex(transition.motion(layout.frame[at(t.next(g))].origin())) -
					layout.at(h)),
				1e-10);
			EXPECT_LT(
				std::abs(
					Complex(transition.motion(layout.frame[at(g)].origin())) -
					layout.at(t.next(h))),
				1e-10);
			if (!cut.isCut[at(e)]) {
				EXPECT_LT(static_cast<double>(transition.motion.distanceFromIdentity()), 1e-9);
			}
		}
	}
}

TEST(HyperbolicLayout, OrientationIsThatOfTheGeodesicTriangle)
{
	Random random(610);
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
		}
	}
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
		const CommonRefinement r = flow.refinement(cut);
		crossings += r.crossings;
		const Triangulation t(static_cast<int>(r.points.size()), r.triangles);
		EXPECT_EQ(t.eulerCharacteristic(), flow.topology.eulerCharacteristic);
		const std::vector<char> boundary = t.boundaryVertices();
		std::vector<Complex> place(at(t.halfedgeCount()));
		std::vector<long double> defect(r.points.size(), 2 * std::acos(-1.0L));
		long double area = 0.0L;
		for (int f = 0; f < t.faceCount(); ++f) {
			const auto h = t.halfedges(f);
			EXPECT_EQ(
				hyperbolicOrientation(
					asComplex(r.uv[at(f)][0]),
					asComplex(r.uv[at(f)][1]),
					asComplex(r.uv[at(f)][2])),
				1);
			area += std::acos(-1.0L);
			for (std::size_t k = 0; k < 3; ++k) {
				place[at(h[k])] = asComplex(r.uv[at(f)][k]);
				const long double angle = angleInDisk(
					asComplex(r.uv[at(f)][k]),
					asComplex(r.uv[at(f)][(k + 1) % 3]),
					asComplex(r.uv[at(f)][(k + 2) % 3]));
				defect[at(t.origin(h[k]))] -= angle;
				area -= angle;
			}
		}
		for (std::size_t v = 0; v < defect.size(); ++v) {
			if (boundary[v] && v >= p.mesh.positions.size())
				defect[v] -= kPi; // a point of the boundary's straight line
			double target = 0.0;
			if (v < p.mesh.positions.size()) {
				if (boundary[v])
					defect[v] -= kPi;
				target = flow.result.target.curvature[static_cast<Eigen::Index>(v)];
			}
			EXPECT_NEAR(static_cast<double>(defect[v]), target, 1e-8) << "point " << v;
		}
		EXPECT_NEAR(
			static_cast<double>(area) /
				(flow.result.target.curvature.sum() - 2 * kPi * flow.topology.eulerCharacteristic),
			1.0,
			1e-9);
		// The sides of a seam are as long as each other.
		int seams = 0;
		for (int e = 0; e < t.edgeCount(); ++e) {
			if (t.isBoundaryEdge(e))
				continue;
			const int h = 2 * e, g = h + 1;
			if (place[at(h)] == place[at(t.next(g))] && place[at(t.next(h))] == place[at(g)])
				continue;
			++seams;
			const double left = chordLength(place[at(h)], place[at(t.next(h))]);
			const double right = chordLength(place[at(g)], place[at(t.next(g))]);
			const auto rounding = [](Complex z) { return 4e-16 / (1.0 - std::norm(z)); };
			EXPECT_NEAR(left, right, 1e-9 * left + rounding(place[at(h)]) + rounding(place[at(g)]));
		}
		EXPECT_GE(seams, cut.edgeCount);
		// ... and differ by the motion that is reported.
		const Triangulation& input = flow.base;
		for (int e = 0; e < input.edgeCount(); ++e) {
			if (!cut.isCut[at(e)])
				continue;
			const int h = 2 * e, g = h + 1;
			const DiskIsometry motion = rounded(r.transition[at(e)].motion);
			EXPECT_LT(
				std::abs(
					motion(asComplex(r.inputLayout.at(input.next(g)))) -
					asComplex(r.inputLayout.at(h))),
				1e-9);
			EXPECT_LT(
				std::abs(
					motion(asComplex(r.inputLayout.at(g))) -
					asComplex(r.inputLayout.at(input.next(h)))),
				1e-9);
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
		const std::vector<double> lengths = edgeLengths(t, mesh.positions);
		std::vector<double> radii = initialRadii(t, lengths);
		for (double& r : radii)
			r *= 0.5;
		const CirclePacking packing = inversiveDistancePacking(t, lengths, radii);
		int e = 0;
		while (!t.isFlippable(e))
			++e;
		// Circles of hyperbolic size; one of those beside the diagonal is made to fit.
		const int apex = t.origin(t.previous(2 * e));
		Eigen::VectorXd u(4);
		for (int v = 0; v < 4; ++v)
			u[v] = std::log(radii[at(v)]) + random.real(-0.3, 0.3);
		GeometricCurvatureMap<Hyperbolic> before(packing);
		const auto weightAt = [&](double x) {
			u[apex] = x;
			before.evaluate(u);
			return before.brokenTriangles() > 0 ? -1.0 : before.weights()[at(e)];
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
		flipped.delta[at(e)] = flippedDelta(t, packing.delta, e);
		flipped.triangulation.flip(e);
		GeometricCurvatureMap<Hyperbolic> after(flipped);
		after.evaluate(u);
		ASSERT_EQ(after.brokenTriangles(), 0);
		++met;
		const std::vector<int> noFlips, flips{e};
		FlippedSurface surface;
		surface.input = surface.start = &t;
		surface.startFlips = &noFlips;
		surface.startLengths = &lengths;
		surface.startDelta = &packing.delta;
		surface.startRadii = &radii;
		surface.flowFlips = &flips;
		surface.end = &after.triangulation();
		surface.endLengths = &after.lengths();
		surface.endAngles = &after.angles();
		surface.endU = &u;
		surface.background = Background::HyperbolicPlane;
		surface.keptFaces = 2;
		const CommonRefinement r = commonRefinement(
			surface, mesh.positions, std::vector<char>(5, 0), [](double, std::size_t) {});
		ASSERT_EQ(r.points.size(), 5u);
		ASSERT_EQ(r.triangles.size(), 4u);
		std::vector<Complex> place(5);
		for (std::size_t f = 0; f < 4; ++f)
			for (std::size_t k = 0; k < 3; ++k)
				place[at(r.triangles[f][k])] = asComplex(r.uv[f][k]);
		for (int diagonal : {0, 1}) {
			const Triangulation& of = diagonal == 0 ? t : after.triangulation();
			EXPECT_NEAR(
				static_cast<double>(angleInDisk(
					place[4], place[at(of.origin(2 * e))], place[at(of.target(2 * e))])),
				kPi,
				1e-6); // the root of what rounding leaves of the straight line's length
			const double length = diagonal == 0 ? before.lengths()[at(e)] : after.lengths()[at(e)];
			EXPECT_NEAR(
				static_cast<double>(
					distanceInDisk(place[4], place[at(of.origin(2 * e))]) +
					distanceInDisk(place[4], place[at(of.target(2 * e))])) /
					length,
				1.0,
				1e-11);
		}
	}
	EXPECT_GT(met, 30);
}

} // namespace
} // namespace ricci::testing
