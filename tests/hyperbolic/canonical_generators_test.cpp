// SPDX-License-Identifier: GPL-3.0-or-later
// Where words in isometries have no canonical form. fuchsian_group_test.cpp has the forms of surfaces.
#include <ricci/base/numbers.h>
#include <ricci/base/tolerances.h>
#include <ricci/error.h>
#include <ricci/hyperbolic/canonical_generators.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ricci::testing {
namespace {

/// Translation along the straight line through 0 of this direction.
ExtendedIsometry extendedAlong(double direction, double length)
{
	return ExtendedIsometry::rotation(direction) * ExtendedIsometry::translation(length) *
		   ExtendedIsometry::rotation(-direction);
}

/// The word [a,b].
const GroupWord kHandle{{0, false}, {1, false}, {0, true}, {1, true}};

ExtendedIsometry relationOf(const Handles& h)
{
	return h[0] * h[1] * h[0].inverse() * h[1].inverse();
}

TEST(CanonicalGenerators, AreNotGivenWhereTheyAreTooLarge)
{
	Array<ExtendedIsometry> g(2);
	g[0] = extendedAlong(0.0, 1.0);
	for (const double length : {kMaxSearchedDistance - 3, kMaxSearchedDistance + 3}) {
		// Across the first axis, so that no way to read the word leads to shorter ones.
		g[1] = extendedAlong(kPi / 2, length);
		EXPECT_EQ(canonicalBases(kHandle, g).empty(), length > kMaxSearchedDistance);
	}
	g[1].b = std::numeric_limits<double>::quiet_NaN();
	EXPECT_TRUE(canonicalBases(kHandle, g).empty());
}

/// Of a sphere, whose polygon's corners are three points.
TEST(CanonicalGenerators, AreNoneOfAWordWithoutHandles)
{
	const GroupWord word{{0, false}, {0, true}, {1, false}, {1, true}};
	EXPECT_THROW(canonicalBases(word, Array<ExtendedIsometry>(2)), InternalError);
}

/// The condition of [a,b] that bestConditioned() lowers: the sum of |p| |w| |q| over all letters w, where p is the
/// product of the letters before w and q = p w.
double conditionOf(const Handles& h)
{
	const auto size = [](const ExtendedIsometry& m) {
		return static_cast<double>(abs(m.a) + abs(m.b));
	};
	double sum = 0.0;
	ExtendedIsometry corner;
	for (const ExtendedIsometry& letter : {h[0], h[1], h[0].inverse(), h[1].inverse()}) {
		const ExtendedIsometry next = corner * letter;
		sum += size(corner) * size(letter) * size(next);
		corner = next;
	}
	return sum;
}

TEST(BestConditioned, TakesTheBestAndRefusesTheFar)
{
	const Handles near = {extendedAlong(0.0, 1.0), extendedAlong(kPi / 2, 2.0)};
	Handles longer = near; // with the same product
	for (int i = 0; i < 3; ++i)
		longer[0] = longer[0] * longer[1];
	ASSERT_GT(conditionOf(longer), 100.0 * conditionOf(near));
	for (const std::vector<Handles>& bases : {std::vector<Handles>{longer, near}, {near, longer}}) {
		const double best = conditionOf(bestConditioned(bases, {relationOf(near).inverse()}));
		EXPECT_LE(best, conditionOf(near) * (1.0 + 1e-12));
	}
	EXPECT_TRUE(bestConditioned({}, {}).empty());
	Handles far = {extendedAlong(0.0, 1.0), extendedAlong(kPi / 2, kMaxGeneratorDistance + 2)};
	EXPECT_TRUE(bestConditioned({far}, {relationOf(far).inverse()}).empty());
	far[0].b = std::numeric_limits<double>::quiet_NaN();
	EXPECT_TRUE(bestConditioned({far}, {}).empty());
}

} // namespace
} // namespace ricci::testing
