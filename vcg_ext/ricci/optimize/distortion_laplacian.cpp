// SPDX-License-Identifier: GPL-3.0-or-later
#include "distortion_laplacian.h"

#include "limited_memory_bfgs.h"

#include <algorithm>
#include <cmath>

namespace ricci {

namespace {

using Complex = std::complex<double>;

/// So many iterations at most: a few are usual, fans of needles would take thousands. The direction leads
/// down after any number of them.
constexpr int kMaxIterations = 100;

/// Re(conj(a) b).
double realProduct(Complex a, Complex b)
{
	return a.real() * b.real() + a.imag() * b.imag();
}

} // namespace

DistortionLaplacian::DistortionLaplacian(const MeanDistortion& energy) :
		m_energy(energy), m_points(energy.points()), m_slot(energy.size(), {-1, -1, -1}),
		m_below(m_points.unknowns, m_points.unknowns), m_scale(m_points.unknowns),
		m_residual(m_points.unknowns), m_direction(m_points.unknowns), m_solved(m_points.unknowns),
		m_product(m_points.unknowns)
{
	const auto eachSide = [&](const auto& use) {
		for (const int f : m_slot.indices())
			for (std::size_t k = 0; k < 3; ++k) {
				const auto [column, row] = std::minmax(
					{m_points.unknown[energy.corners(f)[k]],
					 m_points.unknown[energy.corners(f)[(k + 1) % 3]]});
				if (column >= 0 && column != row)
					use(row, column, m_slot[f][k]);
			}
	};
	std::vector<Eigen::Triplet<double>> entries;
	entries.reserve(3 * m_slot.values().size());
	eachSide([&](int row, int column, Eigen::Index) { entries.emplace_back(row, column, 0.0); });
	m_below.setFromTriplets(entries.begin(), entries.end());
	eachSide([&](int row, int column, Eigen::Index& slot) {
		slot = &m_below.coeffRef(row, column) - m_below.valuePtr();
	});
}

bool DistortionLaplacian::factorize()
{
	Eigen::VectorXd& diagonal = m_scale;
	diagonal.setZero();
	m_below.coeffs().setZero();
	for (const int f : m_slot.indices()) {
		const double s = m_energy.stiffness(f);
		std::array<Complex, 3> slopes = m_energy.slopes(f);
		Triangle unknown{};
		for (std::size_t k = 0; k < 3; ++k) {
			const int point = m_energy.corners(f)[k];
			unknown[k] = m_points.unknown[point];
			if (unknown[k] >= 0 && unknown[k] != point) // an image
				slopes[k] *= m_points.turn[point];
		}
		for (std::size_t k = 0; k < 3; ++k) {
			if (unknown[k] < 0)
				continue;
			diagonal[unknown[k]] += s * std::norm(slopes[k]);
			const std::size_t next = (k + 1) % 3;
			if (m_slot[f][k] >= 0)
				m_below.coeffs()[m_slot[f][k]] += s * realProduct(slopes[k], slopes[next]);
			else if (unknown[k] == unknown[next]) // the two copies of a seam vertex
				diagonal[unknown[k]] += 2.0 * s * realProduct(slopes[k], slopes[next]);
		}
	}
	for (double& d : diagonal) {
		if (!(d > 0.0 && std::isfinite(d)))
			return false;
		d = 1.0 / std::sqrt(d);
	}
	for (int column = 0; column < m_points.unknowns; ++column)
		for (Eigen::SparseMatrix<double>::InnerIterator entry(m_below, column); entry; ++entry)
			entry.valueRef() *= m_scale[column] * m_scale[entry.row()];
	m_belowByRows = m_below;
	return true;
}

/// x = (1 + L)^-1 x for the entries L below the diagonal.
void DistortionLaplacian::solveForward(Eigen::VectorXcd& x) const
{
	m_belowByRows.triangularView<Eigen::UnitLower>().solveInPlace(x);
}

/// x = (1 + L)^-T x.
void DistortionLaplacian::solveBackward(Eigen::VectorXcd& x) const
{
	m_below.transpose().triangularView<Eigen::UnitUpper>().solveInPlace(x);
}

/// With A = 1 + L + L^T, conjugate gradients run on (1 + L)^-1 A (1 + L)^-T y = (1 + L)^-1 rhs, where
/// the product with p is t + (1 + L)^-1 (p - t) for t = (1 + L)^-T p; x is the sum of the same t.
void DistortionLaplacian::solve(const Eigen::VectorXcd& rhs, Eigen::VectorXcd& x, double residual)
{
	const auto dot = LimitedMemoryBfgs::dot;
	m_residual = m_scale.cwiseProduct(rhs);
	solveForward(m_residual);
	m_direction = m_residual;
	x.setZero(m_points.unknowns);
	double square = dot(m_residual, m_residual);
	const double wanted = residual * residual * square;
	for (int i = 0; i < kMaxIterations && square > wanted; ++i) {
		m_solved = m_direction;
		solveBackward(m_solved);
		m_product = m_direction - m_solved;
		solveForward(m_product);
		m_product += m_solved;
		const double length = square / dot(m_direction, m_product);
		if (!(length > 0.0 && std::isfinite(length)))
			break;
		x += length * m_solved;
		m_residual -= length * m_product;
		const double last = square;
		square = dot(m_residual, m_residual);
		m_direction = m_residual + (square / last) * m_direction;
	}
	x = m_scale.cwiseProduct(x);
}

} // namespace ricci
