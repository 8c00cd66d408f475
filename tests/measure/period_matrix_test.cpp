// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces whose period matrix is known: flat tori, and regular polygons with sides glued.
#include "support/complex.h"
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/shapes.h"
#include "support/siegel.h"

#include <ricci/base/numbers.h>
#include <ricci/math/disjoint_sets.h>
#include <ricci/measure/invariants.h>
#include <ricci/measure/period_matrix.h>

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <vector>

namespace ricci::testing {
namespace {

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
		IntrinsicMesh result = {Triangulation(count, triangles, glued), {}};
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
			const double along = 1.0 / n, across = std::abs(tau) / n, slant = std::abs(1.0 + tau) / n;
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
				p.glue(
					cell(s, i, j) + 4,
					j + 1 < n ? cell(s, i, j + 1) : cell(above[at(s)], i, 0));
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
	const auto square = [](const Eigen::Vector3d& v) { return v[0] * v[0] + v[1] * v[1] - v[2] * v[2]; };
	const auto point = [&](int i, int j) -> Eigen::Vector3d {
		const Eigen::Vector3d v =
			(n - i - j) * corner[0] + i * corner[1] + j * corner[2];
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
	std::vector<int> used(at(2 * n * n * sides * count), -1); // the numbers of the triangles that exist
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

TEST(PeriodMatrix, DBG)
{
	for (int sides : {8, 10, 12, 14})
		for (int n : {1, 2, 4, 8, 16, 32}) {
			const PeriodMatrix s = periodMatrixOf(smoothPolygon(sides, n)),
							   f = periodMatrixOf(flatPolygon(sides, n));
			const Eigen::MatrixXcd o = omegaOfPolygon(sides);
			std::printf("%d %d smooth err %.3g d %.3g   flat err %.3g d %.3g\n", sides, n, s.error,
				classDistance(o, s.omega, sides<11?0.4:0.2), f.error, classDistance(o, f.omega, sides<11?0.4:0.2));
			fflush(stdout); if (n == 32 && sides < 11)
				std::cout << s.omega << "\n" << siegelReduced(o) << "\n";
		}
	for (int n : {1, 2, 4, 8, 16, 32, 64}) {
		const PeriodMatrix s = periodMatrixOf(squares({1, 0, 2}, {2, 1, 0}, n));
		std::cout << n << " L " << s.error << "\n" << s.omega << "\n";
	}
	for (int n : {1, 2, 4, 8, 16, 32, 64}) {
		const PeriodMatrix s = periodMatrixOf(polygons(4, 6, 2*kPi/3, n, [](Side s) {
			static const int even[] = {2, 3, 0, 1}, odd[] = {3, 2, 1, 0};
			return Side{(s.side % 2 ? odd : even)[s.polygon], (6 - s.side) % 6};
		}));
		std::cout << n << " x6-1 " << s.error << "\n" << s.omega << "\n";
	}
	Random random(1);
	for (int i = 0; i < 5; ++i) {
		Complex tau(random.real(-2, 2), random.real(0.2, 3));
		for (int n : {1, 2, 7}) {
			IntrinsicMesh m = flatTorus(tau, n);
			std::cout << reduceToFundamentalDomain(tau);
			PeriodMatrix o = periodMatrixOf(m);
			std::cout << o.omega << o.error;
			flipIsometrically(m, 500, random);
			o = periodMatrixOf(m);
			std::cout << o.omega << o.error << "\n";
		}
	}
}

} // namespace
} // namespace ricci::testing
