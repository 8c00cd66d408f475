// SPDX-License-Identifier: GPL-3.0-or-later
#include "smoothed_aggregation.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ricci {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Entry = Matrix::InnerIterator;

/// An entry below this share of the geometric mean of its rows' diagonals does not make neighbours.
constexpr double kStrong = 0.08;

/// Damping of the Jacobi step that smooths the aggregates: 4/3 over a bound of the eigenvalues of
/// the matrix divided by its diagonal, which is 2 for a Laplacian.
constexpr double kDamping = 2.0 / 3.0;

/// Calls visit(neighbour, entry) for the strong neighbours of row \p i.
template<class Visit>
void forNeighbours(
	const Matrix& matrix, const Eigen::VectorXd& diagonal, int i, const Visit& visit)
{
	for (Entry entry(matrix, i); entry; ++entry) {
		const auto j = static_cast<int>(entry.row());
		if (j != i && -entry.value() > kStrong * std::sqrt(diagonal[i] * diagonal[j]))
			visit(j, -entry.value());
	}
}

void formAggregates(const Matrix& matrix, const Eigen::VectorXd& diagonal, Aggregation& result)
{
	const auto n = static_cast<int>(matrix.rows());
	Array<int>& aggregate = result.aggregate;
	aggregate.assign(n, -1);
	const auto grow = [&](int i) {
		const int number = result.root.size();
		result.root.push_back(i);
		aggregate[i] = number;
		forNeighbours(matrix, diagonal, i, [&](int j, double) {
			if (aggregate[j] < 0)
				aggregate[j] = number;
		});
	};
	for (int i = 0; i < n; ++i) {
		bool isFree = aggregate[i] < 0;
		forNeighbours(matrix, diagonal, i, [&](int j, double) { isFree &= aggregate[j] < 0; });
		if (isFree)
			grow(i);
	}
	const Array<int> before = aggregate;
	for (int i = 0; i < n; ++i) {
		double largest = 0.0;
		if (before[i] < 0)
			forNeighbours(matrix, diagonal, i, [&](int j, double entry) {
				if (before[j] >= 0 && entry > largest) {
					largest = entry;
					aggregate[i] = before[j];
				}
			});
	}
	for (int i = 0; i < n; ++i)
		if (aggregate[i] < 0)
			grow(i);
}

} // namespace

Aggregation aggregated(const Eigen::SparseMatrix<double>& matrix)
{
	const auto n = static_cast<int>(matrix.rows());
	const Eigen::VectorXd diagonal = matrix.diagonal();
	Aggregation result;
	formAggregates(matrix, diagonal, result);

	// (1 - damping / diagonal matrix) applied to the indicators of the aggregates, row by row.
	const int count = result.root.size();
	Eigen::SparseMatrix<double, Eigen::RowMajor> rows(n, count);
	rows.reserve(matrix.nonZeros() / 2);
	std::vector<int> touched;
	Array<double> value(count, 0.0);
	Array<char> isTouched(count, 0);
	const auto add = [&](int aggregate, double x) {
		if (!isTouched[aggregate]) {
			isTouched[aggregate] = 1;
			touched.push_back(aggregate);
		}
		value[aggregate] += x;
	};
	for (int i = 0; i < n; ++i) {
		touched.clear();
		add(result.aggregate[i], 1.0);
		for (Entry entry(matrix, i); entry; ++entry)
			add(result.aggregate[static_cast<int>(entry.row())],
				-kDamping * entry.value() / diagonal[i]);
		std::sort(touched.begin(), touched.end());
		rows.startVec(i);
		for (const int a : touched) {
			rows.insertBack(i, a) = value[a];
			value[a] = 0.0;
			isTouched[a] = 0;
		}
	}
	rows.finalize();
	result.prolongation = rows;
	return result;
}

} // namespace ricci
