// SPDX-License-Identifier: GPL-3.0-or-later
// CurvatureMap and Hessian with the hyperbolic background.
#include "support/derivative.h"
#include "support/flipped_flow.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/flow/hessian.h>
#include <ricci/metric/hyperbolic.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

using Fixed = GeometricCurvatureMap<Hyperbolic>;
using Flipping = FlippingCurvatureMap<Hyperbolic>;

std::vector<Packed> smallSurfaces()
{
	Random random(90);
	return {
		Packed(tetrahedron()),
		Packed(bumpyTorus(8, 6, random)),
		Packed(randomPlanarDisk(5, random)),
		Packed(sliverDisk(6, 2.0, random)),
		Packed(ring(1, 3, 8, 3)),
		Packed(shaken(perforatedSlab(2, 1), 0.05, random))};
}

/// The packing's circles, the largest of hyperbolic size: u = \p largest.
VertexVector hyperbolicU(const Packed& mesh, double largest)
{
	const VertexVector u = mesh.u();
	return (u.array() + (largest - u.maxCoeff())).matrix();
}

VertexVector disturbed(VertexVector u, double spread, Random& random)
{
	for (double& x : u)
		x = std::min(x + random.real(-spread, spread), -1e-2);
	return u;
}

/// The derivative of K by u_j where the combinatorics of the map are kept: central differences,
/// extrapolated.
Eigen::MatrixXd differences(const CurvatureMap& state, const VertexVector& u)
{
	Fixed map(CirclePacking{state.triangulation(), state.delta()});
	Eigen::MatrixXd derivative(u.size(), u.size());
	const double h = 1e-3 * std::min(1.0, -u.maxCoeff());
	for (const Vertex j : u.indices()) {
		const auto slope = [&](double step) { return curvatureSlope(map, u, j, step); };
		const VertexVector a = slope(h), b = slope(h / 2), c = slope(h / 4);
		const VertexVector ab = (4 * b - a) / 3, bc = (4 * c - b) / 3;
		derivative.col(j.number()) = (16 * bc - ab) / 15;
	}
	return derivative;
}

void expectDerivative(const CurvatureMap& map, const VertexVector& u)
{
	ASSERT_EQ(map.brokenTriangles(), 0);
	const Eigen::MatrixXd H = denseHessian(map), D = differences(map, u);
	const double largest = H.cwiseAbs().maxCoeff();
	// K is rounded to a double before the differences are taken.
	const double noise = 64 * kEpsilon / (1e-3 * std::min(1.0, -u.maxCoeff()));
	for (const Vertex i : u.indices())
		for (const Vertex j : u.indices())
			EXPECT_NEAR(
				D(i.number(), j.number()),
				H(i.number(), j.number()),
				2e-8 * largest + noise * (1 + largest))
				<< "entry " << i.number() << ", " << j.number();
}

TEST(HyperbolicMap, AnglesFollowTheLawOfCosines)
{
	Random random(91);
	int checked = 0;
	for (const Packed& mesh : smallSurfaces())
		for (double largest : {-0.1, -1.0, -3.0}) {
			const VertexVector u = disturbed(hyperbolicU(mesh, largest), 0.02, random);
			Fixed map(mesh.packing);
			map.evaluate(u);
			if (map.brokenTriangles() > 0)
				continue;
			++checked;
			const HyperbolicMeasure measure(map.triangulation(), map.lengths());
			for (const Vertex v : measure.curvature.indices())
				EXPECT_NEAR(
					map.curvature()[v],
					static_cast<double>(measure.curvature[v]),
					4 * kEpsilon * (16 + static_cast<double>(measure.sensitivity[v])));
		}
	EXPECT_GT(checked, 14);
}

TEST(HyperbolicMap, HessianIsTheDerivativeOfTheCurvature)
{
	Random random(92);
	int checked = 0;
	for (const Packed& mesh : smallSurfaces())
		for (double largest : {-0.2, -1.0, -4.0}) {
			SCOPED_TRACE(largest);
			const VertexVector u = disturbed(hyperbolicU(mesh, largest), 0.02, random);
			Fixed map(mesh.packing);
			map.evaluate(u);
			if (map.brokenTriangles() > 0)
				continue;
			++checked;
			expectDerivative(map, u);
		}
	EXPECT_GE(checked, 14);
}

/// The same far from the start, where flips have changed the triangulation.
TEST(HyperbolicMap, HessianIsTheDerivativeOfTheCurvatureAfterFlips)
{
	Random random(93);
	std::size_t flips = 0;
	for (const Packed& mesh : smallSurfaces())
		for (double largest : {-0.2, -1.0, -3.0})
			for (double spread : {0.3, 1.0}) {
				SCOPED_TRACE(largest);
				if (!mesh.triangulation.boundaryLoops().empty())
					continue; // edges of the boundary cannot flip: triangles may break
				const VertexVector u = disturbed(hyperbolicU(mesh, largest), spread, random);
				Flipping map(mesh.packing);
				map.evaluate(u);
				map.accept();
				flips += map.flips().size();
				expectDerivative(map, u);
			}
	EXPECT_GT(flips, 50u);
}

TEST(HyperbolicMap, DiagonalIsTheWeightsTimesCoshOfTheLengths)
{
	Random random(94);
	for (const Packed& mesh : smallSurfaces()) {
		const VertexVector u = disturbed(hyperbolicU(mesh, -0.5), 0.01, random);
		Fixed map(mesh.packing);
		map.evaluate(u);
		const Triangulation& t = map.triangulation();
		const Eigen::MatrixXd H = denseHessian(map);
		VertexVector diagonal = VertexVector::Zero(u.size());
		for (const Edge e : t.edges()) {
			const double cosine = std::cosh(map.lengths()[e]);
			EXPECT_NEAR((1 + map.cosineLess1()[e]) / cosine, 1.0, 1e-13);
			ASSERT_NE(t.origin(e.halfedge()), t.target(e.halfedge()));
			diagonal[t.origin(e.halfedge())] += map.weights()[e] * cosine;
			diagonal[t.target(e.halfedge())] += map.weights()[e] * cosine;
		}
		for (const Vertex v : u.indices())
			EXPECT_NEAR(H(v.number(), v.number()), diagonal[v], 1e-12 * H.cwiseAbs().maxCoeff());
	}
}

/// Where every edge is weighted Delaunay no triangle breaks, all weights are non-negative, and the
/// Hessian is strictly positive definite.
TEST(HyperbolicMap, WeightsAreNotNegativeOnTheWeightedDelaunayTriangulation)
{
	Random random(95);
	std::size_t flips = 0;
	const Packed meshes[] = {
		Packed(tetrahedron()),
		Packed(bumpyTorus(8, 6, random)),
		Packed(shaken(perforatedSlab(2, 1), 0.05, random)),
		Packed(shaken(perforatedSlab(3, 2), 0.05, random))};
	for (const Packed& mesh : meshes)
		for (double largest : {-1e-2, -1.0, -6.0})
			for (double spread : {0.5, 2.0, 5.0}) {
				Flipping map(mesh.packing);
				map.evaluate(disturbed(hyperbolicU(mesh, largest), spread, random));
				map.accept();
				flips += map.flips().size();
				EXPECT_EQ(map.brokenTriangles(), 0);
				const double most = *std::max_element(map.weights().begin(), map.weights().end());
				for (double w : map.weights())
					EXPECT_GE(w, -1e-13 * most);
				const Eigen::MatrixXd H = denseHessian(map);
				const Eigen::VectorXd scale = H.diagonal().cwiseSqrt().cwiseInverse();
				const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
					scale.asDiagonal() * H * scale.asDiagonal());
				EXPECT_GT(eigen.eigenvalues()[0], 0.0);
			}
	EXPECT_GT(flips, 300u);
}

TEST(HyperbolicMap, GaussBonnet)
{
	Random random(96);
	int checked = 0;
	for (const Packed& mesh : smallSurfaces()) {
		const VertexVector u = disturbed(hyperbolicU(mesh, -0.3), 0.01, random);
		Fixed map(mesh.packing);
		map.evaluate(u);
		if (map.brokenTriangles() > 0)
			continue;
		++checked;
		const HyperbolicMeasure measure(map.triangulation(), map.lengths());
		EXPECT_NEAR(
			map.curvature().sum() - 2 * kPi * map.triangulation().eulerCharacteristic(),
			static_cast<double>(measure.area),
			1e-12 * (1 + static_cast<double>(measure.area)));
	}
	EXPECT_GT(checked, 4);
}

/// Circles of radius 2 exp(u) -> 0: lengths, angles and weights become the Euclidean ones, and
/// differ by the square of the size.
TEST(HyperbolicMap, SmallSurfacesAreEuclidean)
{
	struct Gap
	{
		double lengths = 0.0, angles = 0.0, weights = 0.0;
	};
	for (const Packed& mesh : smallSurfaces()) {
		GeometricCurvatureMap<Euclidean> flat(mesh.packing);
		flat.evaluate(mesh.u());
		const double scaleOfWeights = std::abs(
			*std::max_element(flat.weights().begin(), flat.weights().end(), [](double a, double b) {
				return std::abs(a) < std::abs(b);
			}));
		const auto gapAt = [&](double largest) {
			const VertexVector u = hyperbolicU(mesh, largest);
			Fixed map(mesh.packing);
			map.evaluate(u);
			const double factor = 2.0 * std::exp(u[Vertex(0)] - mesh.u()[Vertex(0)]);
			Gap gap;
			for (const Edge e : map.lengths().indices()) {
				gap.lengths = std::max(
					gap.lengths, std::abs(map.lengths()[e] / flat.lengths()[e] / factor - 1.0));
				gap.weights = std::max(
					gap.weights, std::abs(map.weights()[e] - flat.weights()[e]) / scaleOfWeights);
			}
			for (const Halfedge h : map.angles().indices())
				gap.angles = std::max(gap.angles, std::abs(map.angles()[h] - flat.angles()[h]));
			return gap;
		};
		const Gap coarse = gapAt(-7.0), fine = gapAt(-8.0), none = gapAt(-20.0);
		const double ratio = std::exp(2.0);
		EXPECT_NEAR(coarse.lengths / fine.lengths, ratio, 0.1);
		EXPECT_NEAR(coarse.angles / fine.angles, ratio, 0.1);
		EXPECT_NEAR(coarse.weights / fine.weights, ratio, 0.1);
		const double rounding = 32 * kEpsilon * (20 + flat.needleRatio() * scaleOfWeights);
		EXPECT_LT(none.lengths, rounding);
		EXPECT_LT(none.angles, rounding);
		EXPECT_LT(none.weights, rounding);
	}
}

} // namespace
} // namespace ricci::testing
