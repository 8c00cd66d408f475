// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/derivative.h"
#include "support/intrinsic.h"
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
	const Triangulation t = testing::glued(2, triangles, glued);
	const Point3 corner[]{{0, 0, 0}, {1, 0, 0}, {1.2, 1, 0}}, inside{0.7, 0.3, 0};
	EdgeArray<double> lengths(t.edgeCount(), 0.0);
	for (int f = 0; f < 3; ++f) {
		const auto h = t.halfedges(Face(f));
		lengths[h[0].edge()] = distance(corner[f], corner[(f + 1) % 3]);
		lengths[h[1].edge()] = distance(corner[(f + 1) % 3], inside);
		lengths[h[2].edge()] = distance(corner[f], inside);
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
		VertexVector u = mesh.u();
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
		for (const Vertex j : u.indices()) {
			const VertexVector coarse = curvatureSlope(map, u, j, h);
			const VertexVector fine = curvatureSlope(map, u, j, 0.5 * h);
			const VertexVector extrapolated = (4.0 * fine - coarse) / 3.0;
			for (const Vertex i : u.indices()) {
				const double truncation = std::abs(coarse[i] - fine[i]);
				EXPECT_LT(truncation, 1e-5 * largest + noise);
				EXPECT_NEAR(extrapolated[i], H(i.number(), j.number()), noise + 0.1 * truncation)
					<< "entry " << i.number() << ", " << j.number();
			}
		}
	}
}

TEST(Hessian, LoopEdgesCountTwiceInTheHyperbolicPlane)
{
	const Packed torus = twoVertexTorus();
	CirclePacking packing = torus.packing;
	GeometricCurvatureMap<Hyperbolic> map(packing);
	VertexVector u(2);
	for (const Vertex v : u.indices())
		u[v] = std::log(std::tanh(0.5 * torus.radii[v]));
	map.evaluate(u);
	ASSERT_EQ(map.brokenTriangles(), 0);
	const Eigen::MatrixXd H = denseHessian(map);
	for (const Vertex j : u.indices()) {
		const VertexVector coarse = curvatureSlope(map, u, j, 1e-3);
		const VertexVector fine = curvatureSlope(map, u, j, 5e-4);
		const VertexVector extrapolated = (4.0 * fine - coarse) / 3.0;
		for (const Vertex i : u.indices())
			EXPECT_NEAR(extrapolated[i], H(i.number(), j.number()), 1e-7 * H.cwiseAbs().maxCoeff());
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
	int checked = 0;
	for (const Packed& mesh : smallSurfaces())
		for (double spread : {0.0, 1e-2, 0.1}) {
			Map map = mesh.map();
			VertexVector u = mesh.u();
			for (double& x : u)
				x += random.real(-spread, spread);
			map.evaluate(u);
			if (map.brokenTriangles() > 0)
				continue;
			++checked;
			const Eigen::MatrixXd H = denseHessian(map);
			const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(H);
			const double rounding = 1e-14 * eigen.eigenvalues().tail<1>()[0];
			EXPECT_NEAR(eigen.eigenvalues()[0], 0.0, rounding);
			EXPECT_GT(eigen.eigenvalues()[1], 10 * rounding);
		}
	EXPECT_GT(checked, 14);
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
	for (const Edge e : mesh.triangulation.edges())
		if (mesh.triangulation.origin(e.halfedge()) != mesh.triangulation.target(e.halfedge()))
			sum += map.weights()[e];
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
	VertexArray<int> unknown(n, -1);
	std::vector<int> kept;
	for (int v = n - 1; v >= 0; --v) // rows in another order than the vertices
		if (v % 3 != 0) {
			unknown[Vertex(v)] = static_cast<int>(kept.size());
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
