// SPDX-License-Identifier: GPL-3.0-or-later
#include "distortion_laplacian.h"

#include "limited_memory_bfgs.h"

#include <algorithm>
#include <cmath>

namespace ricci {

namespace {

using Complex = std::complex<double>;

/// Re(conj(a) b).
double realProduct(Complex a, Complex b)
{
	return a.real() * b.real() + a.imag() * b.imag();
}

} // namespace

DistortionLaplacian::DistortionLaplacian(
	const MeanDistortion& energy, const MovablePoints& points) :
		m_points(points),
		m_unknown(energy.faceCount()), m_slot(energy.faceCount()), m_scale(points.unknowns),
		m_residual(points.unknowns), m_direction(points.unknowns), m_solved(points.unknowns),
		m_product(points.unknowns)
{
	layOut(energy);
}

void DistortionLaplacian::layOut(const MeanDistortion& energy)
{
	const int n = m_points.unknowns;
	for (const Face f : m_unknown.indices())
		for (std::size_t k = 0; k < 3; ++k)
			m_unknown[f][k] = m_points.unknownOf(energy.corners(f)[k]);
	const auto eachSide = [&](const auto& use) {
		for (const Face f : m_unknown.indices())
			for (std::size_t k = 0; k < 3; ++k) {
				const int a = m_unknown[f][k], b = m_unknown[f][(k + 1) % 3];
				if (a >= 0 && b >= 0 && a != b)
					use(f, k, std::min(a, b), std::max(a, b));
			}
	};
	std::vector<int> start(positionOf(n) + 1, 0);
	eachSide([&](Face, std::size_t, int column, int) { ++start[positionOf(column) + 1]; });
	for (std::size_t c = 0; c < positionOf(n); ++c)
		start[c + 1] += start[c];
	std::vector<int> rows(positionOf(start.back())), cursor = start;
	eachSide([&](Face, std::size_t, int column, int row) {
		rows[positionOf(cursor[positionOf(column)]++)] = row;
	});
	m_start.assign(1, 0);
	for (std::size_t c = 0; c < positionOf(n); ++c) { // most rows are there twice
		const auto first = rows.begin() + start[c], last = rows.begin() + start[c + 1];
		std::sort(first, last);
		m_row.insert(m_row.end(), first, std::unique(first, last));
		m_start.push_back(static_cast<int>(m_row.size()));
	}
	m_entry.resize(m_row.size());
	m_rowEntry.resize(m_row.size());
	m_column.resize(m_row.size());
	m_rowStart.assign(positionOf(n) + 1, 0);
	for (const int row : m_row)
		++m_rowStart[positionOf(row) + 1];
	for (std::size_t r = 0; r < positionOf(n); ++r)
		m_rowStart[r + 1] += m_rowStart[r];
	cursor = m_rowStart;
	for (int c = 0; c < n; ++c)
		for (int i = m_start[positionOf(c)]; i < m_start[positionOf(c) + 1]; ++i) {
			const int place = cursor[positionOf(m_row[positionOf(i)])]++;
			m_column[positionOf(place)] = c;
			m_place.push_back(place);
		}
	m_slot.assign(m_unknown.size(), {-1, -1, -1});
	eachSide([&](Face f, std::size_t k, int column, int row) {
		const auto first = m_row.begin() + m_start[positionOf(column)];
		const auto last = m_row.begin() + m_start[positionOf(column) + 1];
		m_slot[f][k] = static_cast<int>(std::lower_bound(first, last, row) - m_row.begin());
	});
}

bool DistortionLaplacian::factorize(const MeanDistortion& energy)
{
	Eigen::VectorXd& diagonal = m_scale;
	diagonal.setZero();
	std::fill(m_entry.begin(), m_entry.end(), 0.0);
	for (const Face f : m_unknown.indices()) {
		const std::array<int, 3>& unknown = m_unknown[f];
		const double s = energy.stiffness(f);
		std::array<Complex, 3> slopes = energy.slopes(f);
		for (std::size_t k = 0; k < 3; ++k)
			if (unknown[k] >= 0 && energy.corners(f)[k] != unknown[k]) // an image
				slopes[k] *= m_points.turnOf(energy.corners(f)[k]);
		for (std::size_t k = 0; k < 3; ++k) {
			if (unknown[k] < 0)
				continue;
			diagonal[unknown[k]] += s * std::norm(slopes[k]);
			const std::size_t next = (k + 1) % 3;
			if (m_slot[f][k] >= 0)
				m_entry[positionOf(m_slot[f][k])] += s * realProduct(slopes[k], slopes[next]);
			else if (unknown[k] == unknown[next]) // the two copies of a seam vertex
				diagonal[unknown[k]] += 2.0 * s * realProduct(slopes[k], slopes[next]);
		}
	}
	for (double& d : diagonal) {
		if (!(d > 0.0 && std::isfinite(d)))
			return false;
		d = 1.0 / std::sqrt(d);
	}
	for (int c = 0; c < m_points.unknowns; ++c)
		for (int i = m_start[positionOf(c)]; i < m_start[positionOf(c) + 1]; ++i)
			m_rowEntry[positionOf(m_place[positionOf(i)])] = m_entry[positionOf(i)] *=
				m_scale[c] * m_scale[m_row[positionOf(i)]];
	return true;
}

/// x = (1 + L)^-1 x for the entries L below the diagonal.
void DistortionLaplacian::solveForward(Eigen::VectorXcd& x) const
{
	for (int r = 0; r < m_points.unknowns; ++r) {
		Complex sum = x[r];
		for (int i = m_rowStart[positionOf(r)]; i < m_rowStart[positionOf(r) + 1]; ++i)
			sum -= m_rowEntry[positionOf(i)] * x[m_column[positionOf(i)]];
		x[r] = sum;
	}
}

/// x = (1 + L)^-T x.
void DistortionLaplacian::solveBackward(Eigen::VectorXcd& x) const
{
	for (int c = m_points.unknowns; c-- > 0;) {
		Complex sum = x[c];
		for (int i = m_start[positionOf(c)]; i < m_start[positionOf(c) + 1]; ++i)
			sum -= m_entry[positionOf(i)] * x[m_row[positionOf(i)]];
		x[c] = sum;
	}
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
	while (square > wanted) {
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
