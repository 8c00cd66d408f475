// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/base/numbers.h>
#include <ricci/cones/cone_curvatures.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace ricci::testing {
namespace {

constexpr double kMax = 1.5;

/// k.G k + 2 b.k with a positive definite G, and its minimum among all real k (of a given sum).
struct Quadratic
{
	Eigen::MatrixXd gram;
	Eigen::VectorXd linear;
	std::optional<double> total;
	Eigen::MatrixXd inverse; // see multipliers()
	Eigen::VectorXd free;    // the minimum

	/// With the minimum without a sum at random values between \p low and \p high.
	Quadratic(
		const Eigen::MatrixXd& root,
		double low,
		double high,
		std::optional<double> fixedSum,
		Random& random) :
			gram(root.transpose() * root),
			linear(root.cols()), total(fixedSum)
	{
		const Eigen::Index n = root.cols(), rows = n + (total ? 1 : 0);
		for (double& x : linear)
			x = random.real(low, high);
		linear = -gram * linear;
		Eigen::MatrixXd system = Eigen::MatrixXd::Ones(rows, rows);
		system.bottomRightCorner(rows - n, rows - n).setZero();
		system.topLeftCorner(n, n) = gram;
		Eigen::VectorXd rhs = Eigen::VectorXd::Constant(rows, total.value_or(0.0));
		rhs.head(n) = -linear;
		inverse = system.fullPivLu().inverse().topLeftCorner(n, n);
		free = system.fullPivLu().solve(rhs).head(n);
	}

	double operator()(const Eigen::VectorXd& k) const
	{
		return k.dot(gram * k) + 2.0 * linear.dot(k);
	}
};

Eigen::MatrixXd randomRoot(int n, double diagonal, double coupling, Random& random)
{
	Eigen::MatrixXd root(n, n);
	for (int i = 0; i < n; ++i)
		for (int j = 0; j < n; ++j)
			root(i, j) = (i == j ? diagonal : 0.0) + random.real(-coupling, coupling);
	return root;
}

/// Strongly coupled, with the free minimum on both sides of the bound.
Quadratic bounded(int n, bool fixedSum, Random& random)
{
	const auto root = randomRoot(n, 0.3, 1.0, random);
	const std::optional<double> sum = random.real(-2.0 * n, kMax * n);
	return {root, -2.0, 5.0, fixedSum ? sum : std::nullopt, random};
}

/// The conditions of a convex minimum. Half the gradient plus the multipliers is 0, of which those of the
/// bounds are not negative, and 0 below them: from anywhere.
TEST(BoundedMinimum, FulfilsItsConditions)
{
	Random random(241);
	int held = 0, freed = 0;
	for (int trial = 0; trial < 2000; ++trial) {
		const int n = trial < 200 ? 20 + random.index(40) : 1 + random.index(8);
		const Quadratic problem = bounded(n, random.coin(), random);
		Eigen::VectorXd start = Eigen::VectorXd::Zero(n);
		for (int i = 1; i < n; ++i) // with a fixed sum, not all of them can be at the bound
			start[i] = trial % 4 < 2 || random.coin() ? 0.0 : random.real(0.0, 10.0);
		const Eigen::VectorXd m =
			boundMultipliers(problem.inverse, problem.free.array() - kMax, start);
		const Eigen::VectorXd k = problem.free - problem.inverse * m;
		Eigen::VectorXd slope = problem.gram * k + problem.linear + m;
		const double slack =
			1e-13 * (problem.free.norm() + problem.inverse.norm() * m.norm()); // of rounding
		if (problem.total) {
			EXPECT_NEAR(k.sum(), *problem.total, n * (1e-10 + slack));
			slope.array() -= slope.mean();
		}
		EXPECT_LT(slope.lpNorm<Eigen::Infinity>(), 1e-8 * (1.0 + problem.linear.norm()));
		EXPECT_GE(m.minCoeff(), 0.0);
		for (int i = 0; i < n; ++i) {
			EXPECT_LT(k[i], kMax + slack);
			if (k[i] < kMax - slack) {
				EXPECT_EQ(m[i], 0.0);
			}
			++(m[i] > 0.0 ? held : freed);
		}
	}
	EXPECT_GT(held, 1000);
	EXPECT_GT(freed, 1000);
}

Eigen::VectorXd rounded(const Quadratic& energy)
{
	const Eigen::VectorXd k =
		roundToQuarterTurns(energy.gram, energy.linear, energy.free, energy.total);
	for (const double x : k) {
		EXPECT_EQ(x, kQuarterTurn * std::round(x / kQuarterTurn));
		EXPECT_LE(x, kMaxConeCurvature);
	}
	if (energy.total) {
		EXPECT_NEAR(k.sum(), *energy.total, 1e-13);
	}
	return k;
}

/// The lowest energy among the quarter turns up to \p reach from \p centre, with the right sum.
double lowest(const Quadratic& energy, const Eigen::VectorXd& centre, int reach)
{
	double lowest = std::numeric_limits<double>::infinity();
	const auto n = static_cast<int>(centre.size()), width = 2 * reach + 1;
	for (int c = 0; c < std::pow(width, n); ++c) {
		Eigen::VectorXd k(n);
		for (int i = 0, rest = c; i < n; ++i, rest /= width)
			k[i] = kQuarterTurn * (std::round(centre[i] / kQuarterTurn) + rest % width - reach);
		if (k.maxCoeff() <= kMaxConeCurvature + 1e-9 &&
			(!energy.total || std::abs(k.sum() - *energy.total) < 1e-9))
			lowest = std::min(lowest, energy(k));
	}
	return lowest;
}

/// No single step, or exchange of one between two cones, lowers the energy.
TEST(ConeRounding, FindsALocalMinimumWhichMostlyIsTheGlobalOne)
{
	Random random(770);
	int best = 0, atBound = 0;
	for (int trial = 0; trial < 60; ++trial) {
		const int n = 1 + trial % 4;
		std::optional<double> total;
		if (trial % 2 == 0)
			total = kQuarterTurn * (random.index(2 * n) + 1);
		const Quadratic energy(
			randomRoot(n, 1.0, 0.3, random), -kQuarterTurn, 5.0 * kQuarterTurn, total, random);
		const Eigen::VectorXd k = rounded(energy);
		const double found = energy(k), slack = 1e-9 * (1.0 + std::abs(found));
		for (int up = 0; up < n; ++up)
			for (int down = 0; down < n; ++down)
				for (const double sign : {-1.0, 1.0}) {
					Eigen::VectorXd other = k;
					other[up] += sign * kQuarterTurn;
					if (total)
						other[down] -= sign * kQuarterTurn;
					if (other.maxCoeff() < kMaxConeCurvature + 1e-9) {
						EXPECT_GE(energy(other), found - slack);
					}
				}
		const double least = lowest(energy, energy.free, 3);
		EXPECT_GE(found, least - 1e-9);
		best += found < least + 1e-9;
		atBound += k.maxCoeff() > kMaxConeCurvature - 1e-9;
	}
	EXPECT_GT(best, 54);
	EXPECT_GT(atBound, 20);
}

} // namespace
} // namespace ricci::testing
