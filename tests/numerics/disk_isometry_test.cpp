// SPDX-License-Identifier: GPL-3.0-or-later
// What fuchsian_group_test.cpp and tiling_test.cpp take for granted: their traces, lengths and angles are tested there.
#include "support/random.h"

#include <ricci/base/numbers.h>
#include <ricci/layout/hyperbolic_layout.h>
#include <ricci/numerics/disk_isometry.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace ricci::testing {
namespace {

using Complex = std::complex<double>;

DiskIsometry randomIsometry(Random& random)
{
	return DiskIsometry::rotation(random.real(-kPi, kPi)) *
		   DiskIsometry::translation(random.real(0.0, 3.0)) *
		   DiskIsometry::rotation(random.real(-kPi, kPi));
}

Complex randomPoint(Random& random)
{
	return std::polar(std::sqrt(random.real(0.0, 0.9)), random.real(-kPi, kPi));
}

double gap(const DiskIsometry& p, const DiskIsometry& q)
{
	return (p * q.inverse()).distanceFromIdentity();
}

TEST(DiskIsometry, IsometriesAreAGroupThatActsOnTheDisk)
{
	Random random(80);
	for (int i = 0; i < 500; ++i) {
		const DiskIsometry p = randomIsometry(random), q = randomIsometry(random),
						   r = randomIsometry(random);
		EXPECT_LT(gap((p * q) * r, p * (q * r)), 1e-9);
		EXPECT_LT((p * p.inverse()).distanceFromIdentity(), 1e-13);
		EXPECT_LT((p.inverse() * p).distanceFromIdentity(), 1e-13);
		EXPECT_LT(gap((p * q).inverse(), q.inverse() * p.inverse()), 1e-10);
		EXPECT_NEAR(std::norm(p.a) - std::norm(p.b), 1.0, 1e-13);
		const double scale = random.real(0.5, 2.0);
		EXPECT_LT(gap(DiskIsometry{scale * p.a, scale * p.b}.normalised(), p), 1e-13);
		const Complex z = randomPoint(random), w = randomPoint(random);
		EXPECT_LT(std::abs((p * q)(z) -p(q(z))), 1e-12);
		EXPECT_LT(std::abs(p.inverse()(p(z)) - z), 1e-12);
		EXPECT_LT(std::abs(p(0.0) - p.origin()), 1e-14);
		EXPECT_LT(std::abs(p(z)), 1.0);
		// Distances are kept, and the sense of rotation.
		EXPECT_NEAR(chordLength(p(z), p(w)) / chordLength(z, w), 1.0, 1e-11);
		const Complex x = randomPoint(random);
		EXPECT_EQ(hyperbolicOrientation(p(z), p(w), p(x)), hyperbolicOrientation(z, w, x));
	}
	EXPECT_EQ((DiskIsometry{{-1, 0}, {0, 0}}).distanceFromIdentity(), 0.0); // the same isometry
}

/// Short ones too, to the last digits.
TEST(DiskIsometry, TranslationsMoveByTheirLength)
{
	for (const double length : {0.0, 1e-9, 1e-3, 0.3, 5.0})
		EXPECT_NEAR(DiskIsometry::translation(length).displacement(), length, 1e-14 * length);
}

TEST(DiskIsometry, AxisEndsAreFixedAndPointsMoveFromOneToTheOther)
{
	Random random(85);
	for (int i = 0; i < 500; ++i) {
		const DiskIsometry g = randomIsometry(random);
		const double length = random.real(0.1, 4.0);
		for (double sign : {1.0, -1.0}) { // the same isometry
			DiskIsometry along = g * DiskIsometry::translation(length) * g.inverse();
			along = {sign * along.a, sign * along.b};
			Complex from, to;
			ASSERT_TRUE(along.axis(from, to));
			EXPECT_LT(std::abs(from - g(-1.0)), 1e-9);
			EXPECT_LT(std::abs(to - g(1.0)), 1e-9);
			EXPECT_LT(std::abs(along(from) - from), 1e-9);
			EXPECT_LT(std::abs(along(to) - to), 1e-9);
			ASSERT_TRUE(along.inverse().axis(from, to)); // the other way
			EXPECT_LT(std::abs(to - g(-1.0)), 1e-9);
		}
		Complex from, to;
		const DiskIsometry turn = g * DiskIsometry::rotation(random.real(0.1, kPi)) * g.inverse();
		EXPECT_FALSE(turn.axis(from, to));
	}
	Complex from, to;
	EXPECT_FALSE(DiskIsometry().axis(from, to));
	EXPECT_FALSE((DiskIsometry{{1.0, 0.5}, 0.5}).axis(from, to)); // moves along a horocycle
}

} // namespace
} // namespace ricci::testing
