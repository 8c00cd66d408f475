// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/base/numbers.h>
#include <ricci/cones/cone_curvatures.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace ricci::testing {
namespace {

/// k.G k + 2 b.k with a positive definite G, and its minimum among all real k (of a given sum).
struct Quadratic
{
	Eigen::MatrixXd gram;
	Eigen::VectorXd linear;
	std::optional<double> total;
	Eigen::VectorXd free; // the minimum

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
