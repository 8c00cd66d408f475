// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/base/numbers.h>
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
	Eigen::MatrixXd inverse; // see multipliers()
	Eigen::VectorXd free;    // the minimum without bounds

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
		const int rows = n + (fixedSum ? 1 : 0);
		Eigen::MatrixXd system = Eigen::MatrixXd::Ones(rows, rows);
		system.bottomRightCorner(rows - n, rows - n).setZero();
		system.topLeftCorner(n, n) = gram;
		Eigen::VectorXd rhs = Eigen::VectorXd::Constant(rows, total.value_or(0.0));
		rhs.head(n) = -linear;
		inverse = system.fullPivLu().inverse().topLeftCorner(n, n);
		free = system.fullPivLu().solve(rhs).head(n);
	}

	/// The minimum with the bounds, and the multipliers there.
	Eigen::VectorXd minimum(Eigen::VectorXd& m) const
	{
		m = boundMultipliers(inverse, free.array() - kMax, std::move(m));
		return free - inverse * m;
	}
	Eigen::VectorXd minimum() const
	{
		Eigen::VectorXd m = Eigen::VectorXd::Zero(free.size());
		return minimum(m);
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
		const Eigen::VectorXd k = problem.minimum();
		const Eigen::VectorXd expected = problem.lowest();
		ASSERT_EQ(k.size(), expected.size());
		EXPECT_LE(k.maxCoeff(), kMax + 1e-10 * (1.0 + problem.free.norm()));
		if (problem.total) {
			EXPECT_NEAR(k.sum(), *problem.total, 1e-10 * (1.0 + problem.free.norm()));
		}
		const double size = std::abs(problem(expected)) + problem.linear.norm();
		EXPECT_NEAR(problem(k), problem(expected), 1e-10 * size) << trial;
		atBound += (k.array() > kMax - 1e-9).count() > 0;
		freed += (k.array() < kMax - 1e-9).count() > 0;
	}
	EXPECT_GT(atBound, 1000);
	EXPECT_GT(freed, 1000);
}

TEST(BoundedMinimum, FulfilsItsConditions)
{
	// Larger problems: no active set can be looked up, but the conditions of a convex minimum hold. Half
	// the gradient plus the multipliers is 0, of which those of the bounds are not negative, and 0 below them.
	Random random(241);
	for (int trial = 0; trial < 200; ++trial) {
		const Problem problem(20 + random.index(40), trial % 2 == 0, random);
		Eigen::VectorXd m = Eigen::VectorXd::Zero(problem.free.size());
		const Eigen::VectorXd k = problem.minimum(m);
		Eigen::VectorXd slope = problem.gram * k + problem.linear + m;
		if (problem.total) {
			EXPECT_NEAR(k.sum(), *problem.total, 1e-8 * static_cast<double>(k.size()));
			slope.array() -= slope.mean();
		}
		const double size = problem.linear.lpNorm<Eigen::Infinity>();
		EXPECT_LT(slope.lpNorm<Eigen::Infinity>(), 1e-8 * size);
		EXPECT_GE(m.minCoeff(), 0.0);
		EXPECT_GT(m.maxCoeff(), 0.0);
		const double slack =
			1e-14 * (problem.free.norm() + problem.inverse.norm() * m.norm()); // of rounding
		for (Eigen::Index i = 0; i < k.size(); ++i) {
			EXPECT_LT(k[i], kMax + slack);
			if (k[i] < kMax - slack) {
				EXPECT_EQ(m[i], 0.0);
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
		const Eigen::VectorXd k = problem.minimum();
		Eigen::VectorXd m(n);
		for (int i = 0; i < n; ++i)
			m[i] = random.coin() ? 0.0 : random.real(0.0, 10.0);
		m[0] = 0.0; // with a fixed sum, not all of them can be at the bound
		const Eigen::VectorXd again = problem.minimum(m);
		const double size = std::abs(problem(k)) + problem.linear.norm();
		EXPECT_NEAR(problem(again), problem(k), 1e-10 * size) << trial;
		EXPECT_LE(again.maxCoeff(), kMax + 1e-10 * (1.0 + problem.free.norm()));
	}
}

/// A multiplier is half of what the energy falls by as the bound of its entry rises: two problems with bounds
/// that differ a little.
TEST(BoundedMinimum, MultipliersAreTheDerivativeByTheBounds)
{
	Random random(243);
	int held = 0;
	for (int trial = 0; trial < 200; ++trial) {
		const Problem problem(2 + random.index(6), trial % 2 == 0, random);
		const int n = static_cast<int>(problem.free.size());
		const Eigen::VectorXd bounds = Eigen::VectorXd::Constant(n, kMax);
		const auto energy = [&](const Eigen::VectorXd& bound, Eigen::VectorXd& m) {
			m = boundMultipliers(problem.inverse, problem.free - bound, Eigen::VectorXd::Zero(n));
			return problem(problem.free - problem.inverse * m);
		};
		Eigen::VectorXd m, other;
		energy(bounds, m);
		const double step = 1e-4;
		for (int i = 0; i < n; ++i) {
			const Eigen::VectorXd by = step * Eigen::VectorXd::Unit(n, i);
			const double higher = energy(bounds + by, other);
			const bool isSame = ((other.array() > 0.0) == (m.array() > 0.0)).all();
			const double lower = energy(bounds - by, other);
			if (!isSame || !((other.array() > 0.0) == (m.array() > 0.0)).all())
				continue;
			// Quadratic in between: central differences are exact but for rounding.
			EXPECT_NEAR((lower - higher) / (4 * step), m[i], 1e-6 * (1.0 + problem.linear.norm()));
			held += m[i] > 0.0;
		}
	}
	EXPECT_GT(held, 100);
}

TEST(Multipliers, HoldEntriesAtGivenValues)
{
	Random random(244);
	for (int trial = 0; trial < 100; ++trial) {
		const Problem problem(4 + random.index(6), trial % 2 == 0, random);
		const std::vector<int> held{3, 1};
		const Eigen::VectorXd wanted = Eigen::VectorXd::Random(problem.free.size());
		const Eigen::VectorXd m = multipliers(problem.inverse, held, problem.free - wanted);
		const Eigen::VectorXd k = problem.free - problem.inverse * m;
		for (Eigen::Index i = 0; i < m.size(); ++i)
			if (i == 1 || i == 3) {
				EXPECT_NEAR(k[i], wanted[i], 1e-9 * (1.0 + problem.free.norm()));
			}
			else {
				EXPECT_EQ(m[i], 0.0);
			}
		EXPECT_EQ(multipliers(problem.inverse, {}, problem.free), Eigen::VectorXd::Zero(m.size()));
	}
}

constexpr double kQuarter = 0.5 * kPi;

/// k.G k + 2 b.k with a positive definite G, and its minimum among all real k (of a given sum).
struct Quadratic
{
	Eigen::MatrixXd gram;
	Eigen::VectorXd linear, minimum;

	Quadratic(int n, double coupling, std::optional<double> total, Random& random)
	{
		Eigen::MatrixXd root(n, n);
		for (int i = 0; i < n; ++i)
			for (int j = 0; j < n; ++j)
				root(i, j) = (i == j ? 1.0 : 0.0) + random.real(-coupling, coupling);
		gram = root.transpose() * root;
		Eigen::VectorXd wanted(n);
		for (int i = 0; i < n; ++i)
			wanted[i] = random.real(-1.0, 2.5) * kQuarter;
		linear = -gram * wanted;
		minimum = wanted;
		if (total) {
			const Eigen::VectorXd ones = Eigen::VectorXd::Ones(n);
			const Eigen::VectorXd way = gram.ldlt().solve(ones);
			minimum += way * ((*total - wanted.sum()) / way.sum());
		}
	}

	double operator()(const Eigen::VectorXd& k) const
	{
		return k.dot(gram * k) + 2.0 * linear.dot(k);
	}
};

void expectQuarterTurns(const Eigen::VectorXd& k, std::optional<double> total)
{
	for (const double x : k) {
		EXPECT_EQ(x, kQuarter * std::round(x / kQuarter));
		EXPECT_LE(x, kMaxConeCurvature);
	}
	if (total) {
		EXPECT_NEAR(k.sum(), *total, 1e-13);
	}
}

/// No single step, or exchange of one between two cones, lowers the energy.
void expectLocalMinimum(const Quadratic& energy, const Eigen::VectorXd& k, bool keepSum)
{
	const double found = energy(k), slack = 1e-9 * (1.0 + std::abs(found));
	for (int up = 0; up < k.size(); ++up) {
		const bool isFull = k[up] + kQuarter > kMaxConeCurvature + 1e-9;
		for (int down = 0; down < k.size(); ++down) {
			Eigen::VectorXd other = k;
			other[down] -= kQuarter;
			if (!keepSum) {
				EXPECT_GE(energy(other), found - slack);
			}
			if (up == down || isFull)
				continue;
			other[up] += kQuarter;
			EXPECT_GE(energy(other), found - slack);
			other[down] += kQuarter;
			if (!keepSum) {
				EXPECT_GE(energy(other), found - slack);
			}
		}
	}
}

/// The lowest energy among all quarter turns near the minimum.
double bruteForce(const Quadratic& energy, std::optional<double> total)
{
	double lowest = std::numeric_limits<double>::infinity();
	const int n = static_cast<int>(energy.minimum.size()), reach = 7;
	int combinations = 1;
	for (int i = 0; i < n; ++i)
		combinations *= reach;
	for (int c = 0; c < combinations; ++c) {
		Eigen::VectorXd k(n);
		for (int i = 0, rest = c; i < n; ++i, rest /= reach) {
			const int turns = rest % reach - reach / 2;
			k[i] = kQuarter * (std::round(energy.minimum[i] / kQuarter) + turns);
		}
		if (k.maxCoeff() <= kMaxConeCurvature + 1e-9 &&
			(!total || std::abs(k.sum() - *total) < 1e-9))
			lowest = std::min(lowest, energy(k));
	}
	return lowest;
}

TEST(ConeRounding, FindsALocalMinimumWhichMostlyIsTheGlobalOne)
{
	Random random(770);
	int best = 0, all = 0;
	for (int trial = 0; trial < 60; ++trial) {
		const int n = 1 + trial % 4;
		std::optional<double> total;
		if (trial % 2 == 0)
			total = kQuarter * (random.index(2 * n) + 1);
		const Quadratic energy(n, 0.3, total, random);
		const Eigen::VectorXd k =
			roundToQuarterTurns(energy.gram, energy.linear, energy.minimum, total);
		expectQuarterTurns(k, total);
		expectLocalMinimum(energy, k, total.has_value());
		const double lowest = bruteForce(energy, total), found = energy(k);
		EXPECT_GE(found, lowest - 1e-9);
		best += found < lowest + 1e-9;
		++all;
	}
	EXPECT_GT(best, 9 * all / 10);
}

TEST(ConeRounding, KeepsQuarterTurns)
{
	const Eigen::MatrixXd gram = Eigen::MatrixXd::Identity(4, 4);
	Eigen::VectorXd values(4);
	values << 3.0, -1.0, 2.0, 0.0;
	values *= kQuarter;
	for (const std::optional<double>& total :
		 {std::optional<double>(), std::optional(4 * kQuarter)})
		EXPECT_EQ(roundToQuarterTurns(gram, -gram * values, values, total), values);
}

TEST(ConeRounding, GivesNoConeMoreThanItMayHave)
{
	// The minimum of one cone is far above the bound: the others take the rest of the sum.
	const Eigen::MatrixXd gram = Eigen::MatrixXd::Identity(3, 3);
	Eigen::VectorXd values(3);
	values << 8.0, 0.0, 0.0;
	values *= kQuarter;
	const Eigen::VectorXd k = roundToQuarterTurns(gram, -gram * values, values, 8 * kQuarter);
	expectQuarterTurns(k, 8 * kQuarter);
	EXPECT_NEAR(k[0], kMaxConeCurvature, 1e-15);
	EXPECT_NEAR(std::abs(k[1] - k[2]), kQuarter, 1e-15); // five quarters in two equal cones
}

TEST(ConeRounding, CorrectsTheSumWhereItIsCheapest)
{
	// Three cones of 1/3 each: one of them takes the quarter turn, the one with the least stiffness.
	const Eigen::Vector3d stiffness(2.0, 1.0, 3.0);
	const Eigen::MatrixXd gram = stiffness.asDiagonal();
	const Eigen::VectorXd values = Eigen::VectorXd::Constant(3, kQuarter / 3);
	const Eigen::VectorXd k = roundToQuarterTurns(gram, -gram * values, values, kQuarter);
	EXPECT_EQ(k, kQuarter * Eigen::Vector3d(0.0, 1.0, 0.0));
}

} // namespace
} // namespace ricci::testing
