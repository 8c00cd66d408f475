// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"
#include "support/wide.h"

#include <ricci/metric/euclidean.h>

#include <gtest/gtest.h>

#include <cmath>

namespace ricci::testing {
namespace {

TEST(Euclidean, LengthIsTheLawOfCosinesWithTheInversiveDistance)
{
	RICCI_NEEDS_WIDE_LONG_DOUBLE();
	Random random(20);
	for (int i = 0; i < 1000; ++i) {
		const double ui = random.real(-9, 9), uj = random.real(-9, 9);
		const double delta = std::pow(10.0, random.real(-12, 6));
		const auto a = Euclidean::circle(ui), b = Euclidean::circle(uj);
		const auto edge = Euclidean::edge(a, b, delta);
		const long double gi = a.radius, gj = b.radius, I = 1.0L + delta;
		const long double l = std::sqrt(gi * gi + gj * gj + 2 * I * gi * gj);
		EXPECT_NEAR(edge.length / static_cast<double>(l), 1.0, 4e-16);
		EXPECT_NEAR(edge.sine2 / static_cast<double>(l * l), 1.0, 6e-16);
		// The difference of length and radii cancels; 80 bits leave it this exact.
		const long double excess = l - gi - gj;
		const double error = 6e-16 + 2e-19 * static_cast<double>(l / excess);
		EXPECT_NEAR(edge.excess / static_cast<double>(excess), 1.0, error);
		EXPECT_EQ(edge.cosineLess1, 0.0);
	}
}

TEST(Euclidean, DeltaInvertsTheLength)
{
	Random random(21);
	for (int i = 0; i < 1000; ++i) {
		const double gi = std::exp(random.real(-3, 3)), gj = std::exp(random.real(-3, 3));
		const double l = (gi + gj) * random.real(1.0, 5.0);
		const auto edge = Euclidean::edge(
			Euclidean::circle(std::log(gi)),
			Euclidean::circle(std::log(gj)),
			Euclidean::delta(l, gi, gj));
		EXPECT_NEAR(edge.length / l, 1.0, 2e-15);
	}
}

TEST(Euclidean, CircleIsTheExponentialOfU)
{
	const auto circle = Euclidean::circle(std::log(0.25));
	EXPECT_NEAR(circle.radius, 0.25, 1e-16);
	EXPECT_EQ(circle.s, circle.radius);
	EXPECT_NEAR(circle.kappa, 4.0, 2e-15);
}

} // namespace
} // namespace ricci::testing
