// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/base/indexed.h>
#include <ricci/math/sparse_cholesky.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <complex>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <utility>
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

/// A matrix with the rows that the solver chooses for it.
struct System
{
	explicit System(SparseCholesky::Matrix lower) : given(std::move(lower)), row(given.rows())
	{
		std::iota(row.begin(), row.end(), 0);
		layOut();
	}

	void layOut()
	{
		std::vector<Eigen::Triplet<double>> entries;
		for (int column = 0; column < given.cols(); ++column)
			for (SparseCholesky::Matrix::InnerIterator it(given, column); it; ++it) {
				const int a = row[int(it.row())], b = row[column];
				entries.emplace_back(std::max(a, b), std::min(a, b), it.value());
			}
		matrix.resize(given.rows(), given.cols());
		matrix.setFromTriplets(entries.begin(), entries.end());
	}

	bool analyze(SparseCholesky& solver)
	{
		return solver.analyze(matrix, row, [this] { layOut(); });
	}

	/// In the order given.
	Eigen::VectorXd solve(SparseCholesky& solver, const Eigen::VectorXd& rhs) const
	{
		Eigen::VectorXd b(rhs.size()), x(rhs.size()), solution(rhs.size());
		for (int i = 0; i < rhs.size(); ++i)
			b[row[i]] = rhs[i];
		solver.solve(b, x);
		for (int i = 0; i < rhs.size(); ++i)
			solution[i] = x[row[i]];
		return solution;
	}

	SparseCholesky::Matrix given, matrix;
	Array<int> row;
};

TEST(SparseCholesky, SolvesLikeADenseSolver)
{
	Random random(60);
	SparseCholesky solver;
	const int n = 120;
	// The pattern is analysed once; other values are only factorised.
	System system(laplacian(n, 0.5, random));
	EXPECT_TRUE(system.analyze(solver));
	for (int trial = 0; trial < 3; ++trial) {
		ASSERT_TRUE(solver.factorize(system.matrix));
		const Eigen::MatrixXd lower = system.given;
		const Eigen::MatrixXd dense = lower.selfadjointView<Eigen::Lower>();
		for (int side = 0; side < 2; ++side) { // one factor serves several right sides
			Eigen::VectorXd b(n);
			for (double& y : b)
				y = random.real(-1, 1);
			const Eigen::VectorXd x = system.solve(solver, b);
			EXPECT_LT((dense * x - b).lpNorm<Eigen::Infinity>(), 1e-13);
			EXPECT_LT((x - dense.llt().solve(b)).lpNorm<Eigen::Infinity>(), 1e-12);
		}
		system.given = laplacian(n, 0.5, random);
		system.layOut();
	}
	EXPECT_EQ(solver.work().analyses, 1);
}

#ifdef RICCI_STATIC_CHOLMOD // other solvers never tick

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

/// What a tick throws at any time passes through, and leaves the solver usable.
TEST(SparseCholesky, EndsWhenATickThrows)
{
	System system(gridLaplacian(200));
	SparseCholesky solver;
	system.analyze(solver);
	int ticks = 0;
	ASSERT_TRUE(solver.factorize(system.matrix, [&] { ++ticks; }));
	const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(system.given.rows(), -1.0, 1.0);
	const Eigen::VectorXd x = system.solve(solver, b);
	EXPECT_GT(ticks, solver.factorFlops() / 1e8); // many a second
	for (const int last : {1, 2, ticks / 2, ticks}) {
		int count = 0;
		const auto throwAtLast = [&] {
			if (++count == last)
				throw Cancelled();
		};
		EXPECT_THROW(solver.factorize(system.matrix, throwAtLast), Cancelled) << last;
		EXPECT_EQ(count, last); // none after it
		ASSERT_TRUE(solver.factorize(system.matrix));
		EXPECT_EQ(system.solve(solver, b), x);
	}
}

#endif

/// A surface whose radii are all fixed has no unknowns.
TEST(SparseCholesky, SolvesWithoutUnknowns)
{
	SparseCholesky cholesky;
	const SparseCholesky::Matrix matrix(0, 0);
	std::vector<int> rowOf(3, -1);
	cholesky.analyze(matrix, rowOf, [] {});
	ASSERT_TRUE(cholesky.factorize(matrix));
	Eigen::VectorXd x = Eigen::VectorXd::Ones(1);
	cholesky.solve(Eigen::VectorXd(), x);
	EXPECT_EQ(x.size(), 0);
	Eigen::VectorXcd z = Eigen::VectorXcd::Ones(1);
	cholesky.solve(Eigen::VectorXcd(), z);
	EXPECT_EQ(z.size(), 0);
}

TEST(SparseCholesky, SolvesForComplexRightSides)
{
	Random random(65);
	SparseCholesky solver;
	for (int n : {1, 30, 400}) { // from one column of the factor to many of its blocks
		System system(laplacian(n, 0.5, random));
		system.analyze(solver);
		ASSERT_TRUE(solver.factorize(system.matrix));
		Eigen::VectorXcd b(n), x;
		for (std::complex<double>& y : b)
			y = {random.real(-1, 1), random.real(-1, 1)};
		const int solutions = solver.work().solutions;
		solver.solve(b, x);
		EXPECT_EQ(solver.work().solutions, solutions + 2);
		Eigen::VectorXd re, im;
		solver.solve(b.real(), re);
		solver.solve(b.imag(), im);
		EXPECT_LT((x.real() - re).lpNorm<Eigen::Infinity>(), 1e-12);
		EXPECT_LT((x.imag() - im).lpNorm<Eigen::Infinity>(), 1e-12);
	}
}

TEST(SparseCholesky, SolvesForASingleEntry)
{
	Random random(66);
	SparseCholesky solver;
	const int n = 90;
	System system(laplacian(n, 0.5, random));
	system.analyze(solver);
	ASSERT_TRUE(solver.factorize(system.matrix));
	const Eigen::MatrixXd lower = system.given;
	const Eigen::MatrixXd inverse =
		Eigen::MatrixXd(lower.selfadjointView<Eigen::Lower>()).inverse();
	for (int i = 0; i < n; ++i) {
		const Eigen::VectorXd x = system.solve(solver, Eigen::VectorXd::Unit(n, i));
		EXPECT_LT((x - inverse.col(i)).lpNorm<Eigen::Infinity>(), 1e-12);
	}
	EXPECT_EQ(system.solve(solver, Eigen::VectorXd::Zero(n)), Eigen::VectorXd::Zero(n));
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
		Eigen::MatrixXd lower = blocks(sizes, random);
		const Eigen::Index n = lower.rows(), last = n - 1;
		const Eigen::MatrixXd full = lower.selfadjointView<Eigen::Lower>();
		SparseCholesky solver;
		System system(lower.sparseView());
		system.analyze(solver);
		ASSERT_TRUE(solver.factorize(system.matrix));
		Eigen::VectorXd b(n);
		for (double& y : b)
			y = random.real(-1, 1);
		const Eigen::VectorXd x = system.solve(solver, b), expected = full.llt().solve(b);
		EXPECT_LT((full * x - b).lpNorm<Eigen::Infinity>(), 1e-12);
		EXPECT_LT((x - expected).lpNorm<Eigen::Infinity>(), 1e-12);
		for (const double wrong : {-1e3, std::numeric_limits<double>::quiet_NaN()}) {
			for (const Eigen::Index i : {Eigen::Index(0), last / 2, last}) {
				const double before = lower(i, i);
				lower(i, i) = wrong;
				system.given = lower.sparseView();
				system.layOut();
				EXPECT_FALSE(solver.factorize(system.matrix)) << wrong << " in row " << i;
				lower(i, i) = before;
			}
		}
		system.given = lower.sparseView();
		system.layOut();
		ASSERT_TRUE(solver.factorize(system.matrix));
		EXPECT_EQ(system.solve(solver, b), x);
	}
}

TEST(SparseCholesky, AnotherPatternCanFollow)
{
	Random random(61);
	SparseCholesky solver;
	for (int n : {40, 25, 60}) {
		System system(laplacian(n, 1.0, random));
		EXPECT_TRUE(system.analyze(solver));
		ASSERT_TRUE(solver.factorize(system.matrix));
		const Eigen::VectorXd b = Eigen::VectorXd::Ones(n);
		// Rows of a Laplacian sum to zero, so that the ones are solved by themselves.
		EXPECT_LT((system.solve(solver, b) - b).lpNorm<Eigen::Infinity>(), 1e-12);
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

TEST(SparseCholesky, ChoosesRowsWithoutFill)
{
	const int n = 50;
	SparseCholesky solver;
	System system(arrow(n, 0));
	EXPECT_TRUE(system.analyze(solver));
	std::vector<int> sorted = system.row.values();
	std::sort(sorted.begin(), sorted.end());
	for (int i = 0; i < n; ++i)
		ASSERT_EQ(sorted[positionOf(i)], i);
	EXPECT_EQ(solver.factorEntries(), 2 * n - 1);
	ASSERT_TRUE(solver.factorize(system.matrix));
	const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
	const Eigen::VectorXd solution =
		system.solve(solver, system.given.selfadjointView<Eigen::Lower>() * x);
	EXPECT_LT((solution - x).lpNorm<Eigen::Infinity>(), 1e-13);
	EXPECT_EQ(solver.work().orderings, 1);
	EXPECT_EQ(solver.work().factorizations, 1);
	EXPECT_EQ(solver.work().solutions, 1);
	EXPECT_GT(solver.work().flops, 0.0);
	EXPECT_FALSE(system.analyze(solver)); // nothing better is to be had
	EXPECT_EQ(solver.work().orderings, 1);
	// The arrow turned round: its tip now has the row of what was eliminated first.
	const auto first = std::find(system.row.begin(), system.row.end(), 0) - system.row.begin();
	system.given = arrow(n, static_cast<int>(first));
	system.layOut();
	EXPECT_TRUE(system.analyze(solver));
	EXPECT_EQ(solver.work().orderings, 2);
	EXPECT_EQ(solver.factorEntries(), 2 * n - 1);
}

TEST(SparseCholesky, ElementsWithoutAnUnknownKeepNoRow)
{
	SparseCholesky solver;
	std::vector<int> row = {-1, 0, 1, -1, 2};
	SparseCholesky::Matrix A = arrow(3, 0);
	solver.analyze(A, row, [] {});
	EXPECT_EQ(row[0], -1);
	EXPECT_EQ(row[3], -1);
	EXPECT_EQ(std::set<int>(row.begin(), row.end()), (std::set<int>{-1, 0, 1, 2}));
}

TEST(SparseCholesky, SolvesWithAndWithoutNestedDissection)
{
	// From one unknown on: METIS, or what takes its place where there is none.
	Random random(68);
	SparseCholesky dissected(1), usual;
	const int n = 300;
	const SparseCholesky::Matrix matrix = laplacian(n, 0.5, random);
	Eigen::VectorXd b(n);
	for (double& y : b)
		y = random.real(-1, 1);
	Eigen::VectorXd solution[2];
	for (SparseCholesky* solver : {&dissected, &usual}) {
		System system(matrix);
		EXPECT_TRUE(system.analyze(*solver));
		ASSERT_TRUE(solver->factorize(system.matrix));
		solution[solver == &usual] = system.solve(*solver, b);
		EXPECT_EQ(solver->work().orderings, 1);
	}
	EXPECT_LT((solution[0] - solution[1]).lpNorm<Eigen::Infinity>(), 1e-12);
}

TEST(SparseCholesky, FactorsMayHaveMoreEntriesThanIntCanTell)
{
	// Half of the unknowns of a random graph end as neighbours of each other.
	if (std::string(SparseCholesky::name()).find("CHOLMOD") == std::string::npos)
		GTEST_SKIP() << "Eigen's solver numbers entries by int";
	Random random(69);
	const int n = 120000;
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
	System system(std::move(graph));
	SparseCholesky solver;
	EXPECT_TRUE(system.analyze(solver));
	EXPECT_GT(solver.factorEntries(), std::numeric_limits<int>::max() / 2);
}

TEST(SparseCholesky, TellsWhenAMatrixIsNotPositiveDefinite)
{
	Random random(62);
	SparseCholesky solver;
	System system(laplacian(30, -50.0, random));
	system.analyze(solver);
	EXPECT_FALSE(solver.factorize(system.matrix));
	system.given = laplacian(30, 1.0, random);
	system.layOut();
	EXPECT_TRUE(solver.factorize(system.matrix)); // and recovers
	EXPECT_NE(std::string(SparseCholesky::name()), "");
}

} // namespace
} // namespace ricci::testing
