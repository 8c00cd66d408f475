// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/complex.h"
#include "support/matrices.h"
#include "support/random.h"

#include <ricci/measure/invariants.h>

#include <array>
#include <cmath>

namespace ricci::testing {
namespace {

TEST(FundamentalDomain, ContainsTheResultAndEquivalentsAgree)
{
	Random random(150);
	for (int trial = 0; trial < 1000; ++trial) {
		const Complex tau(random.real(-0.49, 0.49), random.real(1.01, 5.0)); // inside the domain
		// A random word in the generators tau + n and -1 / tau.
		std::array<double, 4> m{1, 0, 0, 1};
		for (int letter = 0; letter < 4; ++letter) {
			const double n = random.index(5) - 2;
			m = {-m[2], -m[3], m[0] + n * m[2], m[1] + n * m[3]};
		}
		ASSERT_EQ(m[0] * m[3] - m[1] * m[2], 1);
		const Complex moved = (m[0] * tau + m[1]) / (m[2] * tau + m[3]);
		EXPECT_LT(std::abs(reduceToFundamentalDomain(moved) - tau), 1e-10);
	}
}

TEST(FundamentalDomain, HoldsTheKnownPoints)
{
	const Complex i(0, 1), rho(0.5, std::sqrt(0.75));
	for (const Complex& tau : {i, i + 3.0, -1.0 / (i - 2.0)})
		EXPECT_LT(std::abs(reduceToFundamentalDomain(tau) - i), 1e-14);
	for (const Complex& tau : {rho, rho - 1.0, -1.0 / (rho + 1.0), rho + 5.0})
		EXPECT_LT(std::abs(reduceToFundamentalDomain(tau) - rho), 1e-13);
	EXPECT_LT(std::abs(reduceToFundamentalDomain({0.0, 0.25}) - 4.0 * i), 1e-14);
	EXPECT_LT(std::abs(reduceToFundamentalDomain({0.0, -4.0}) - 4.0 * i), 1e-14);
}

TEST(FundamentalDomain, ChoosesTheRightHalfOfItsBorder)
{
	for (double y : {1.0, 1.7, 4.0})
		for (double side : {-0.5, 0.5, 1.5})
			EXPECT_LT(std::abs(reduceToFundamentalDomain({side, y}) - Complex(0.5, y)), 1e-14);
	for (double angle : {1.1, 1.3, 1.5}) {
		const Complex right = std::polar(1.0, angle), left(-right.real(), right.imag());
		EXPECT_LT(std::abs(reduceToFundamentalDomain(left) - right), 1e-13);
		EXPECT_LT(std::abs(reduceToFundamentalDomain(right) - right), 1e-13);
	}
	for (double noise : {-1e-15, 1e-15}) { // rounding changes nothing
		EXPECT_NEAR(reduceToFundamentalDomain({-0.5 + noise, 2.0}).real(), 0.5, 1e-14);
		EXPECT_GT(reduceToFundamentalDomain(std::polar(1.0 + noise, 1.8)).real(), 0.0);
	}
}

TEST(SiegelReduced, StaysInTheClass)
{
	Random random(504);
	for (const int genus : {1, 2, 3, 5, 8})
		for (int trial = 0; trial < 20; ++trial) {
			Eigen::MatrixXd root(genus, genus), real(genus, genus);
			for (double& x : root.reshaped())
				x = random.real(-1.0, 1.0);
			for (double& x : real.reshaped())
				x = random.real(-5.0, 5.0);
			Eigen::MatrixXcd omega(genus, genus);
			omega.real() = real + real.transpose();
			omega.imag() = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(genus, genus);
			const Eigen::MatrixXcd reduced = siegelReduced(omega);
			expectPeriodMatrix(reduced, genus);
			EXPECT_GE(std::abs(reduced(0, 0)), 1.0 - 1e-9);
			EXPECT_LE(reduced.real().cwiseAbs().maxCoeff(), 0.5 + 1e-9);
			for (int i = 0; i < genus; ++i)
				for (int j = i + 1; j < genus; ++j) { // Lagrange
					EXPECT_LE(2.0 * std::abs(reduced(i, j).imag()), reduced(i, i).imag() + 1e-9);
					EXPECT_LE(reduced(i, i).imag(), reduced(j, j).imag() + 1e-9);
				}
			if (genus < 4) {
				EXPECT_LT(classDistance(omega, reduced, 1e-4), 1e-6);
			}
		}
}

} // namespace
} // namespace ricci::testing
