// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/complex.h"
#include "support/random.h"

#include <ricci/layout/hyperbolic_layout.h>

#include <gtest/gtest.h>

#include <cmath>

namespace ricci::testing {
namespace {

TEST(HyperbolicLayout, OrientationIsThatOfTheGeodesicTriangle)
{
	Random random(610);
	int clear = 0;
	for (int i = 0; i < 1000; ++i) {
		const auto point = [&] {
			return std::polar(std::sqrt(random.real(0.0, 0.95)), random.real(0.0, 6.28));
		};
		const Complex p = point(), q = point(), r = point();
		const int sign = hyperbolicOrientation(p, q, r);
		EXPECT_EQ(hyperbolicOrientation(q, r, p), sign);
		EXPECT_EQ(hyperbolicOrientation(q, p, r), -sign);
		// In the Klein model geodesics are straight.
		const auto klein = [](Complex z) { return 2.0 * z / (1.0 + std::norm(z)); };
		const double area = (std::conj(klein(q) - klein(p)) * (klein(r) - klein(p))).imag();
		if (std::abs(area) > 1e-12) {
			EXPECT_EQ(sign, area > 0 ? 1 : -1);
			++clear;
		}
	}
	EXPECT_GT(clear, 900);
	EXPECT_EQ(hyperbolicOrientation(0.0, 0.25, 0.5), 0);
}

} // namespace
} // namespace ricci::testing
