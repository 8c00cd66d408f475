// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/flow/sparse_cholesky.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

/// Laplacian of a path with random weights plus random links and \p shift on the diagonal; lower
/// triangle.
SparseCholesky::Matrix laplacian(int n, double shift, Random& random)
{
	Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
	const auto link = [&](int i, int j, double w) {
		dense(i, i) += w;
		dense(j, j) += w;
		dense(i, j) -= w;
		dense(j, i) -= w;
	};
	for (int i = 0; i + 1 < n; ++i)
		link(i, i + 1, random.real(0.1, 10.0));
	for (int i = 0; i + 7 < n; i += 3)
		link(i, i + 7, random.real(0.1, 10.0));
	dense.diagonal().array() += shift;
	const Eigen::MatrixXd lower = dense.triangularView<Eigen::Lower>();
	return lower.sparseView();
}

TEST(SparseCholesky, SolvesLikeADenseSolver)
{
	Random random(60);
	SparseCholesky solver;
	const int n = 120;
	// The pattern is analysed once; other values are only factorised.
	for (int trial = 0; trial < 3; ++trial) {
		const SparseCholesky::Matrix A = laplacian(n, 0.5, random);
		if (trial == 0)
			solver.analyze(A);
		ASSERT_TRUE(solver.factorize(A));
		const Eigen::MatrixXd lower = A;
		const Eigen::MatrixXd dense = lower.selfadjointView<Eigen::Lower>();
		for (int side = 0; side < 2; ++side) { // one factor serves several right sides
			Eigen::VectorXd b(n), x(n);
			for (double& y : b)
				y = random.real(-1, 1);
			solver.solve(b, x);
			EXPECT_LT((dense * x - b).lpNorm<Eigen::Infinity>(), 1e-13);
			EXPECT_LT((x - dense.llt().solve(b)).lpNorm<Eigen::Infinity>(), 1e-12);
		}
	}
}

TEST(SparseCholesky, AnotherPatternCanFollow)
{
	Random random(61);
	SparseCholesky solver;
	for (int n : {40, 25, 60}) {
		const SparseCholesky::Matrix A = laplacian(n, 1.0, random);
		solver.analyze(A);
		ASSERT_TRUE(solver.factorize(A));
		Eigen::VectorXd b = Eigen::VectorXd::Ones(n), x(n);
		solver.solve(b, x);
		// Rows of a Laplacian sum to zero, so that the ones are solved by themselves.
		EXPECT_LT((x - b).lpNorm<Eigen::Infinity>(), 1e-12);
	}
}

TEST(SparseCholesky, OrderingReducesFillAndSolvesTheRenumberedSystem)
{
	// An arrow that points the wrong way: eliminating its tip first fills the whole matrix, last
	// nothing.
	const int n = 50;
	SparseCholesky::Matrix A(n, n);
	for (int i = 0; i < n; ++i) {
		A.insert(i, 0) = i == 0 ? n + 1.0 : -1.0;
		if (i > 0)
			A.insert(i, i) = 2.0;
	}
	A.makeCompressed();
	SparseCholesky natural;
	natural.analyze(A);
	EXPECT_EQ(natural.factorEntries(), n * (n + 1) / 2);

	SparseCholesky ordered;
	const std::vector<int> order = ordered.order(A);
	std::vector<int> sorted = order;
	std::sort(sorted.begin(), sorted.end());
	for (int i = 0; i < n; ++i)
		ASSERT_EQ(sorted[static_cast<std::size_t>(i)], i);
	SparseCholesky::Matrix B(n, n);
	for (int i = 0; i < n; ++i)
		for (int j = 0; j <= i; ++j) {
			const int a = order[static_cast<std::size_t>(i)],
					  b = order[static_cast<std::size_t>(j)];
			const double x = A.coeff(std::max(a, b), std::min(a, b));
			if (x != 0.0)
				B.insert(i, j) = x;
		}
	B.makeCompressed();
	ordered.analyze(B);
	EXPECT_EQ(ordered.factorEntries(), 2 * n - 1);
	ASSERT_TRUE(ordered.factorize(B));
	const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
	Eigen::VectorXd solution(n);
	ordered.solve(B.selfadjointView<Eigen::Lower>() * x, solution);
	EXPECT_LT((solution - x).lpNorm<Eigen::Infinity>(), 1e-13);
	EXPECT_EQ(ordered.work().orderings, 1);
	EXPECT_EQ(ordered.work().factorizations, 1);
	EXPECT_EQ(ordered.work().solutions, 1);
	EXPECT_GT(ordered.work().flops, 0.0);
}

TEST(SparseCholesky, TellsWhenAMatrixIsNotPositiveDefinite)
{
	Random random(62);
	SparseCholesky solver;
	SparseCholesky::Matrix A = laplacian(30, -50.0, random);
	solver.analyze(A);
	EXPECT_FALSE(solver.factorize(A));
	A = laplacian(30, 1.0, random);
	EXPECT_TRUE(solver.factorize(A)); // and recovers
	EXPECT_NE(std::string(SparseCholesky::name()), "");
}

} // namespace
} // namespace ricci::testing
