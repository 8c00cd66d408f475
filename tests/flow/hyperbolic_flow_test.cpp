// SPDX-License-Identifier: GPL-3.0-or-later
// The hyperbolic flow, seen from its result alone.
#include "support/expect.h"
#include "support/flipped_flow.h"
#include "support/implicit_surface.h"
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/base/numbers.h>
#include <ricci/metric/area.h>
#include <ricci/metric/hyperbolic.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

/// The target is reached, by the flow's word and by the lengths it gives; the area is what
/// Gauss-Bonnet says.
void expectReached(const FlippedFlow& flow)
{
	expectTarget<HyperbolicMeasure>(flow, 1e-9);
	const FlowResult& r = flow.result;
	EXPECT_LT(r.u.maxCoeff(), 0.0);
	if (r.target.hasFixed())
		return;
	const double area =
		r.target.curvature.sum() - 2 * kPi * flow.surface().topology.type.eulerCharacteristic();
	// Every curvature is rounded to the last place of 2 pi.
	EXPECT_NEAR(r.area, area, 1e-10 * area + 1e-15 * flow.base().vertexCount());
}

TEST(HyperbolicFlow, FindsTheMetricOfCurvatureMinusOne)
{
	Random random(500);
	for (int genus : {2, 3}) {
		std::vector<SurfaceMesh> meshes{
			perforatedSlab(genus, 2), shaken(perforatedSlab(genus, 3), 0.08, random)};
		for (std::uint64_t seed : {1u, 2u})
			meshes.push_back(implicitClosed(genus, 5, seed));
		for (const SurfaceMesh& mesh : meshes) {
			SCOPED_TRACE(
				"genus " + std::to_string(genus) + ", " + std::to_string(mesh.positions.size()) +
				" vertices");
			const FlippedFlow flow(mesh, hyperbolicMetric());
			expectReached(flow);
			EXPECT_NEAR(flow.result.area / (4 * kPi * (genus - 1)), 1.0, 1e-10);
		}
	}
}

TEST(HyperbolicFlow, ReachesConesThatAreNearlyCusps)
{
	// Their circles grow beyond all bounds, u to 0, while the others have far to go.
	Random random(506);
	for (int trial = 0; trial < 8; ++trial) {
		const SurfaceMesh mesh = shaken(perforatedSlab(2, 3), 0.06, random);
		for (double angle : {1e-2, 1e-4, 1e-6}) {
			SCOPED_TRACE(angle);
			std::vector<double> cones(mesh.positions.size(), 0.0);
			for (int k = 0; k < 4; ++k)
				cones[at(random.index(static_cast<int>(cones.size())))] = 2 * kPi - angle;
			const FlippedFlow flow(mesh, hyperbolicPrescribed(cones));
			expectReached(flow);
			EXPECT_LE(flow.result.iterations, 20);
		}
	}
}

TEST(HyperbolicFlow, LengthsOfTheInputAreExactWhereNothingFlips)
{
	Random random(505);
	const FlippedFlow flow(shaken(perforatedSlab(2, 3), 0.08, random), hyperbolicMetric());
	EdgeArray<char> flipped(flow.base().edgeCount(), 0);
	for (const std::vector<Edge>* flips : {&flow.result.start.flips, &flow.result.flips})
		for (const Edge e : *flips)
			flipped[e] = 1;
	const EdgeArray<double> found = hyperbolicLengths(flow.result, flow.surface());
	ASSERT_EQ(found.size(), flipped.size());
	for (const Edge e : found.indices()) {
		EXPECT_GT(found[e], 0.0);
		if (!flipped[e]) {
			EXPECT_NEAR(found[e] / flow.result.metric->lengths()[e], 1.0, 1e-12);
		}
	}
	EXPECT_GT(std::count(flipped.begin(), flipped.end(), 0), 100);
	EXPECT_GT(std::count(flipped.begin(), flipped.end(), 1), 10);
}

TEST(HyperbolicFlow, ReachesRandomCones)
{
	for (int genus : {0, 1, 2})
		for (std::uint64_t seed : {1u, 2u, 3u}) {
			Random random(510 + seed);
			for (const SurfaceMesh& mesh :
				 {shaken(perforatedSlab(genus, 3), 0.08, random), implicitClosed(genus, 5, seed)}) {
				SCOPED_TRACE("genus " + std::to_string(genus) + ", seed " + std::to_string(seed));
				std::vector<double> curvature(mesh.positions.size(), 0.0);
				double sum = 0.0;
				for (int i = 0; i < 12; ++i) {
					double& K = curvature[at(random.index(static_cast<int>(curvature.size())))];
					sum -= K;
					K = random.real(-4.0, 6.0);
					sum += K;
				}
				for (std::size_t v = 0; sum <= 4 * kPi * (1 - genus) + 0.1; ++v) {
					sum += 3.0 - curvature[v];
					curvature[v] = 3.0;
				}
				expectReached(FlippedFlow(mesh, hyperbolicPrescribed(curvature)));
			}
		}
}

TEST(HyperbolicFlow, SharpAndWideCones)
{
	Random random(520);
	const SurfaceMesh sphere = shaken(perforatedSlab(0, 3), 0.05, random);
	for (double gap : {0.3, 0.05}) {
		std::vector<double> curvature(sphere.positions.size(), 0.0);
		for (std::size_t v : {3u, 20u, 40u})
			curvature[v] = 2 * kPi - gap;
		expectReached(FlippedFlow(sphere, hyperbolicPrescribed(curvature)));
	}
	const SurfaceMesh genus2 = shaken(perforatedSlab(2, 3), 0.05, random);
	std::vector<double> curvature(genus2.positions.size(), 0.0);
	curvature[7] = -4 * kPi + 0.5; // little area is left
	expectReached(FlippedFlow(genus2, hyperbolicPrescribed(curvature)));
}

/// Without curvature at its vertices a boundary is a closed geodesic.
TEST(HyperbolicFlow, BoundaryBecomesGeodesic)
{
	Random random(530);
	const SurfaceMesh meshes[] = {
		withoutStars(shaken(perforatedSlab(1, 4), 0.03, random), {0}),
		withoutStars(shaken(perforatedSlab(0, 5), 0.03, random), {0, 60, 120}),
		withoutStars(shaken(perforatedSlab(2, 3), 0.03, random), {5, 70})};
	for (const SurfaceMesh& mesh : meshes) {
		const FlippedFlow flow(mesh, hyperbolicMetric());
		ASSERT_LT(flow.surface().topology.type.eulerCharacteristic(), 0);
		SCOPED_TRACE(flow.surface().topology.type.name());
		expectReached(flow);
		for (const Vertex v : flow.base().vertices())
			EXPECT_NEAR(flow.result.curvature[v], 0.0, 1e-10);
	}
}

/// The circles keep their radii, at the scale at which the flat surface has the area
/// 2 pi max(1, |chi|), whatever the curvature inside is to be.
TEST(HyperbolicFlow, FreeBoundaryKeepsItsCircles)
{
	Random random(540);
	for (const SurfaceMesh& mesh :
		 {withoutStars(shaken(perforatedSlab(1, 4), 0.03, random), {0}),
		  withoutStars(shaken(perforatedSlab(0, 5), 0.03, random), {0, 60, 120}),
		  withoutStars(shaken(perforatedSlab(2, 3), 0.03, random), {5, 70}),
		  withoutStars(shaken(perforatedSlab(0, 5), 0.03, random), {0}),
		  ring(1, 3, 24, 8)}) {
		const VertexArray<char> boundary =
			Triangulation(static_cast<int>(mesh.positions.size()), mesh.triangles)
				.boundaryVertices();
		std::vector<int> inside;
		for (const Vertex v : boundary.indices())
			if (!boundary[v])
				inside.push_back(v.number());
		for (const double K : {0.0, 2.0, -2.0}) {
			SCOPED_TRACE(K);
			HyperbolicRequest request =
				hyperbolicPrescribed(std::vector<double>(mesh.positions.size(), 0.0));
			request.options.freeBoundary = true;
			request.prescribed[Vertex(inside[inside.size() / 2])] = K;
			const FlippedFlow flow(mesh, request);
			SCOPED_TRACE(flow.surface().topology.type.name());
			expectReached(flow);
			ASSERT_FALSE(flow.result.doubled);
			const int chi = flow.surface().topology.type.eulerCharacteristic();
			const IntrinsicMesh& start = flow.result.start.mesh;
			const double scale = std::sqrt(
				2 * kPi * std::max(1, std::abs(chi)) /
				euclideanArea(start.triangulation, start.lengths));
			int kept = 0;
			for (const Vertex v : flow.base().vertices())
				if (boundary[v]) {
					const double radius = Hyperbolic::circle(flow.result.u[v]).radius;
					EXPECT_NEAR(radius / flow.result.start.radii[v] / scale, 1.0, 1e-13);
					++kept;
				}
			EXPECT_GT(kept, 0);
		}
	}
}

/// Total length of the boundary in the metric found.
double boundaryLength(const FlowResult& flow)
{
	const Triangulation& t = flow.metric->triangulation();
	double length = 0.0;
	for (const Edge e : t.edges())
		if (t.isBoundary(e))
			length += flow.metric->lengths()[e];
	return length;
}

/// The limits of values whose error is of second order in the width of the triangles: the error falls
/// to a quarter with half of the width, and two of them tell the limit to fourth order.
void expectSecondOrder(const std::vector<double>& values, double limit)
{
	ASSERT_EQ(values.size(), 3u);
	const auto error = [&](std::size_t i) { return values[i] - limit; };
	EXPECT_NEAR(error(0) / error(1), 4.0, 0.4);
	EXPECT_NEAR(error(1) / error(2), 4.0, 0.1);
	EXPECT_NEAR((4.0 * values[2] - values[1]) / 3.0, limit, std::abs(error(2)) / 20.0);
}

/// A flat round disk of area 2 pi has a circumference of 2 pi sqrt(2). In the hyperbolic plane a
/// circle of that length, 2 pi sinh R, holds the area 2 pi (cosh R - 1) = 2 pi (sqrt(3) - 1).
TEST(HyperbolicFlow, ADiskWithFreeBoundaryIsThatOfTheHyperbolicPlane)
{
	std::vector<double> areas, lengths;
	for (const int n : {24, 48, 96}) {
		std::vector<std::array<double, 2>> profile;
		for (int i = 0; i <= n / 4; ++i)
			profile.push_back({4.0 * i / n, 0.0});
		const FlippedFlow flow(revolved(profile, n), hyperbolicMetric(true));
		ASSERT_TRUE(flow.surface().topology.type.isDisk());
		expectReached(flow);
		ASSERT_FALSE(flow.result.doubled);
		EXPECT_NEAR(flow.result.curvature.sum(), 2 * kPi + flow.result.area, 1e-9);
		areas.push_back(flow.result.area);
		lengths.push_back(boundaryLength(flow.result));
	}
	expectSecondOrder(areas, 2 * kPi * (std::sqrt(3.0) - 1.0));
	expectSecondOrder(lengths, 2 * kPi * std::sqrt(2.0));
}

/// On a flat cylinder of period 2 pi and height w the metrics of curvature -1 that are symmetric in
/// both directions are k^2 / cos^2(k x) (dx^2 + dy^2), |x| <= w / 2. Scaled to the area 2 pi both
/// boundaries are 2 pi / sqrt(w) long, which is 2 pi k / cos(k w / 2). The core is a closed geodesic
/// of length 2 pi k, and the area 4 pi k tan(k w / 2).
TEST(HyperbolicFlow, ACylinderWithFreeBoundaryIsAHyperbolicCollar)
{
	const double height = 1.7; // radius 1
	std::vector<double> areas, lengths;
	for (const int n : {24, 48, 96}) {
		std::vector<std::array<double, 2>> profile;
		for (int i = 0; i <= n / 3; ++i)
			profile.push_back({1.0, 3.0 * i / n * height});
		const FlippedFlow flow(revolved(profile, n), hyperbolicMetric(true));
		ASSERT_TRUE(flow.surface().topology.type.isAnnulus());
		expectReached(flow);
		ASSERT_FALSE(flow.result.doubled);
		EXPECT_NEAR(flow.result.curvature.sum(), flow.result.area, 1e-9);
		areas.push_back(flow.result.area);
		lengths.push_back(boundaryLength(flow.result));
	}
	double k = 1.0;
	for (int i = 0; i < 200; ++i)
		k = std::cos(0.5 * k * height) / std::sqrt(height);
	expectSecondOrder(areas, 4 * kPi * k * std::tan(0.5 * k * height));
	expectSecondOrder(lengths, 4 * kPi / std::sqrt(height));
}

/// One metric in each class: the solver finds it from everywhere.
TEST(HyperbolicFlow, DistortedStartsLeadToTheSameMetric)
{
	Random random(550);
	for (int genus : {2, 3}) {
		const SurfaceMesh mesh = shaken(perforatedSlab(genus, 2), 0.05, random);
		const FlippedFlow flow(mesh, hyperbolicMetric(), 1e-13);
		const VertexVector& u = flow.result.u;
		for (double spread : {0.1, 1.0, 3.0}) {
			SCOPED_TRACE(spread);
			FlippingCurvatureMap<Hyperbolic> map(
				CirclePacking{flow.result.metric->triangulation(), flow.result.metric->delta()});
			VertexVector found = u;
			for (double& x : found)
				x = std::min(x + random.real(-spread, spread), -0.05);
			NewtonSolver solver(map, VertexArray<char>(flow.base().vertexCount(), 0));
			NewtonOptions options;
			options.epsilon = 1e-12;
			const NewtonResult solved =
				solver.solve(found, VertexVector::Zero(u.size()), options, [](int, double) {});
			EXPECT_TRUE(solved.converged);
			EXPECT_LT((found - u).lpNorm<Eigen::Infinity>(), 1e-9);
			// Lengths of the edges that both triangulations have.
			for (const Edge e : flow.base().edges())
				if (map.delta()[e] == flow.result.metric->delta()[e]) {
					EXPECT_NEAR(map.lengths()[e] / flow.result.metric->lengths()[e], 1.0, 1e-9);
				}
		}
	}
}

TEST(HyperbolicFlow, DoesNotDependOnScaleNumbersOrTheTriangulationOfTheInput)
{
	Random random(560);
	const SurfaceMesh mesh = shaken(perforatedSlab(2, 2), 0.06, random);
	const FlippedFlow flow(mesh, hyperbolicMetric());
	for (double factor : {1e-3, 1.0 / 3.0, 1e4}) {
		const FlippedFlow same(scaled(mesh, factor), hyperbolicMetric());
		EXPECT_LT((same.result.u - flow.result.u).lpNorm<Eigen::Infinity>(), 1e-9);
	}
	const Renumbered other = renumbered(mesh, random);
	const FlippedFlow same(other.mesh, hyperbolicMetric());
	for (const Vertex v : same.result.u.indices())
		EXPECT_NEAR(same.result.u[v], flow.result.u[Vertex(other.vertex[at(v)])], 1e-9);
	IntrinsicMesh metric = intrinsicMesh(mesh);
	EXPECT_GT(flipIsometrically(metric, 400, random).size(), 60u);
	const FlippedFlow flipped(metric, hyperbolicMetric());
	EXPECT_LT((flipped.result.u - flow.result.u).lpNorm<Eigen::Infinity>(), 1e-9);
}

/// On a torus whose curvatures leave the area \p s the metric is the Euclidean flow's but for the
/// scale, up to the order of s.
TEST(HyperbolicFlow, BothBackgroundsAgreeWhereTheAreaVanishes)
{
	Random random(570);
	const SurfaceMesh mesh = bumpyTorus(14, 10, random);
	const auto n = mesh.positions.size();
	std::vector<double> curvature(n, 0.0);
	curvature[17] = 0.5;
	curvature[91] = -0.5;
	const FlippedFlow flat(mesh, prescribed(curvature), 1e-12);
	const double flatScale = 0.5 * std::log(flat.result.area);
	std::vector<double> radii, lengths;
	for (double s : {1e-2, 1e-3, 1e-4}) {
		curvature[17] = 0.5 + s;
		const FlippedFlow curved(mesh, hyperbolicPrescribed(curvature), 1e-12);
		expectReached(curved);
		EXPECT_NEAR(curved.result.area / s, 1.0, 1e-8);
		const double scale = 0.5 * std::log(curved.result.area);
		double error = 0.0;
		for (const Vertex v : flat.base().vertices()) {
			const double radius = Hyperbolic::circle(curved.result.u[v]).radius;
			error = std::max(
				error, std::abs(std::log(radius) - scale - (flat.result.u[v] - flatScale)));
		}
		radii.push_back(error);
		error = 0.0;
		std::size_t common = 0;
		for (const Edge e : flat.base().edges()) {
			const auto& a = *flat.result.metric;
			const auto& b = *curved.result.metric;
			if (a.delta()[e] != b.delta()[e])
				continue;
			++common;
			error = std::max(
				error, std::abs(std::log(b.lengths()[e] / a.lengths()[e]) - scale + flatScale));
		}
		EXPECT_GT(common, 0.9 * flat.base().edgeCount());
		lengths.push_back(error);
	}
	for (const std::vector<double>& errors : {radii, lengths})
		for (std::size_t i = 1; i < errors.size(); ++i)
			EXPECT_NEAR(errors[i - 1] / errors[i], 10.0, 0.5);
	EXPECT_LT(lengths.back(), 1e-3);
}

} // namespace
} // namespace ricci::testing
