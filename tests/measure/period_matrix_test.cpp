// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces whose period matrix is known: flat tori, squares, and hyperelliptic curves.
#include "support/complex.h"
#include "support/intrinsic.h"
#include "support/matrices.h"
#include "support/random.h"
#include "support/reflected.h"

#include <ricci/parametrize.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

/// With the surface's own curvature, so that the flow has nothing to do, or flat.
Report reportOf(const SurfaceMesh& mesh, TargetCurvature target = TargetCurvature::Prescribed)
{
	Options options;
	options.target = target;
	options.finish = Finish::None;
	options.charts = Charts::OfTheFlow;
	VertexInput input;
	input.targetCurvature = curvatureInSpace(mesh);
	input.precision = 1e-13;
	return parametrizeEuclidean(mesh, input, options).report;
}

Eigen::MatrixXcd omegaOf(const Report& report)
{
	const Eigen::Index genus = report.genus;
	EXPECT_EQ(report.periodMatrix.size(), static_cast<std::size_t>(genus * genus));
	const Eigen::MatrixXcd omega = Eigen::Map<const Eigen::MatrixXcd>(
		report.periodMatrix.data(), genus, genus); // symmetric, so that rows are columns
	expectPeriodMatrix(omega, genus);
	return omega;
}

double errorOf(const Report& report)
{
	return report.periodError.value_or(HUGE_VAL);
}

/// Points at random in faces of a mesh, which change nothing but its triangles.
SurfaceMesh withPoints(SurfaceMesh mesh, int count, Random& random)
{
	for (; count > 0; --count) {
		Triangle& t = mesh.triangles[at(random.index(static_cast<int>(mesh.triangles.size())))];
		const double x = random.real(0.1, 0.4), y = random.real(0.1, 0.4);
		const int v = static_cast<int>(mesh.positions.size());
		mesh.positions.push_back(
			(1 - x - y) * mesh.positions[at(t[0])] + x * mesh.positions[at(t[1])] +
			y * mesh.positions[at(t[2])]);
		const auto [a, b, c] = t;
		t = {a, b, v};
		mesh.triangles.push_back({b, c, v});
		mesh.triangles.push_back({c, a, v});
	}
	return mesh;
}

TEST(PeriodMatrix, OfAFlatTorusIsItsModulus)
{
	Random random(501);
	for (int trial = 0; trial < 20; ++trial) {
		const int nx = 1 + random.index(4), ny = 1 + random.index(4), shift = random.index(nx);
		const double height = random.real(0.3, 3.0);
		const Complex tau(double(shift) / nx, ny * height / nx);
		const SurfaceMesh mesh = withPoints(
			tiledTorus(rectangleTile(2, 3, 1.0, height), nx, ny, shift), 10 * (trial % 3), random);
		const Report report = reportOf(mesh);
		EXPECT_LT(classDistance(omegaOf(report), Eigen::MatrixXcd::Constant(1, 1, tau), 0.1), 1e-9);
		EXPECT_LT(errorOf(report), 1e-8); // no cones, no error but rounding
		// Of the classes of 1 x 1 matrices one is in the fundamental domain.
		const Complex reduced = report.periodMatrix[0];
		EXPECT_LE(std::abs(reduced.real()), 0.5 + 1e-9);
		EXPECT_GE(std::abs(reduced), 1.0 - 1e-9);
		const Report flat = reportOf(mesh, TargetCurvature::Flat);
		EXPECT_NEAR(flat.torusTauIm.value_or(0.0), reduced.imag(), 1e-8);
		EXPECT_NEAR(std::abs(flat.torusTauRe.value_or(2.0)), std::abs(reduced.real()), 1e-8);
	}
}

/// Twists leave no symmetry, and one torus is the mirror image of the other.
TEST(PeriodMatrix, OfAMirrorImageIsMinusTheConjugate)
{
	const Tile tile = rectangleTile(2, 2, 1.0, 1.3);
	const Eigen::MatrixXcd one = omegaOf(reportOf(tiledTorus(tile, 5, 5, 1))),
						   other = omegaOf(reportOf(tiledTorus(tile, 5, 5, 4)));
	EXPECT_LT(classDistance(one, -other.conjugate(), 0.1), 1e-10);
	EXPECT_GT(classDistance(one, other, 1.0), 0.1);
}

/// The L of three squares with opposite sides glued. Its turn by pi / 2 has the eigenform dz for i, whose
/// periods are known, and one for -i, which is then given by that its product with dz is 0.
TEST(PeriodMatrix, OfThreeSquares)
{
	Eigen::Matrix2cd exact;
	exact << Complex(0.0, 5.0), Complex(0.0, -4.0), Complex(0.0, -4.0), Complex(0.0, 5.0);
	for (const int n : {2, 3, 6})
		EXPECT_LT(
			classDistance(
				exact / 3.0,
				omegaOf(reportOf(squareTiled(rectangleTile(n, n, 1, 1), {1, 0, 2}, {2, 1, 0}))),
				0.05),
			1e-11);
}

/// The symmetries, which leave no choice, are those of the triangles too. The error falls with a power of the edges'
/// lengths, which the largest cone angle a tells: 4 pi / a.
TEST(PeriodMatrix, OfHyperellipticCurves)
{
	const struct
	{
		int roots;
		Branched branched;
		int polygon; ///< of which opposite sides are glued
		double cone; ///< largest angle, over pi
	} cases[] = {
		{4, Branched::Both, 8, 4.0},
		{5, Branched::One, 10, 4.0},
		{6, Branched::Both, 12, 4.0},
		{7, Branched::One, 14, 4.0},
		{6, Branched::Neither, 0, 8.0 / 3.0}};
	// y^2 = x^6 - 1, and the Bolza curve y^2 = x^5 - x once more [Bobenko Mercat Schmies 2011].
	const Complex i(0.0, 1.0);
	Eigen::Matrix2cd hexagons, bolza;
	hexagons << 2.0 * i, -i, -i, 2.0 * i;
	bolza << -2.0 + std::sqrt(8.0) * i, 1.0 - std::sqrt(2.0) * i, 1.0 - std::sqrt(2.0) * i,
		-2.0 + std::sqrt(8.0) * i;
	EXPECT_LT(classDistance(bolza / 3.0, omegaOfPolygon(8), 0.05), 1e-12);
	for (const auto& c : cases) {
		SCOPED_TRACE(c.roots);
		Eigen::MatrixXcd exact = hexagons / std::sqrt(3.0);
		if (c.polygon > 0)
			exact = omegaOfPolygon(c.polygon);
		expectPeriodMatrix(exact, (c.roots + static_cast<int>(c.branched)) / 2 - 1);
		std::vector<double> errors;
		for (const int n : {3, 6, 12}) {
			const Report report = reportOf(hyperelliptic(c.roots, c.branched, n));
			EXPECT_LT(classDistance(exact, omegaOf(report), 0.05), 1e-11);
			errors.push_back(errorOf(report));
		}
		EXPECT_NEAR(std::log2(errors[1] / errors[2]), 4.0 / c.cone, 0.1);
	}
}

/// Points at random break the symmetry.
TEST(PeriodMatrix, ErrorIsABoundOnFlatTriangles)
{
	Random random(502);
	for (const auto& [roots, branched, polygon] :
		 {std::tuple(4, Branched::Both, 8),
		  std::tuple(5, Branched::One, 10),
		  std::tuple(6, Branched::Both, 12)})
		for (const int n : {3, 5}) {
			const SurfaceMesh mesh = hyperelliptic(roots, branched, n);
			const Report report = reportOf(withPoints(mesh, 100, random));
			const double distance = classDistance(
				omegaOfPolygon(polygon), omegaOf(report), std::min(0.3, errorOf(report)));
			EXPECT_LE(distance, errorOf(report));
			EXPECT_GT(distance, 1e-6);
		}
}

/// Energies of the piecewise linear harmonic forms with integer periods on a torus of rows of
/// \p nv cells, by dense matrices. Two forms are that which is 1 where an edge leaves the last row of cells.
Eigen::Matrix2d harmonicEnergies(const SurfaceMesh& mesh, int nv)
{
	const auto n = static_cast<Eigen::Index>(mesh.positions.size());
	const auto past = [](int from, int to) { // the end; 0, or +-1
		return std::abs(to - from) <= 1 ? 0.0 : to < from ? 1.0 : -1.0;
	};
	Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(n, n), right = Eigen::MatrixXd::Zero(n, 2);
	Eigen::Matrix2d energy = Eigen::Matrix2d::Zero();
	for (const Triangle& t : mesh.triangles)
		for (std::size_t k = 0; k < 3; ++k) {
			const int v = t[k], w = t[(k + 1) % 3];
			const Point3 x = mesh.positions[at(v)] - mesh.positions[at(t[(k + 2) % 3])],
						 y = mesh.positions[at(w)] - mesh.positions[at(t[(k + 2) % 3])];
			const double weight = 0.5 * dot(x, y) / length(cross(x, y)); // the cotangent
			const Eigen::RowVector2d form(past(v / nv, w / nv), past(v % nv, w % nv));
			laplacian(v, v) += weight;
			laplacian(w, w) += weight;
			laplacian(v, w) -= weight;
			laplacian(w, v) -= weight;
			right.row(w) -= weight * form;
			right.row(v) += weight * form;
			energy += weight * form.transpose() * form;
		}
	const Eigen::MatrixXd functions = leastNormSolution(laplacian, right);
	return energy - right.transpose() * functions;
}

/// For genus 1 the eigenvalues of J^-1 E are +-i k with k^2 = det E. The triangles of a torus of revolution are
/// Delaunay. On finer ones the error falls with the square of the edges' lengths, and the modulus tends to
/// i sqrt(R^2 - r^2) / r.
TEST(PeriodMatrix, ErrorIsTheLogarithmOfTheLargestEigenvalue)
{
	for (const int nu : {7, 8, 12}) {
		const int nv = 6;
		const SurfaceMesh mesh = torus(2.0, 1.0, nu, nv);
		const double k = std::sqrt(harmonicEnergies(mesh, nv).determinant());
		EXPECT_GT(k, 1.001);
		EXPECT_NEAR(errorOf(reportOf(mesh)), std::log(k), 1e-9);
	}
	std::vector<double> errors;
	for (const int n : {16, 32, 64}) {
		const Report report = reportOf(torus(3.0, 1.0, 2 * n, n), TargetCurvature::Flat);
		errors.push_back(errorOf(report));
		EXPECT_LT(
			std::abs(std::log(report.periodMatrix.at(0).imag() / std::sqrt(8.0))), 50.0 / n / n);
	}
	EXPECT_NEAR(errors[1] / errors[2], 4.0, 0.3);
}

} // namespace
} // namespace ricci::testing
