// SPDX-License-Identifier: GPL-3.0-or-later
#include "distortion_laplacian.h"

#include "../base/tolerances.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ricci {

namespace {

using Complex = std::complex<double>;

/// From one shift of the diagonal to the next.
constexpr double kShiftGrowth = 100.0;

/// Re(conj(a) b).
double realProduct(Complex a, Complex b)
{
	return a.real() * b.real() + a.imag() * b.imag();
}

} // namespace

DistortionLaplacian::DistortionLaplacian(MeanDistortion& energy, MovablePoints& points) :
		m_points(points), m_unknown(energy.faceCount()), m_slot(energy.faceCount())
{
	energy.usePoints(points);
	layOut(energy);
	Array<int> row(points.unknowns);
	std::iota(row.begin(), row.end(), 0);
	m_cholesky.analyze(m_matrix, row, [&] {
		points.renumber(row);
		energy.usePoints(points);
		layOut(energy);
	});
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
	// The columns of each row; then the rows of each column, in increasing order, most of them
	// twice.
	const auto starts = [&](const auto& count) {
		Array<int> start(n + 1, 0);
		count(start);
		for (int i = 0; i < n; ++i)
			start[i + 1] += start[i];
		return start;
	};
	const Array<int> rowStart = starts([&](Array<int>& start) {
		eachSide([&](Face, std::size_t, int, int row) { ++start[row + 1]; });
	});
	const Array<int> columnStart = starts([&](Array<int>& start) {
		eachSide([&](Face, std::size_t, int column, int) { ++start[column + 1]; });
	});
	Array<int> columns(rowStart.back()), rows(rowStart.back());
	Array<int> cursor = rowStart;
	eachSide([&](Face, std::size_t, int column, int row) { columns[cursor[row]++] = column; });
	cursor = columnStart;
	for (int row = 0; row < n; ++row)
		for (int i = rowStart[row]; i < rowStart[row + 1]; ++i)
			rows[cursor[columns[i]]++] = row;

	m_matrix.resize(n, n);
	m_matrix.resizeNonZeros(n + rows.size());
	int* outer = m_matrix.outerIndexPtr();
	int* inner = m_matrix.innerIndexPtr();
	int slot = 0;
	for (int c = 0; c < n; ++c) {
		outer[c] = slot;
		inner[slot++] = c;
		slot = static_cast<int>(
			std::unique_copy(
				rows.begin() + columnStart[c], rows.begin() + columnStart[c + 1], inner + slot) -
			inner);
	}
	outer[n] = slot;
	m_matrix.resizeNonZeros(slot);

	m_slot.assign(m_unknown.size(), {-1, -1, -1});
	inner = m_matrix.innerIndexPtr();
	eachSide([&](Face f, std::size_t k, int column, int row) {
		const int* entry = std::lower_bound(inner + outer[column], inner + outer[column + 1], row);
		m_slot[f][k] = static_cast<int>(entry - inner);
	});
}

void DistortionLaplacian::fill(const MeanDistortion& energy)
{
	const int* outer = m_matrix.outerIndexPtr();
	double* value = m_matrix.valuePtr();
	std::fill(value, value + m_matrix.nonZeros(), 0.0);
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
			double& diagonal = value[outer[unknown[k]]];
			diagonal += s * std::norm(slopes[k]);
			const std::size_t next = (k + 1) % 3;
			if (m_slot[f][k] >= 0)
				value[m_slot[f][k]] += s * realProduct(slopes[k], slopes[next]);
			else if (unknown[k] == unknown[next]) // the two copies of a seam vertex
				diagonal += 2.0 * s * realProduct(slopes[k], slopes[next]);
		}
	}
}

bool DistortionLaplacian::factorize(const MeanDistortion& energy)
{
	fill(energy);
	for (double shift = kFirstShift; !m_cholesky.factorize(m_matrix); shift *= kShiftGrowth) {
		if (!(shift < 1.0))
			return false;
		for (int c = 0; c < m_points.unknowns; ++c)
			m_matrix.valuePtr()[m_matrix.outerIndexPtr()[c]] *= 1.0 + shift;
	}
	return true;
}

} // namespace ricci
