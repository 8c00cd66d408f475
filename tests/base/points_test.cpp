// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/base/points.h>

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(Points, DoubledAreaIsThatOfTheShoelaceFormula)
{
	EXPECT_EQ(doubledArea({0, 0}, {3, 0}, {0, 4}), 12.0);
	EXPECT_EQ(doubledArea({0, 0}, {0, 4}, {3, 0}), -12.0);
	EXPECT_EQ(doubledArea({1, 1}, {2, 2}, {3, 3}), 0.0);
	Random random(361);
	for (int i = 0; i < 100; ++i) {
		const Point2 a = randomPoint(random), b = randomPoint(random), c = randomPoint(random);
		const double shoelace =
			a[0] * b[1] - a[1] * b[0] + b[0] * c[1] - b[1] * c[0] + c[0] * a[1] - c[1] * a[0];
		EXPECT_NEAR(doubledArea(a, b, c), shoelace, 1e-13);
		EXPECT_NEAR(doubledArea(b, c, a), shoelace, 1e-13);
	}
}

TEST(Box2, HoldsItsPointsAndNoMore)
{
	Random random(362);
	for (int trial = 0; trial < 50; ++trial) {
		Box2 box;
		Point2 least = randomPoint(random), most = least;
		box.add(least);
		for (int i = random.index(6); i > 0; --i) {
			const Point2 p = randomPoint(random);
			box.add(p);
			EXPECT_TRUE(box.contains(p));
			for (std::size_t k = 0; k < 2; ++k) {
				least[k] = std::min(least[k], p[k]);
				most[k] = std::max(most[k], p[k]);
			}
		}
		EXPECT_EQ(box.min, least);
		EXPECT_EQ(box.max, most);
		EXPECT_EQ(box.width(), most[0] - least[0]);
		EXPECT_EQ(box.height(), most[1] - least[1]);
		EXPECT_EQ(box.extent(), std::max(box.width(), box.height()));
		EXPECT_TRUE(box.contains(least));
		EXPECT_FALSE(box.contains({most[0] + 1e-9, most[1]}));
		EXPECT_FALSE(box.contains({least[0], least[1] - 1e-9}));
		Box2 other;
		other.add(box);
		EXPECT_EQ(other.min, box.min);
		EXPECT_EQ(other.max, box.max);
	}
	EXPECT_FALSE(Box2().contains({0, 0}));
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

TEST(Box2, MeetsOnlyWithInnerPointsInCommon)
{
	const auto box = [](double x0, double y0, double x1, double y1) {
		Box2 b;
		b.add(Point2{x0, y0});
		b.add(Point2{x1, y1});
		return b;
	};
	const Box2 unit = box(0, 0, 1, 1);
	EXPECT_TRUE(unit.meets(unit));
	EXPECT_TRUE(unit.meets(box(0.5, 0.5, 2, 2)));
	EXPECT_TRUE(unit.meets(box(0.4, -3, 0.6, 3)));
	EXPECT_TRUE(unit.meets(box(0.4, 0.4, 0.6, 0.6)));
	for (const Point2& shift : {Point2{1, 0}, Point2{-1, 0}, Point2{0, 1}, Point2{0, -1}})
		EXPECT_FALSE(unit.meets(box(shift[0], shift[1], shift[0] + 1, shift[1] + 1))); // a side
	EXPECT_FALSE(unit.meets(box(1, 1, 2, 2))); // a common corner
	EXPECT_FALSE(unit.meets(box(0.5, 1.5, 0.6, 2)));
	EXPECT_FALSE(unit.meets(Box2()));
}

} // namespace
} // namespace ricci::testing
