// SPDX-License-Identifier: GPL-3.0-or-later
#include "aggregation.h"

#include <cmath>
#include <vector>

namespace ricci {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Entry = Matrix::InnerIterator;

/// An entry below this share of the geometric mean of its rows' diagonals does not make neighbours.
constexpr double kStrong = 0.08;

/// Calls visit(neighbour, entry) for the strong neighbours of row \p i.
template<class Visit>
void forNeighbours(const Matrix& matrix, const Eigen::VectorXd& diagonal, int i, const Visit& visit)
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
		aggregate[i] = result.root.size();
		result.root.push_back(i);
		forNeighbours(matrix, diagonal, i, [&](int j, double) {
			if (aggregate[j] < 0)
				aggregate[j] = aggregate[i];
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
	Aggregation result;
	formAggregates(matrix, matrix.diagonal(), result);
	return result;
}

Eigen::SparseMatrix<double> Aggregation::sums() const
{
	std::vector<Eigen::Triplet<double>> entries;
	for (const int i : aggregate.indices())
		entries.emplace_back(aggregate[i], i, 1.0);
	Eigen::SparseMatrix<double> result(root.size(), aggregate.size());
	result.setFromTriplets(entries.begin(), entries.end());
	return result;
}

} // namespace ricci
