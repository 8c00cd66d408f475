// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/complex.h"
#include "support/random.h"

#include <ricci/measure/invariants.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace ricci::testing {
namespace {

Complex apply(long a, long b, long c, long d, Complex tau)
{
	return (static_cast<double>(a) * tau + static_cast<double>(b)) /
		   (static_cast<double>(c) * tau + static_cast<double>(d));
}

TEST(FundamentalDomain, ContainsTheResultAndEquivalentsAgree)
{
	Random random(150);
	for (int trial = 0; trial < 1000; ++trial) {
		const Complex tau(random.real(-0.49, 0.49), random.real(1.01, 5.0)); // inside the domain
		// A random word in the generators tau + n and -1 / tau.
		long a = 1, b = 0, c = 0, d = 1;
		for (int letter = 0; letter < 4; ++letter) {
			const long n = random.index(5) - 2;
			a += n * c, b += n * d;
			const long oldA = a, oldB = b;
			a = -c, b = -d, c = oldA, d = oldB;
		}
		ASSERT_EQ(a * d - b * c, 1);
		const Complex reduced = reduceToFundamentalDomain(apply(a, b, c, d, tau));
		EXPECT_LT(std::abs(reduced - tau), 1e-10);
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
		for (double side : {-0.5, 0.5, 1.5}) {
			const Complex reduced = reduceToFundamentalDomain({side, y});
			EXPECT_NEAR(reduced.real(), 0.5, 1e-14);
			EXPECT_NEAR(reduced.imag(), y, 1e-14);
		}
	for (double angle : {1.1, 1.3, 1.5}) {
		const Complex right = std::polar(1.0, angle), left(-right.real(), right.imag());
		EXPECT_LT(std::abs(reduceToFundamentalDomain(left) - right), 1e-13);
		EXPECT_LT(std::abs(reduceToFundamentalDomain(right) - right), 1e-13);
	}
}

TEST(FundamentalDomain, RoundingOnTheBorderChangesNothing)
{
	for (double noise : {-1e-15, 1e-15}) {
		EXPECT_NEAR(reduceToFundamentalDomain({-0.5 + noise, 2.0}).real(), 0.5, 1e-14);
		const Complex tau = std::polar(1.0 + noise, 1.8);
		EXPECT_GT(reduceToFundamentalDomain(tau).real(), 0.0);
	}
}

} // namespace
} // namespace ricci::testing
