// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/metric/area.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ricci::testing {
namespace {

TEST(TriangleApex, HasTheDistancesFromTheEndsOfTheBase)
{
	Random random(930);
	for (int trial = 0; trial < 200; ++trial) {
		const double base = random.real(0.1, 10.0);
		const double x = random.real(-20.0, 20.0), y = random.real(0.1, 10.0);
		const double left = std::hypot(x, y), right = std::hypot(x - base, y);
		const TriangleApex apex = triangleApex(base, left, right);
		// Heron's formula loses the square of the height over the longest side.
		const double longest = std::max({base, left, right});
		EXPECT_NEAR(apex.along, x, 1e-14 * longest * longest / base);
		EXPECT_NEAR(apex.height, y, 1e-13 * std::pow(longest, 4) / (base * base * y));
	}
}

TEST(TriangleApex, LiesOnTheBaseWhereTheSidesMakeNoTriangle)
{
	for (const double gap : {0.0, 0.1, 1.0}) {
		const TriangleApex between = triangleApex(3.0 + gap, 1.0, 2.0);
		EXPECT_EQ(between.height, 0.0);
		// Where the powers of the points of the base to both circles are equal.
		const double x = between.along;
		EXPECT_NEAR(x * x - 1.0, (x - 3.0 - gap) * (x - 3.0 - gap) - 4.0, 1e-14);
		EXPECT_EQ(triangleApex(1.0, 2.0, 3.0 + gap).height, 0.0);
	}
	// Exactly between the ends.
	EXPECT_EQ(triangleApex(3.0, 1.0, 2.0).along, 1.0);
}

} // namespace
} // namespace ricci::testing
