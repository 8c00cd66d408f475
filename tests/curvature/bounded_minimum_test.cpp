// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/curvature/cone_curvatures.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace ricci::testing {
namespace {

constexpr double kMax = 1.5;

struct Problem
{
	Eigen::MatrixXd gram;
	Eigen::VectorXd linear;
	std::optional<double> total;

	/// Strongly coupled, with the free minimum on both sides of the bound.
	Problem(int n, bool fixedSum, Random& random)
	{
		Eigen::MatrixXd root(n, n);
		Eigen::VectorXd wanted(n);
		for (int i = 0; i < n; ++i) {
			wanted[i] = random.real(-2.0, 5.0);
			for (int j = 0; j < n; ++j)
				root(i, j) = (i == j ? 0.3 : 0.0) + random.real(-1.0, 1.0);
		}
		gram = root.transpose() * root;
		linear = -gram * wanted;
		if (fixedSum)
			total = random.real(-2.0 * n, kMax * n);
	}

	double operator()(const Eigen::VectorXd& k) const
	{
		return k.dot(gram * k) + 2.0 * linear.dot(k);
	}

	/// The lowest point of all those that are lowest for one set of entries at the bound.
	Eigen::VectorXd lowest() const
	{
		const int n = static_cast<int>(linear.size());
		Eigen::VectorXd best;
		double least = std::numeric_limits<double>::infinity();
		for (int set = 0; set < 1 << n; ++set) {
			// Stationary for the multipliers, each of which belongs to one entry at the bound, or to
			// the sum.
			const int rows = 2 * n + 1;
			Eigen::MatrixXd system = Eigen::MatrixXd::Identity(rows, rows);
			Eigen::VectorXd rhs = Eigen::VectorXd::Zero(rows);
			system.topLeftCorner(n, n) = gram;
			rhs.head(n) = -linear;
			for (int i = 0; i < n; ++i)
				if (set >> i & 1) {
					system(i, n + i) = 1.0;
					system(n + i, n + i) = 0.0;
					system(n + i, i) = 1.0;
					rhs[n + i] = kMax;
				}
			if (total) {
				if (set == (1 << n) - 1)
					continue; // has no freedom left
				system.col(2 * n).head(n).setOnes();
				system.row(2 * n).setZero();
				system.row(2 * n).head(n).setOnes();
				rhs[2 * n] = *total;
			}
			const Eigen::VectorXd k = system.fullPivLu().solve(rhs).head(n);
			if (k.maxCoeff() <= kMax + 1e-12 && (*this)(k) < least) {
				least = (*this)(k);
				best = k;
			}
		}
		return best;
	}
};

TEST(BoundedMinimum, IsTheLowestOfAllActiveSets)
{
	Random random(240);
	int atBound = 0, freed = 0;
	for (int trial = 0; trial < 4000; ++trial) {
		const Problem problem(1 + random.index(6), random.coin(), random);
		const Eigen::VectorXd k = boundedMinimum(problem.gram, problem.linear, kMax, problem.total);
		const Eigen::VectorXd expected = problem.lowest();
		ASSERT_EQ(k.size(), expected.size());
		EXPECT_LE(k.maxCoeff(), kMax);
		if (problem.total) {
			EXPECT_NEAR(k.sum(), *problem.total, 1e-11);
		}
		const double size = std::abs(problem(expected)) + problem.linear.norm();
		EXPECT_NEAR(problem(k), problem(expected), 1e-10 * size) << trial;
		atBound += (k.array() == kMax).count() > 0;
		freed += (k.array() < kMax - 1e-9).count() > 0;
	}
	EXPECT_GT(atBound, 1000);
	EXPECT_GT(freed, 1000);
}

TEST(BoundedMinimum, FulfilsItsConditions)
{
	// Larger problems: no active set can be looked up, but the conditions of a convex minimum hold. Half
	// the gradient plus the multiplier of the sum is 0 at free entries, and not positive at the bound.
	Random random(241);
	for (int trial = 0; trial < 200; ++trial) {
		const Problem problem(20 + random.index(40), trial % 2 == 0, random);
		const Eigen::VectorXd k = boundedMinimum(problem.gram, problem.linear, kMax, problem.total);
		const Eigen::VectorXd slope = problem.gram * k + problem.linear;
		const double slack = 1e-9 * (1.0 + problem.linear.lpNorm<Eigen::Infinity>());
		double level = 0.0;
		if (problem.total) {
			EXPECT_NEAR(k.sum(), *problem.total, 1e-10 * static_cast<double>(k.size()));
			Eigen::Index free = 0;
			k.minCoeff(&free);
			level = -slope[free];
		}
		for (Eigen::Index i = 0; i < k.size(); ++i) {
			if (k[i] < kMax) {
				EXPECT_NEAR(slope[i] + level, 0.0, slack);
			}
			else {
				EXPECT_EQ(k[i], kMax);
				EXPECT_LE(slope[i] + level, slack);
			}
		}
	}
}

TEST(BoundedMinimum, IsTheSameFromAnywhere)
{
	Random random(242);
	for (int trial = 0; trial < 400; ++trial) {
		const int n = 2 + random.index(8);
		const Problem problem(n, trial % 2 == 0, random);
		const Eigen::VectorXd k = boundedMinimum(problem.gram, problem.linear, kMax, problem.total);
		// Allowed: some entries at the bound, and the others with what the sum lacks.
		Eigen::VectorXd start(n);
		for (int i = 0; i < n; ++i)
			start[i] = random.coin() ? kMax : random.real(-3.0, kMax);
		if (problem.total)
			start[0] += *problem.total - start.sum();
		const Eigen::VectorXd again =
			boundedMinimum(problem.gram, problem.linear, kMax, problem.total, start);
		const double size = std::abs(problem(k)) + problem.linear.norm();
		EXPECT_NEAR(problem(again), problem(k), 1e-10 * size) << trial;
		EXPECT_LE(again.maxCoeff(), kMax);
	}
}

TEST(BoundedMinimum, TakesTheBoundWhereTheSumIsOutOfReach)
{
	const Eigen::MatrixXd gram = Eigen::MatrixXd::Identity(3, 3);
	const Eigen::VectorXd linear = Eigen::VectorXd::LinSpaced(3, -1.0, 1.0);
	for (const double total : {3 * kMax, 3 * kMax + 1.0})
		EXPECT_EQ(boundedMinimum(gram, linear, kMax, total), Eigen::VectorXd::Constant(3, kMax));
	EXPECT_EQ(boundedMinimum({}, Eigen::VectorXd(), kMax, 1.0).size(), 0);
}

} // namespace
} // namespace ricci::testing
