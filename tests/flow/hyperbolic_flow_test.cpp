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
#include <ricci/error.h>
#include <ricci/metric/hyperbolic.h>

#include <gtest/gtest.h>

#include <algorithm>
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
		for (std::uint64_t seed : {1, 2})
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
	const FlipHistory& history = flow.result.history;
	EdgeArray<char> flipped(flow.base().edgeCount(), 0);
	for (const std::vector<Edge>* flips : {&history.startFlips, &history.flowFlips})
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
		for (std::uint64_t seed : {1, 2, 3}) {
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

TEST(HyperbolicFlow, FreeBoundaryKeepsItsCircles)
{
	Random random(540);
	const SurfaceMesh mesh = withoutStars(shaken(perforatedSlab(1, 4), 0.03, random), {0});
	const FlippedFlow flow(mesh, hyperbolicMetric(true));
	expectReached(flow);
	ASSERT_FALSE(flow.result.doubled);
	// All radii are scaled alike at the start.
	double factor = 0.0;
	for (const Vertex v : flow.base().vertices()) {
		if (!flow.surface().topology.boundary[v]) {
			EXPECT_NEAR(flow.result.curvature[v], 0.0, 1e-10);
			continue;
		}
		const double own = std::exp(flow.result.u[v]) / flow.result.history.startRadii[v];
		factor = factor == 0.0 ? own : factor;
		EXPECT_NEAR(own / factor, 1.0, 1e-14);
	}
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
			FlippingCurvatureMap<Hyperbolic> map(flow.result.metric->packing());
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
