// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/derivative.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/flow/hessian.h>
#include <ricci/metric/hyperbolic.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ricci::testing {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

using Map = GeometricCurvatureMap<Euclidean>;

/// Two triangles of a flat torus, one of them cut into three by a second vertex: loops at the first
/// vertex, and several edges between the two.
Packed twoVertexTorus()
{
	// Square lattice with a sheared second vector; first triangle (0,0) (1,0) (1.2,1), with a point
	// inside, second (0,0) (1.2,1) (0.2,1). Sides 3 f + k.
	const std::vector<Triangle> triangles{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 0}};
	// Side 0 of faces 0, 1, 2: bottom, right, diagonal. Sides 1 and 2 lead to the inner vertex.
	// Face 3: diagonal, top, left.
	const std::vector<int> glued{10, 5, 7, 11, 8, 1, 9, 2, 4, 6, 0, 3};
	const Triangulation t(2, triangles, glued);
	const Point3 corner[]{{0, 0, 0}, {1, 0, 0}, {1.2, 1, 0}}, inside{0.7, 0.3, 0};
	std::vector<double> lengths(at(t.edgeCount()), 0.0);
	for (int f = 0; f < 3; ++f) {
		const auto h = t.halfedges(f);
		lengths[at(Triangulation::edge(h[0]))] = distance(corner[f], corner[(f + 1) % 3]);
		lengths[at(Triangulation::edge(h[1]))] = distance(corner[(f + 1) % 3], inside);
		lengths[at(Triangulation::edge(h[2]))] = distance(corner[f], inside);
	}
	return Packed(t, lengths);
}

std::vector<Packed> smallSurfaces()
{
	Random random(50);
	return {
		Packed(tetrahedron()),
		Packed(bumpyTorus(8, 6, random)),
		Packed(sliverDisk(7, 3.0, random)),
		Packed(ring(1, 3, 8, 3)),
		Packed(shaken(perforatedSlab(2, 1), 0.03, random)),
		twoVertexTorus()};
}

TEST(Hessian, EveryEntryIsTheDerivativeOfTheCurvature)
{
	// Central differences D(h) have the error c h^2 + O(h^4) + noise / h. The first term is
	// measured by D(h) - D(h/2) = 3/4 c h^2 and removed by Richardson extrapolation; what remains
	// is noise and a term of the order of the square of the first, relative to the entry.
	Random random(51);
	for (const Packed& mesh : smallSurfaces()) {
		Map map = mesh.map();
		Eigen::VectorXd u = mesh.u();
		for (double& x : u)
			x += random.real(-1e-3, 1e-3);
		map.evaluate(u);
		ASSERT_EQ(map.brokenTriangles(), 0);
		const Eigen::MatrixXd H = denseHessian(map);
		const double largest = H.cwiseAbs().maxCoeff();
		// A sliver's angles vary on the scale of the reciprocal of its weights.
		const double h = 1e-4 / std::max(1.0, largest);
		const double noise = 16 * kEpsilon * std::max(map.needleRatio(), largest * 4.0) / h;
		EXPECT_LT(noise, 1e-4 * largest);
		for (Eigen::Index j = 0; j < u.size(); ++j) {
			const Eigen::VectorXd coarse = curvatureSlope(map, u, j, h);
			const Eigen::VectorXd fine = curvatureSlope(map, u, j, 0.5 * h);
			const Eigen::VectorXd extrapolated = (4.0 * fine - coarse) / 3.0;
			for (Eigen::Index i = 0; i < u.size(); ++i) {
				const double truncation = std::abs(coarse[i] - fine[i]);
				EXPECT_LT(truncation, 1e-5 * largest + noise);
				EXPECT_NEAR(extrapolated[i], H(i, j), noise + 0.1 * truncation)
					<< "entry " << i << ", " << j;
			}
		}
	}
}

TEST(Hessian, LoopEdgesCountTwiceInTheHyperbolicPlane)
{
	const Packed torus = twoVertexTorus();
	CirclePacking packing = torus.packing;
	GeometricCurvatureMap<Hyperbolic> map(packing);
	Eigen::VectorXd u(2);
	for (Eigen::Index v = 0; v < 2; ++v)
		u[v] = std::log(std::tanh(0.5 * torus.radii[at(static_cast<int>(v))]));
	map.evaluate(u);
	ASSERT_EQ(map.brokenTriangles(), 0);
	const Eigen::MatrixXd H = denseHessian(map);
	for (Eigen::Index j = 0; j < 2; ++j) {
		const Eigen::VectorXd coarse = curvatureSlope(map, u, j, 1e-3);
		const Eigen::VectorXd fine = curvatureSlope(map, u, j, 5e-4);
		const Eigen::VectorXd extrapolated = (4.0 * fine - coarse) / 3.0;
		for (Eigen::Index i = 0; i < 2; ++i)
			EXPECT_NEAR(extrapolated[i], H(i, j), 1e-7 * H.cwiseAbs().maxCoeff());
	}
}

TEST(Hessian, RowsSumToZero)
{
	for (const Packed& mesh : smallSurfaces()) {
		Map map = mesh.map();
		map.evaluate(mesh.u());
		const Eigen::MatrixXd H = denseHessian(map);
		const Eigen::VectorXd rowSums = H.rowwise().sum(), rowSizes = H.cwiseAbs().rowwise().sum();
		for (Eigen::Index i = 0; i < H.rows(); ++i)
			EXPECT_NEAR(rowSums[i], 0.0, 16 * kEpsilon * rowSizes[i]);
	}
}

TEST(Hessian, PositiveSemiDefiniteWithTheConstantsAsKernel)
{
	Random random(52);
	for (const Packed& mesh : smallSurfaces())
		for (double spread : {0.0, 1e-2, 0.1}) {
			Map map = mesh.map();
			Eigen::VectorXd u = mesh.u();
			for (double& x : u)
				x += random.real(-spread, spread);
			map.evaluate(u);
			if (map.brokenTriangles() > 0)
				continue;
			const Eigen::MatrixXd H = denseHessian(map);
			const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(H);
			const double rounding = 1e-14 * eigen.eigenvalues().tail<1>()[0];
			EXPECT_NEAR(eigen.eigenvalues()[0], 0.0, rounding);
			EXPECT_GT(eigen.eigenvalues()[1], 10 * rounding);
		}
}

TEST(Hessian, ManyEdgesBetweenTwoVerticesShareAnEntry)
{
	const Packed mesh = twoVertexTorus();
	ASSERT_EQ(mesh.triangulation.eulerCharacteristic(), 0);
	ASSERT_EQ(mesh.triangulation.edgeCount(), 6);
	Map map = mesh.map();
	map.evaluate(mesh.u());
	EXPECT_LT(map.curvature().lpNorm<Eigen::Infinity>(), 1e-14); // the torus is flat
	double sum = 0.0;
	for (int e = 0; e < 6; ++e)
		if (mesh.triangulation.origin(2 * e) != mesh.triangulation.target(2 * e))
			sum += map.weights()[at(e)];
	const Eigen::MatrixXd H = denseHessian(map);
	EXPECT_NEAR(H(0, 1), -sum, 1e-13);
	EXPECT_NEAR(H(0, 0), sum, 1e-13);
	EXPECT_GT(sum, 0.1);
}

TEST(Hessian, RestrictsToTheUnknownVertices)
{
	Random random(53);
	const Packed mesh(randomPlanarDisk(5, random));
	Map map = mesh.map();
	map.evaluate(mesh.u());
	const Eigen::MatrixXd all = denseHessian(map);
	const int n = mesh.triangulation.vertexCount();
	std::vector<int> unknown(at(n), -1), kept;
	for (int v = n - 1; v >= 0; --v) // rows in another order than the vertices
		if (v % 3 != 0) {
			unknown[at(v)] = static_cast<int>(kept.size());
			kept.push_back(v);
		}
	Hessian hessian;
	hessian.layOut(map, unknown, static_cast<int>(kept.size()));
	hessian.fill(map, 0.5);
	const Eigen::MatrixXd part = bothTriangles(hessian.matrix());
	for (Eigen::Index i = 0; i < part.rows(); ++i)
		for (Eigen::Index j = 0; j < part.cols(); ++j)
			EXPECT_NEAR(
				part(i, j),
				all(kept[static_cast<std::size_t>(i)], kept[static_cast<std::size_t>(j)]) +
					(i == j ? 0.5 : 0.0),
				1e-13);
	double largest = 0.0;
	for (Eigen::Index i = 0; i < part.rows(); ++i)
		largest = std::max(largest, part(i, i));
	EXPECT_EQ(hessian.largestDiagonal(), largest);
	// Only the lower triangle is stored, in the order that direct solvers want.
	for (int c = 0; c < hessian.matrix().outerSize(); ++c) {
		int last = c - 1;
		for (Hessian::Matrix::InnerIterator entry(hessian.matrix(), c); entry; ++entry) {
			EXPECT_GT(entry.row(), last);
			last = static_cast<int>(entry.row());
		}
	}
}

} // namespace
} // namespace ricci::testing
