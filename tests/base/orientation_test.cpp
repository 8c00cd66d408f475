// SPDX-License-Identifier: GPL-3.0-or-later
// Points, and the exact predicate.
#include "support/random.h"

#include <ricci/base/points.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdint>

namespace ricci::testing {
namespace {

__extension__ typedef __int128 Wide;

struct Lattice
{
	std::int64_t x, y;
};

/// Exact for coordinates below 2^60.
int exactOrientation(const Lattice& a, const Lattice& b, const Lattice& c)
{
	const Wide area = Wide(b.x - a.x) * Wide(c.y - a.y) - Wide(b.y - a.y) * Wide(c.x - a.x);
	return area > 0 ? 1 : area < 0 ? -1 : 0;
}

Point2 scaled(const Lattice& p, int exponent)
{
	return {
		std::ldexp(static_cast<double>(p.x), exponent),
		std::ldexp(static_cast<double>(p.y), exponent)};
}

void expectExact(const Lattice& a, const Lattice& b, const Lattice& c)
{
	const int expected = exactOrientation(a, b, c);
	for (int exponent : {-300, -50, 0, 7, 300}) {
		const Point2 p = scaled(a, exponent), q = scaled(b, exponent), r = scaled(c, exponent);
		ASSERT_EQ(orientation(p, q, r), expected);
		ASSERT_EQ(orientation(q, r, p), expected);
		ASSERT_EQ(orientation(q, p, r), -expected);
	}
}

std::int64_t integer(Random& random, std::int64_t bound)
{
	return static_cast<std::int64_t>(
		random.real(-static_cast<double>(bound), static_cast<double>(bound)));
}

TEST(Orientation, RandomTriangles)
{
	Random random(100);
	for (std::int64_t bound : {std::int64_t(4), std::int64_t(1000), std::int64_t(1) << 52})
		for (int i = 0; i < 3000; ++i) {
			const auto any = [&] {
				return Lattice{integer(random, bound), integer(random, bound)};
			};
			expectExact(any(), any(), any());
		}
}

TEST(Orientation, NearlyCollinearPoints)
{
	// c = a + k (b - a) + an offset of at most one unit, with all coordinates below 2^53.
	Random random(101);
	int signs[3] = {0, 0, 0};
	for (int i = 0; i < 20000; ++i) {
		const std::int64_t size = std::int64_t(1) << (10 + random.index(38));
		const Lattice a{integer(random, size), integer(random, size)};
		const Lattice step{integer(random, size), integer(random, size)};
		const int m = 1 + random.index(10), k = 1 + random.index(10);
		const Lattice b{a.x + m * step.x, a.y + m * step.y};
		const Lattice c{
			a.x + k * step.x + random.index(3) - 1, a.y + k * step.y + random.index(3) - 1};
		expectExact(a, b, c);
		++signs[exactOrientation(a, b, c) + 1];
	}
	for (int n : signs)
		EXPECT_GT(n, 1000);
}

TEST(Orientation, HoldsNearTheSmallestNumbersAsFarAsPromised)
{
	Random random(103);
	const auto expectSign = [](const Lattice& a, const Lattice& b, const Lattice& c, int exponent) {
		EXPECT_EQ(
			orientation(scaled(a, exponent), scaled(b, exponent), scaled(c, exponent)),
			exactOrientation(a, b, c))
			<< exponent;
	};
	int tested = 0;
	for (int i = 0; i < 20000; ++i) {
		// Nearly collinear, with coordinates of up to 53 bits.
		const std::int64_t size = std::int64_t(1) << 48;
		const Lattice a{integer(random, size), integer(random, size)};
		const Lattice step{integer(random, size), integer(random, size)};
		const Lattice b{a.x + 7 * step.x, a.y + 7 * step.y};
		const Lattice c{a.x + 3 * step.x + random.index(9) - 4, a.y + 3 * step.y};
		expectSign(a, b, c, -485); // products from 2^-970 on
		// Here products lose digits, but not those of areas above 2^-1072.
		const Wide area = Wide(b.x - a.x) * Wide(c.y - a.y) - Wide(b.y - a.y) * Wide(c.x - a.x);
		if (area > (Wide(1) << 48) || area < -(Wide(1) << 48)) {
			expectSign(a, b, c, -560);
			++tested;
		}
	}
	EXPECT_GT(tested, 10000);
}

TEST(Orientation, NeighbouringDoublesOnADiagonal)
{
	// The classic picture: the filter alone fails for points within a few units of the line y = x.
	const double unit = std::ldexp(1.0, -53);
	for (int i = 0; i < 64; ++i)
		for (int j = 0; j < 64; ++j) {
			const Point2 p{0.5 + i * unit, 0.5 + j * unit};
			EXPECT_EQ(orientation(p, {12.0, 12.0}, {24.0, 24.0}), (i < j) - (i > j));
		}
}

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
