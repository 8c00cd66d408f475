// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces whose period matrix is known: flat tori, and regular polygons with sides glued.
#include "support/bolza.h"
#include "support/complex.h"
#include "support/flat_map.h"
#include "support/intrinsic.h"
#include "support/listener.h"
#include "support/packed.h"
#include "support/random.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/base/numbers.h>
#include <ricci/math/disjoint_sets.h>
#include <ricci/measure/distortion.h>
#include <ricci/measure/invariants.h>
#include <ricci/measure/period_matrix.h>

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

using Vectors = std::vector<Eigen::VectorXd>;

/// All vectors x of integers but 0 with x^T \p gram x <= \p bound.
Vectors shortVectors(const Eigen::MatrixXd& gram, double bound)
{
	const Eigen::MatrixXd upper = gram.llt().matrixU();
	const Eigen::Index n = gram.rows();
	Vectors found;
	Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
	const std::function<void(Eigen::Index, double)> choose = [&](Eigen::Index i, double left) {
		if (i < 0) {
			if (!x.isZero(0.0))
				found.push_back(x);
			return;
		}
		const double others = upper.row(i).tail(n - i - 1).dot(x.tail(n - i - 1));
		const double centre = -others / upper(i, i), reach = std::sqrt(left) / upper(i, i);
		for (double k = std::ceil(centre - reach); k <= centre + reach; ++k) {
			x[i] = k;
			const double rest = left - std::pow(upper(i, i) * (k - centre), 2);
			choose(i - 1, std::max(0.0, rest));
		}
		x[i] = 0.0;
	};
	choose(n - 1, bound);
	return found;
}

/// Energies of the real harmonic forms of a surface with this period matrix, in the basis of their
/// periods along a1, ..., ag, b1, ..., bg: symmetric, positive definite and symplectic.
Eigen::MatrixXd energyOf(const Eigen::MatrixXcd& omega)
{
	// A form with the periods a and b is Re (c w) with w's periods 1 and X + iY, so that
	// Im c = Y^-1 (X a - b), and its energy is Re c^T Y Re c + Im c^T Y Im c.
	const Eigen::Index g = omega.rows();
	const Eigen::MatrixXd x = omega.real(), y = omega.imag(), inverse = y.inverse();
	Eigen::MatrixXd energy(2 * g, 2 * g);
	energy << y + x * inverse * x, -x * inverse, -inverse * x, inverse;
	return energy;
}

/// Distance of two points of the Siegel upper half space: of the logarithms of the eigenvalues of one
/// energy against the other the largest.
double siegelDistance(const Eigen::MatrixXd& one, const Eigen::MatrixXd& two)
{
	const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
		one, two, Eigen::EigenvaluesOnly);
	return solver.eigenvalues().array().log().abs().maxCoeff();
}

/// The least distance of two period matrices over all bases, that is over Sp(2g,Z); infinity where it is
/// above \p radius. A search: an energy within the radius leaves few vectors of the lattice for each
/// vector of the basis.
double classDistance(const Eigen::MatrixXcd& one, const Eigen::MatrixXcd& two, double radius)
{
	const Eigen::MatrixXd a = energyOf(one), b = energyOf(two);
	const Eigen::Index n = a.rows(), g = n / 2;
	Eigen::MatrixXd product = Eigen::MatrixXd::Zero(n, n);
	product.topRightCorner(g, g).setIdentity();
	product.bottomLeftCorner(g, g) = -product.topRightCorner(g, g);
	const double stretch = std::exp(radius);
	struct Candidate
	{
		Eigen::VectorXd vector, dual, product;
	};
	std::vector<Candidate> candidates;
	for (const Eigen::VectorXd& v : shortVectors(a, stretch * b.diagonal().maxCoeff()))
		candidates.push_back({v, a * v, product * v});
	double best = std::numeric_limits<double>::infinity();
	Eigen::MatrixXd basis(n, n);
	const std::function<void(Eigen::Index)> choose = [&](Eigen::Index i) {
		if (i == n) {
			const double d = siegelDistance(basis.transpose() * a * basis, b);
			best = d <= radius ? std::min(best, d) : best;
			return;
		}
		const Eigen::VectorXd wanted = product.col(i);
		for (const Candidate& c : candidates) {
			bool fits = true;
			for (Eigen::Index j = i; fits && j >= 0; --j) {
				const double slack = (stretch - 1.0) * std::sqrt(b(i, i) * b(j, j)) + 1e-12;
				const Eigen::Ref<const Eigen::VectorXd> other =
					j == i ? Eigen::Ref<const Eigen::VectorXd>(c.vector) : basis.col(j);
				fits = std::abs(other.dot(c.dual) - b(j, i)) <= slack &&
					   other.dot(c.product) == wanted[j];
			}
			if (fits) {
				basis.col(i) = c.vector;
				choose(i + 1);
			}
		}
	};
	choose(0);
	return best;
}

/// Triangles with the lengths of their sides, glued side by side: side 3 f + k runs from corner k of f.
struct Pieces
{
	std::vector<double> length; ///< [side]
	std::vector<int> glued;     ///< [side]

	void glue(int a, int b)
	{
		glued[at(a)] = b;
		glued[at(b)] = a;
	}

	IntrinsicMesh mesh() const
	{
		const int sides = static_cast<int>(glued.size());
		const auto next = [](int side) { return side % 3 == 2 ? side - 2 : side + 1; };
		DisjointSets corners(sides);
		for (int side = 0; side < sides; ++side)
			corners.merge(side, next(glued[at(side)]));
		std::vector<int> number(glued.size());
		int count = 0;
		for (int side = 0; side < sides; ++side)
			number[at(side)] =
				corners.find(side) == side ? count++ : number[at(corners.find(side))];
		std::vector<Triangle> triangles(glued.size() / 3);
		for (int side = 0; side < sides; ++side)
			triangles[at(side / 3)][at(side % 3)] = number[at(side)];
		IntrinsicMesh result = {testing::glued(count, triangles, glued), {}};
		result.lengths.resize(result.triangulation.edgeCount());
		for (const Face f : result.triangulation.faces())
			for (int k = 0; k < 3; ++k)
				result.lengths[result.triangulation.halfedges(f)[at(k)].edge()] =
					length[at(3 * f.number() + k)];
		return result;
	}
};

/// The torus of the lattice that 1 and \p tau span, of n^2 parallelograms.
IntrinsicMesh flatTorus(Complex tau, int n)
{
	Pieces p;
	p.glued.resize(at(6 * n * n));
	const auto cell = [&](int i, int j) { return 6 * (i % n + n * (j % n)); };
	for (int j = 0; j < n; ++j)
		for (int i = 0; i < n; ++i) {
			const double along = 1.0 / n, across = std::abs(tau) / n,
						 slant = std::abs(1.0 + tau) / n;
			p.length.insert(p.length.end(), {along, across, slant, slant, along, across});
			p.glue(cell(i, j) + 2, cell(i, j) + 3);
			p.glue(cell(i, j) + 1, cell(i + 1, j) + 5);
			p.glue(cell(i, j) + 4, cell(i, j + 1));
		}
	return p.mesh();
}

/// Unit squares of n^2 cells. \p right and \p above give each square's neighbours.
IntrinsicMesh squares(const std::vector<int>& right, const std::vector<int>& above, int n)
{
	Pieces p;
	const int count = static_cast<int>(right.size());
	p.glued.resize(at(6 * n * n * count));
	const auto cell = [&](int s, int i, int j) { return 6 * (i + n * (j + n * s)); };
	for (int s = 0; s < count; ++s)
		for (int j = 0; j < n; ++j)
			for (int i = 0; i < n; ++i) {
				const double side = 1.0 / n, slant = std::sqrt(2.0) / n;
				p.length.insert(p.length.end(), {side, side, slant, slant, side, side});
				p.glue(cell(s, i, j) + 2, cell(s, i, j) + 3);
				p.glue(
					cell(s, i, j) + 1,
					(i + 1 < n ? cell(s, i + 1, j) : cell(right[at(s)], 0, j)) + 5);
				p.glue(cell(s, i, j) + 4, j + 1 < n ? cell(s, i, j + 1) : cell(above[at(s)], i, 0));
			}
	return p.mesh();
}

/// A side of one of several polygons.
struct Side
{
	int polygon, side;
};

/// Regular polygons of triangles round their centres, each divided into n^2. \p angle is that at a
/// corner: that of the plane, or less, in the hyperbolic plane, whose triangles are given the sides of
/// the chords in the hyperboloid model. \p glue gives each side the one that it is glued to, the other
/// way round.
IntrinsicMesh
polygons(int count, int sides, double angle, int n, const std::function<Side(Side)>& glue)
{
	// Points of one sector in R^3: on the hyperboloid -xx - yy + zz = 1, or in the plane z = 1.
	const double turn = 2.0 * kPi / sides;
	const bool flat = angle > (1.0 - 1e-9) * (kPi - turn);
	const double cosh = 1.0 / (std::tan(0.5 * turn) * std::tan(0.5 * angle));
	const double sinh = flat ? 1.0 : std::sqrt(cosh * cosh - 1.0);
	const std::array<Eigen::Vector3d, 3> corner = {
		{{0.0, 0.0, 1.0},
		 {sinh, 0.0, flat ? 1.0 : cosh},
		 {sinh * std::cos(turn), sinh * std::sin(turn), flat ? 1.0 : cosh}}};
	const auto square = [](const Eigen::Vector3d& v) {
		return v[0] * v[0] + v[1] * v[1] - v[2] * v[2];
	};
	const auto point = [&](int i, int j) -> Eigen::Vector3d {
		const Eigen::Vector3d v = (n - i - j) * corner[0] + i * corner[1] + j * corner[2];
		return flat ? v / n : v / std::sqrt(-square(v));
	};
	const auto length = [&](int i, int j, int k, int l) {
		return std::sqrt(square(point(i, j) - point(k, l)));
	};
	// Triangle (i, j) of a sector has the corners (i, j), (i + 1, j), (i, j + 1); with "down" (i + 1, j),
	// (i + 1, j + 1), (i, j + 1).
	const auto up = [&](int polygon, int sector, int i, int j) {
		return 6 * (i + n * (j + n * ((sector + sides) % sides + sides * polygon)));
	};
	Pieces p;
	std::vector<int> used(
		at(2 * n * n * sides * count), -1); // the numbers of the triangles that exist
	p.length.resize(3 * used.size());
	p.glued.resize(3 * used.size(), -1);
	for (int q = 0; q < count; ++q)
		for (int s = 0; s < sides; ++s)
			for (int j = 0; j < n; ++j)
				for (int i = 0; i + j < n; ++i) {
					const int t = up(q, s, i, j), down = t + 3;
					p.length[at(t)] = length(i, j, i + 1, j);
					p.length[at(t + 1)] = length(i + 1, j, i, j + 1);
					p.length[at(t + 2)] = length(i, j + 1, i, j);
					if (i + j + 1 < n) {
						p.length[at(down)] = length(i + 1, j, i + 1, j + 1);
						p.length[at(down + 1)] = length(i + 1, j + 1, i, j + 1);
						p.length[at(down + 2)] = length(i, j + 1, i + 1, j);
						p.glue(t + 1, down + 2);
						p.glue(down + 1, up(q, s, i, j + 1));
						p.glue(down, up(q, s, i + 1, j) + 2);
					}
					else {
						const Side other = glue({q, s});
						p.glue(t + 1, up(other.polygon, other.side, j, i) + 1);
					}
					if (i == 0)
						p.glue(t + 2, up(q, s + 1, j, 0));
				}
	// Without the numbers that no triangle has.
	Pieces dense;
	int triangles = 0;
	for (std::size_t f = 0; f < used.size(); ++f)
		if (p.glued[3 * f] >= 0)
			used[f] = triangles++;
	for (std::size_t side = 0; side < p.glued.size(); ++side)
		if (p.glued[side] >= 0) {
			dense.length.push_back(p.length[side]);
			dense.glued.push_back(3 * used[at(p.glued[side] / 3)] + p.glued[side] % 3);
		}
	return dense.mesh();
}

/// The regular polygon of 4 g or 4 g + 2 sides with opposite sides glued, of genus g: the curve y^2 =
/// x^(2g+1) - x or y^2 = x^(2g+1) - 1.
IntrinsicMesh oppositeSides(int sides, double angle, int n)
{
	return polygons(1, sides, angle, n, [&](Side s) {
		return Side{0, (s.side + sides / 2) % sides};
	});
}

/// In the hyperbolic plane, without cones: the corners are one point or two.
IntrinsicMesh smoothPolygon(int sides, int n)
{
	return oppositeSides(sides, (sides % 4 == 0 ? 2.0 : 4.0) * kPi / sides, n);
}

/// Flat, with one or two cones of 2 pi (2 g - 1) or 2 pi g.
IntrinsicMesh flatPolygon(int sides, int n)
{
	return oppositeSides(sides, kPi - 2.0 * kPi / sides, n);
}

/// Its period matrix. Let cj be the closed path from the centre across side j. The rotation by one side,
/// by pi / m, takes cj to c(j+1) and dz to z^k dz e^(i pi (k + 1) / m), so that x^k dx / y for some powers
/// of the rotation has the periods e^(i pi (2 k + 1) j / m) on cj, and the cj meet once each in the
/// centre. From them, ai = c(2i) + s and bi = c(2i+1) + s with s = c0 - c1 + c2 - ... - c(2i-1) are
/// canonical.
Eigen::MatrixXcd omegaOfPolygon(int sides)
{
	const int m = sides / 2, genus = sides / 4;
	Eigen::MatrixXcd a(genus, genus), b(genus, genus);
	for (int k = 0; k < genus; ++k) {
		Complex sum = 0.0;
		for (int i = 0; i < genus; ++i) {
			const auto period = [&](int j) { return std::polar(1.0, kPi * (2 * k + 1) * j / m); };
			a(i, k) = period(2 * i) + sum;
			b(i, k) = period(2 * i + 1) + sum;
			sum += period(2 * i) - period(2 * i + 1);
		}
	}
	return b * a.inverse();
}

PeriodMatrix periodMatrixOf(const IntrinsicMesh& mesh)
{
	return periodMatrix(mesh.triangulation, mesh.lengths);
}

void expectPeriodMatrix(const Eigen::MatrixXcd& omega, int genus)
{
	ASSERT_EQ(omega.rows(), genus);
	ASSERT_EQ(omega.cols(), genus);
	EXPECT_LT((omega - omega.transpose()).cwiseAbs().maxCoeff(), 1e-12);
	const Eigen::MatrixXd imaginary = omega.imag();
	EXPECT_EQ(imaginary.llt().info(), Eigen::Success);
}

TEST(PeriodMatrix, OfAFlatTorusIsItsModulus)
{
	Random random(501);
	for (int trial = 0; trial < 20; ++trial) {
		const Complex tau(random.real(-2.0, 2.0), random.real(0.2, 3.0));
		for (const int n : {1, 2, 7}) { // from one vertex on
			IntrinsicMesh mesh = flatTorus(tau, n);
			for (const int flips : {0, n * n}) {
				flipIsometrically(mesh, flips, random);
				const PeriodMatrix periods = periodMatrixOf(mesh);
				expectPeriodMatrix(periods.omega, 1);
				EXPECT_LT(std::abs(periods.omega(0, 0) - reduceToFundamentalDomain(tau)), 1e-9);
				EXPECT_LT(periods.error, 1e-8); // no cones, no error but rounding
			}
		}
	}
}

TEST(PeriodMatrix, OfRegularPolygonsWithOppositeSidesGlued)
{
	for (const int sides : {8, 10, 12, 14}) {
		const Eigen::MatrixXcd exact = omegaOfPolygon(sides);
		expectPeriodMatrix(exact, sides / 4);
		double last = 0.0;
		for (const int n : {2, 4, 8, 16}) {
			// The rotations, which leave no choice, are those of the triangles too.
			const PeriodMatrix smooth = periodMatrixOf(smoothPolygon(sides, n)),
							   flat = periodMatrixOf(flatPolygon(sides, n));
			expectPeriodMatrix(smooth.omega, sides / 4);
			EXPECT_LT(classDistance(exact, smooth.omega, 0.05), 1e-11);
			EXPECT_LT(classDistance(exact, flat.omega, 0.05), 1e-11);
			if (n == 16) {
				EXPECT_NEAR(last / smooth.error, 4.0, 0.5);
			}
			last = smooth.error;
		}
	}
}

TEST(PeriodMatrix, OfCurvesOfGenusTwoInClosedForm)
{
	// y^2 = x^5 - x, x^6 - 1 [Bobenko Mercat Schmies 2011].
	const Complex i(0.0, 1.0);
	Eigen::Matrix2cd bolza, hexagons;
	bolza << -2.0 + std::sqrt(8.0) * i, 1.0 - std::sqrt(2.0) * i, 1.0 - std::sqrt(2.0) * i,
		-2.0 + std::sqrt(8.0) * i;
	hexagons << 2.0 * i, -i, -i, 2.0 * i;
	EXPECT_LT(classDistance(bolza / 3.0, omegaOfPolygon(8), 0.05), 1e-12);
	// The sphere of two regular hexagons has the sixth roots of unity for corners. Two of it cross over
	// at every second side.
	const IntrinsicMesh curve = polygons(4, 6, 2.0 * kPi / 3.0, 4, [](Side s) {
		constexpr std::array<int, 4> even = {2, 3, 0, 1}, odd = {3, 2, 1, 0};
		return Side{(s.side % 2 ? odd : even)[at(s.polygon)], (6 - s.side) % 6};
	});
	EXPECT_EQ(curve.triangulation.eulerCharacteristic(), -2);
	EXPECT_LT(classDistance(hexagons / std::sqrt(3.0), periodMatrixOf(curve).omega, 0.05), 1e-11);
}

TEST(PeriodMatrix, OfThreeSquares)
{
	// The L of three squares with opposite sides glued. Its turn by pi / 2 has the eigenform dz for i, whose
	// periods are known, and one for -i, which is then given by that its product with dz is 0.
	Eigen::Matrix2cd exact;
	exact << Complex(0.0, 5.0), Complex(0.0, -4.0), Complex(0.0, -4.0), Complex(0.0, 5.0);
	for (const int n : {1, 3, 10})
		EXPECT_LT(
			classDistance(
				exact / 3.0, periodMatrixOf(squares({1, 0, 2}, {2, 1, 0}, n)).omega, 0.05),
			1e-11);
}

TEST(PeriodMatrix, ErrorIsABoundOnFlatTriangles)
{
	Random random(502);
	for (const int sides : {8, 10, 12}) {
		const Eigen::MatrixXcd exact = omegaOfPolygon(sides);
		for (const int n : {2, 4, 8}) {
			IntrinsicMesh mesh = flatPolygon(sides, n);
			flipIsometrically(mesh, 20 * n * n, random); // breaks the symmetry
			const PeriodMatrix periods = periodMatrixOf(mesh);
			const double distance =
				classDistance(exact, periods.omega, std::min(0.3, periods.error));
			EXPECT_LE(distance, periods.error);
			EXPECT_GT(distance, 1e-6);
		}
	}
}

TEST(PeriodMatrix, IsConformallyInvariantToSecondOrder)
{
	// Another metric in the class of the Bolza surface, without its symmetry.
	const auto bump = [](BolzaSurface::Complex z) {
		const auto q =
			static_cast<double>(std::norm(z - BolzaSurface::Complex(0.1L, 0.05L))) / 0.09;
		return q < 1.0 ? std::pow(1.0 - q, 4) : 0.0;
	};
	const Eigen::MatrixXcd exact = omegaOfPolygon(8);
	double last = 0.0;
	for (int level = 3; level < 6; ++level) {
		const PeriodMatrix periods = periodMatrixOf(BolzaSurface(level).distorted(bump));
		const double distance = classDistance(exact, periods.omega, 0.05);
		if (level > 3) {
			EXPECT_GT(last / distance, 3.0);
		}
		EXPECT_LT(distance, periods.error);
		last = distance;
	}
	EXPECT_LT(last, 1e-3);
}

TEST(PeriodMatrix, DoesNotDependOnScaleAndNumbers)
{
	Random random(503);
	for (const int genus : {1, 2, 3}) {
		const SurfaceMesh mesh = perforatedSlab(genus, 2);
		const IntrinsicMesh first = intrinsicMesh(mesh);
		const PeriodMatrix periods = periodMatrixOf(first);
		expectPeriodMatrix(periods.omega, genus);
		for (int trial = 0; trial < 3; ++trial) {
			IntrinsicMesh other = intrinsicMesh(renumbered(mesh, random).mesh);
			for (double& l : other.lengths)
				l *= 37.0;
			const PeriodMatrix again = periodMatrixOf(other);
			EXPECT_LT(classDistance(periods.omega, again.omega, 1e-3), 1e-9);
			EXPECT_NEAR(again.error, periods.error, 1e-9);
		}
	}
}

TEST(PeriodMatrix, OfAMirrorImageIsMinusTheConjugate)
{
	// A torus on which a twist leaves no symmetry.
	const double twist = 0.2;
	const PeriodMatrix one = periodMatrixOf(flatTorus({twist, 1.3}, 3)),
					   other = periodMatrixOf(flatTorus({-twist, 1.3}, 3));
	EXPECT_LT(std::abs(one.omega(0, 0) + std::conj(other.omega(0, 0))), 1e-12);
	EXPECT_GT(classDistance(one.omega, other.omega, 1.0), 0.1);
}

TEST(PeriodMatrix, BelongsToTheSameClassWithTheFactorOfANearbyMatrix)
{
	const SurfaceMesh mesh = torus(3.0, 1.0, 24, 12);
	for (const TargetCurvature target : {TargetCurvature::Flat, TargetCurvature::PlacedCones}) {
		Options options;
		options.target = target;
		const Report report = run(mesh, options).report;
		ASSERT_EQ(report.periodMatrix.size(), 1u);
		// Both have an error of second order: that of the harmonic forms has a bound.
		const Complex exact(0.0, std::sqrt(8.0)), own = report.periodMatrix[0];
		EXPECT_LT(std::abs(own - exact), 0.05 * std::sqrt(8.0));
		const PeriodMatrix direct = periodMatrixOf(intrinsicMesh(mesh));
		EXPECT_LT(
			std::abs(std::log(direct.omega(0, 0).imag() / own.imag())),
			report.periodError.value_or(0.0));
		if (report.torusTauIm) {
			EXPECT_NEAR(*report.torusTauIm, own.imag(), 0.05 * own.imag());
		}
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
			const Point3 &p = mesh.positions[at(v)], &q = mesh.positions[at(w)],
						 &r = mesh.positions[at(t[(k + 2) % 3])];
			double dot = 0.0;
			for (std::size_t i = 0; i < 3; ++i)
				dot += (p[i] - r[i]) * (q[i] - r[i]);
			const double cotangent = dot / (2.0 * triangleArea({p, q, r}));
			const Eigen::RowVector2d form(past(v / nv, w / nv), past(v % nv, w % nv));
			const double weight = 0.5 * cotangent;
			laplacian(v, v) += weight;
			laplacian(w, w) += weight;
			laplacian(v, w) -= weight;
			laplacian(w, v) -= weight;
			right.row(w) -= weight * form;
			right.row(v) += weight * form;
			energy += weight * form.transpose() * form;
		}
	const Eigen::MatrixXd functions = laplacian.completeOrthogonalDecomposition().solve(right);
	return energy - right.transpose() * functions;
}

/// For genus 1 the eigenvalues of J^-1 E are +-i k with k^2 = det E.
TEST(PeriodMatrix, ErrorIsTheLogarithmOfTheLargestEigenvalue)
{
	for (const int nu : {5, 8, 12}) {
		const int nv = 6;
		const SurfaceMesh mesh = torus(2.0, 1.0, nu, nv);
		const double k = std::sqrt(harmonicEnergies(mesh, nv).determinant());
		EXPECT_GT(k, 1.001);
		EXPECT_NEAR(periodMatrixOf(intrinsicMesh(mesh)).error, std::log(k), 1e-9);
	}
}

TEST(SiegelReduced, StaysInTheClass)
{
	Random random(504);
	for (const int genus : {1, 2, 3, 5, 8})
		for (int trial = 0; trial < 20; ++trial) {
			Eigen::MatrixXd root(genus, genus), real(genus, genus);
			for (double& x : root.reshaped())
				x = random.real(-1.0, 1.0);
			for (double& x : real.reshaped())
				x = random.real(-5.0, 5.0);
			Eigen::MatrixXcd omega(genus, genus);
			omega.real() = real + real.transpose();
			omega.imag() = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(genus, genus);
			const Eigen::MatrixXcd reduced = siegelReduced(omega);
			expectPeriodMatrix(reduced, genus);
			EXPECT_GE(std::abs(reduced(0, 0)), 1.0 - 1e-9);
			EXPECT_LE(reduced.real().cwiseAbs().maxCoeff(), 0.5 + 1e-9);
			for (int i = 0; i < genus; ++i)
				for (int j = i + 1; j < genus; ++j) { // Lagrange
					EXPECT_LE(2.0 * std::abs(reduced(i, j).imag()), reduced(i, i).imag() + 1e-9);
					EXPECT_LE(reduced(i, i).imag(), reduced(j, j).imag() + 1e-9);
				}
			if (genus < 4) {
				EXPECT_LT(classDistance(omega, reduced, 1e-4), 1e-6);
			}
		}
}

} // namespace
} // namespace ricci::testing
