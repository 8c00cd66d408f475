// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/numerics/aggregation.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <vector>

namespace ricci::testing {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Laplacian of a square grid with diagonals, with random weights.
Matrix gridLaplacian(int side, Random& random)
{
	std::vector<Eigen::Triplet<double>> entries;
	const auto join = [&](int a, int b) {
		const double w = random.real(0.5, 1.5);
		entries.emplace_back(a, b, -w);
		entries.emplace_back(b, a, -w);
		entries.emplace_back(a, a, w);
		entries.emplace_back(b, b, w);
	};
	for (int i = 0; i < side; ++i)
		for (int j = 0; j < side; ++j) {
			const int v = i * side + j;
			if (i + 1 < side)
				join(v, v + side);
			if (j + 1 < side)
				join(v, v + 1);
			if (i + 1 < side && j + 1 < side)
				join(v, v + side + 1);
		}
	Matrix matrix(side * side, side * side);
	matrix.setFromTriplets(entries.begin(), entries.end());
	return matrix;
}

/// Indicators of the aggregates as columns.
Eigen::MatrixXd indicators(const Aggregation& aggregation)
{
	Eigen::MatrixXd p =
		Eigen::MatrixXd::Zero(aggregation.aggregate.size(), aggregation.root.size());
	for (const int i : aggregation.aggregate.indices())
		p(i, aggregation.aggregate[i]) = 1.0;
	return p;
}

TEST(Aggregation, TakesEveryRowToAnAggregateAroundItsRoot)
{
	Random random(801);
	const Matrix matrix = gridLaplacian(20, random);
	const Aggregation a = aggregated(matrix);
	for (const int k : a.root.indices())
		EXPECT_EQ(a.aggregate[a.root[k]], k);
	// A row is the root, its neighbour, or the neighbour of such a one in the same aggregate.
	for (const int i : a.aggregate.indices()) {
		const int root = a.root[a.aggregate[i]];
		bool isNear = i == root || matrix.coeff(i, root) < 0.0;
		for (Matrix::InnerIterator e(matrix, i); e; ++e)
			isNear |= a.aggregate[static_cast<int>(e.row())] == a.aggregate[i] &&
					  matrix.coeff(static_cast<int>(e.row()), root) < 0.0;
		EXPECT_TRUE(isNear) << "row " << i;
	}
	EXPECT_LE(4 * a.root.size(), a.aggregate.size());
	EXPECT_GE(14 * a.root.size(), a.aggregate.size());
}

TEST(Aggregation, LeavesARowWithoutNeighboursAlone)
{
	Matrix matrix(3, 3);
	for (int i = 0; i < 3; ++i)
		matrix.insert(i, i) = 1.0;
	matrix.insert(0, 2) = matrix.insert(2, 0) = -1.0;
	const Aggregation a = aggregated(matrix);
	EXPECT_EQ(a.root.size(), 2);
	EXPECT_EQ(a.aggregate[0], a.aggregate[2]);
	EXPECT_NE(a.aggregate[0], a.aggregate[1]);
}

TEST(Aggregation, RestrictsToFunctionsThatAreConstantOnAggregates)
{
	Random random(802);
	const Matrix matrix = gridLaplacian(12, random);
	const Aggregation a = aggregated(matrix);
	const Eigen::MatrixXd p = indicators(a);
	const Eigen::MatrixXd expected = p.transpose() * Eigen::MatrixXd(matrix) * p;
	EXPECT_LT(
		(Eigen::MatrixXd(a.sums() * matrix * a.sums().transpose()) - expected)
			.lpNorm<Eigen::Infinity>(),
		1e-12);
}

} // namespace
} // namespace ricci::testing
