// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/base/points.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace ricci::testing {
namespace {

Point2 randomPoint(Random& random)
{
	return {random.real(-2, 2), random.real(-2, 2)};
}

TEST(Points, DistancesAreThoseOfPythagoras)
{
	EXPECT_EQ(distance(Point2{1, 1}, Point2{4, 5}), 5.0);
	EXPECT_EQ(distance(Point3{1, 1, 1}, Point3{3, 4, 7}), 7.0);
	EXPECT_DOUBLE_EQ(distance(Point2{3e200, 0}, Point2{0, 4e200}), 5e200); // not its square
	EXPECT_DOUBLE_EQ(distance(Point3{3e-200, 0, 0}, Point3{0, 0, 4e-200}), 5e-200);
	Random random(360);
	for (int i = 0; i < 100; ++i) {
		const Point2 p = randomPoint(random), q = randomPoint(random);
		EXPECT_EQ(distance(p, q), distance(q, p));
		EXPECT_NEAR(distance(p, q), std::abs(asComplex(p) - asComplex(q)), 1e-15);
		EXPECT_EQ(asComplex(p), std::complex<double>(p[0], p[1]));
		EXPECT_EQ(asPoint(asComplex(p)), p);
	}
}

TEST(NearestOnSegment, HasNoNearerPointBesideIt)
{
	Random random(361);
	for (int i = 0; i < 2000; ++i) {
		const Point2 a = randomPoint(random), b = randomPoint(random), p = randomPoint(random);
		const double share = nearestOnSegment(a, b, p);
		EXPECT_GE(share, 0.0);
		EXPECT_LE(share, 1.0);
		const double apart = distance(p, between(a, b, share));
		for (int k = 0; k <= 64; ++k)
			EXPECT_LE(apart, distance(p, between(a, b, k / 64.0)) * (1.0 + 1e-12));
	}
	const Point2 a{1.0, 2.0}, b{5.0, 2.0};
	EXPECT_EQ(nearestOnSegment(a, b, {2.0, 7.0}), 0.25);
	EXPECT_EQ(nearestOnSegment(a, b, {9.0, 2.5}), 1.0);
	EXPECT_EQ(nearestOnSegment(a, b, {-3.0, 2.5}), 0.0);
	EXPECT_EQ(nearestOnSegment(a, a, b), 0.0);
	EXPECT_EQ(between(a, b, 0.25), (Point2{2.0, 2.0}));
	EXPECT_EQ(between(a, a, 1.0), a);
}

} // namespace
} // namespace ricci::testing
