// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/base/indexed.h>
#include <ricci/numerics/sparse_cholesky.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
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

Eigen::VectorXd randomVector(Eigen::Index n, Random& random)
{
	return Eigen::VectorXd::NullaryExpr(n, [&] { return random.real(-1, 1); });
}

TEST(SparseCholesky, SolvesLikeADenseSolver)
{
	Random random(60);
	SparseCholesky solver;
	const int n = 120;
	// The pattern is analysed once; other values are only factorised.
	for (int trial = 0; trial < 3; ++trial) {
		const SparseCholesky::Matrix matrix = laplacian(n, 0.5, random);
		ASSERT_TRUE(solver.factorize(matrix));
		const Eigen::MatrixXd lower = matrix;
		const Eigen::MatrixXd dense = lower.selfadjointView<Eigen::Lower>();
		for (int side = 0; side < 2; ++side) { // one factor serves several right sides
			const Eigen::VectorXd b = randomVector(n, random), x = solver.solve(b);
			EXPECT_LT((dense * x - b).lpNorm<Eigen::Infinity>(), 1e-13);
			EXPECT_LT((x - dense.llt().solve(b)).lpNorm<Eigen::Infinity>(), 1e-12);
		}
	}
	EXPECT_EQ(solver.work().analyses, 1);
}

/// Laplacian of a square grid with shift 1; lower triangle. Its factor takes a good while.
SparseCholesky::Matrix gridLaplacian(int side)
{
	std::vector<Eigen::Triplet<double>> entries;
	for (int i = 0; i < side * side; ++i) {
		entries.emplace_back(i, i, 5.0);
		if (i % side > 0)
			entries.emplace_back(i, i - 1, -1.0);
		if (i >= side)
			entries.emplace_back(i, i - side, -1.0);
	}
	SparseCholesky::Matrix lower(side * side, side * side);
	lower.setFromTriplets(entries.begin(), entries.end());
	return lower;
}

/// A surface whose radii are all fixed has no unknowns.
TEST(SparseCholesky, SolvesWithoutUnknowns)
{
	SparseCholesky solver;
	ASSERT_TRUE(solver.factorize(SparseCholesky::Matrix(0, 0)));
	EXPECT_EQ(solver.solve(Eigen::VectorXd()).size(), 0);
	EXPECT_EQ(solver.solve(Eigen::MatrixXd(0, 2)).size(), 0);
}

TEST(SparseCholesky, SolvesForAnyNumberOfColumns)
{
	Random random(65);
	SparseCholesky solver;
	for (int n : {1, 30, 400}) { // from one column of the factor to many of its blocks
		const SparseCholesky::Matrix lower = laplacian(n, 0.5, random);
		ASSERT_TRUE(solver.factorize(lower)); // another pattern follows
		for (const int columns : {1, 2, 3, 4}) {
			Eigen::MatrixXd b(n, columns);
			for (int k = 0; k < columns; ++k)
				b.col(k) = randomVector(n, random);
			const int solutions = solver.work().solutions;
			const Eigen::MatrixXd x = solver.solve(b);
			EXPECT_EQ(solver.work().solutions, solutions + columns);
			EXPECT_LT((lower.selfadjointView<Eigen::Lower>() * x - b).cwiseAbs().maxCoeff(), 1e-12);
			for (int k = 0; k < columns; ++k)
				EXPECT_LT((x.col(k) - solver.solve(b.col(k))).lpNorm<Eigen::Infinity>(), 1e-12);
		}
	}
}

/// A factor so large that threads share the subtrees of its elimination tree, in an order that does not matter.
TEST(SparseCholesky, SubtreesGiveTheSameSolutionEachTime)
{
	Random random(66);
	const SparseCholesky::Matrix lower = gridLaplacian(150);
	SparseCholesky solver;
	ASSERT_TRUE(solver.factorize(lower));
	ASSERT_GT(solver.factorEntries(), 4e5);
	Eigen::MatrixXd b(lower.rows(), 3);
	for (Eigen::Index k = 0; k < b.cols(); ++k)
		b.col(k) = randomVector(b.rows(), random);
	const Eigen::MatrixXd x = solver.solve(b);
	EXPECT_LT((lower.selfadjointView<Eigen::Lower>() * x - b).cwiseAbs().maxCoeff(), 1e-13);
	for (int round = 0; round < 20; ++round) {
		EXPECT_TRUE(solver.solve(b) == x);
		EXPECT_TRUE(solver.solve(b.col(2)) == x.col(2));
	}
	Eigen::VectorXd unit = Eigen::VectorXd::Unit(b.rows(), 77);
	EXPECT_LT(
		(lower.selfadjointView<Eigen::Lower>() * solver.solve(unit) - unit)
			.lpNorm<Eigen::Infinity>(),
		1e-14);
}

TEST(SparseCholesky, IteratesWithTheFactorOfANearbyMatrix)
{
	Random random(70);
	const int n = 200;
	SparseCholesky::Matrix near = laplacian(n, 1.0, random), matrix = near;
	for (int i = 1; i < n; i += 5) { // another pattern, too
		matrix.coeffRef(i, i) += 0.3;
		matrix.coeffRef(n - 1, n - 1) += 0.01;
		matrix.coeffRef(n - 1, i) -= 0.01;
		matrix.coeffRef(i, i) += 0.01;
	}
	matrix.makeCompressed();
	const Eigen::VectorXd b = randomVector(n, random);
	SparseCholesky solver;
	ASSERT_TRUE(solver.factorize(near));
	Eigen::VectorXd x;
	EXPECT_LE(solver.iterate(near, b, 1e-12, 5, x), 2); // its own matrix
	EXPECT_LT((near.selfadjointView<Eigen::Lower>() * x - b).norm(), 1e-12 * b.norm());
	const int iterations = solver.iterate(matrix, b, 1e-10, 50, x);
	EXPECT_GT(iterations, 2);
	EXPECT_LE(iterations, 50);
	EXPECT_LT((matrix.selfadjointView<Eigen::Lower>() * x - b).norm(), 1e-9 * b.norm());
	EXPECT_GT(solver.iterate(matrix, b, 1e-10, 2, x), 2); // too few
	ASSERT_TRUE(solver.factorize(near)); // the matrix iterated on has left nothing behind
	EXPECT_LT(
		(near.selfadjointView<Eigen::Lower>() * solver.solve(b) - b).lpNorm<Eigen::Infinity>(),
		1e-12);
}

/// A random positive definite matrix whose groups of unknowns are full blocks. The first and the
/// second are eliminated without the other; the first has two others above it, so that its columns
/// are multiplied with each other in rectangles, too. Lower triangle.
Eigen::MatrixXd blocks(const std::array<int, 4>& sizes, Random& random)
{
	constexpr bool coupled[4][4] = {
		{true, false, true, true},
		{false, true, false, true},
		{true, false, true, true},
		{true, true, true, true}};
	std::vector<int> group;
	for (int g = 0; g < 4; ++g)
		group.insert(group.end(), positionOf(sizes[positionOf(g)]), g);
	const int n = static_cast<int>(group.size());
	Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
	for (int j = 0; j < n; ++j)
		for (int i = j; i < n; ++i)
			if (coupled[group[positionOf(i)]][group[positionOf(j)]])
				A(i, j) = random.real(-1, 1);
	const Eigen::MatrixXd full = A.selfadjointView<Eigen::Lower>();
	A.diagonal().array() += full.cwiseAbs().rowwise().sum().array();
	return A;
}

TEST(SparseCholesky, FactorizesFullBlocksOfAnySize)
{
	Random random(67);
	for (const std::array<int, 4>& sizes :
		 {std::array<int, 4>{1, 1, 1, 1},
		  {64, 64, 64, 64},
		  {65, 3, 63, 129},
		  {200, 100, 70, 150},
		  {40, 200, 130, 1}}) {
		const Eigen::MatrixXd lower = blocks(sizes, random);
		const Eigen::Index n = lower.rows(), last = n - 1;
		const Eigen::MatrixXd full = lower.selfadjointView<Eigen::Lower>();
		SparseCholesky solver;
		ASSERT_TRUE(solver.factorize(lower.sparseView()));
		const Eigen::VectorXd b = randomVector(n, random);
		const Eigen::VectorXd x = solver.solve(b), expected = full.llt().solve(b);
		EXPECT_LT((full * x - b).lpNorm<Eigen::Infinity>(), 1e-12);
		EXPECT_LT((x - expected).lpNorm<Eigen::Infinity>(), 1e-12);
		for (const double wrong : {-1e3, std::numeric_limits<double>::quiet_NaN()})
			for (const Eigen::Index i : {Eigen::Index(0), last / 2, last}) {
				Eigen::MatrixXd broken = lower;
				broken(i, i) = wrong;
				EXPECT_FALSE(solver.factorize(broken.sparseView())) << wrong << " in row " << i;
			}
		ASSERT_TRUE(solver.factorize(lower.sparseView()));
		EXPECT_EQ(solver.solve(b), x);
	}
}

/// An arrow: eliminating its tip first fills the whole matrix, last nothing.
SparseCholesky::Matrix arrow(int n, int tip)
{
	SparseCholesky::Matrix A(n, n);
	for (int i = 0; i < n; ++i) {
		A.insert(i, i) = i == tip ? n + 1.0 : 2.0;
		if (i != tip)
			A.insert(std::max(i, tip), std::min(i, tip)) = -1.0;
	}
	A.makeCompressed();
	return A;
}

TEST(SparseCholesky, EliminatesWithoutFill)
{
	const int n = 50;
	SparseCholesky solver;
	SparseCholesky::Matrix matrix = arrow(n, 0);
	ASSERT_TRUE(solver.factorize(matrix));
	EXPECT_EQ(solver.factorEntries(), 2 * n - 1);
	const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
	const Eigen::VectorXd solution = solver.solve(matrix.selfadjointView<Eigen::Lower>() * x);
	EXPECT_LT((solution - x).lpNorm<Eigen::Infinity>(), 1e-13);
	EXPECT_EQ(solver.work().orderings, 1);
	EXPECT_EQ(solver.work().factorizations, 1);
	EXPECT_EQ(solver.work().solutions, 1);
	EXPECT_GT(solver.work().flops, 0.0);
	// Another tip: at least one of these is eliminated early, and the factor would be full.
	for (const int tip : {n / 3, n / 2, n - 1}) {
		matrix = arrow(n, tip);
		ASSERT_TRUE(solver.factorize(matrix));
		EXPECT_LE(solver.factorEntries(), 3 * n);
		EXPECT_LT(
			(matrix.selfadjointView<Eigen::Lower>() * solver.solve(x) - x)
				.lpNorm<Eigen::Infinity>(),
			1e-12);
	}
	EXPECT_GT(solver.work().orderings, 1);
	// A pattern that the order suits as well needs no other.
	const int orderings = solver.work().orderings, analyses = solver.work().analyses;
	SparseCholesky::Matrix diagonal(n, n);
	diagonal.setIdentity();
	ASSERT_TRUE(solver.factorize(diagonal));
	EXPECT_EQ(solver.work().orderings, orderings);
	EXPECT_EQ(solver.work().analyses, analyses + 1);
}

TEST(SparseCholesky, FactorsMayHaveMoreEntriesThanIntCanTell)
{
	// Half of the unknowns of a random graph end as neighbours of each other.
	if (std::string(SparseCholesky::name()).find("CHOLMOD") == std::string::npos)
		GTEST_SKIP() << "Eigen's solver numbers entries by int";
	Random random(69);
	const int n = 100000;
	std::vector<Eigen::Triplet<double>> entries;
	for (int i = 0; i < n; ++i) {
		entries.emplace_back(i, i, 100.0);
		for (int k = 0; k < 4; ++k) {
			const int j = random.index(n);
			entries.emplace_back(std::max(i, j), std::min(i, j), -1.0);
		}
	}
	SparseCholesky::Matrix graph(n, n);
	graph.setFromTriplets(entries.begin(), entries.end());
	SparseCholesky solver;
	solver.analyze(graph);
	EXPECT_GT(solver.factorEntries(), std::numeric_limits<int>::max() / 2);
}

} // namespace
} // namespace ricci::testing
