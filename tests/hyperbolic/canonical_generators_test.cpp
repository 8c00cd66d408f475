// SPDX-License-Identifier: GPL-3.0-or-later
// Where words in isometries have no canonical form. fuchsian_group_test.cpp has the forms of surfaces.
#include "support/random.h"
#include "support/shapes.h"

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

/// [a1,b1] ... [ag,bg].
ExtendedIsometry relationOf(const Handles& handles)
{
	ExtendedIsometry product;
	for (std::size_t i = 0; i + 1 < handles.size(); i += 2)
		product =
			product * handles[i] * handles[i + 1] * handles[i].inverse() * handles[i + 1].inverse();
	return product;
}

GroupWord canonicalWord(int genus)
{
	GroupWord word;
	for (int i = 0; i < 2 * genus; i += 2)
		for (const GroupLetter& letter :
			 {GroupLetter{i, false}, {i + 1, false}, {i, true}, {i + 1, true}})
			word.push_back(letter);
	return word;
}

TEST(CanonicalGenerators, AreNotGivenWhereTheyAreTooLarge)
{
	Array<ExtendedIsometry> g(2);
	g[0] = extendedAlong(0.0, 1.0);
	for (const double length : {kMaxSearchedDistance - 3, kMaxSearchedDistance + 3}) {
		// Across the first axis, so that no way to read the word leads to shorter ones.
		g[1] = extendedAlong(kPi / 2, length);
		EXPECT_EQ(canonicalBases(canonicalWord(1), g).empty(), length > kMaxSearchedDistance);
	}
	g[1].b = std::numeric_limits<double>::quiet_NaN();
	EXPECT_TRUE(canonicalBases(canonicalWord(1), g).empty());
}

/// Of a sphere, whose polygon's corners are three points.
TEST(CanonicalGenerators, AreNoneOfAWordWithoutHandles)
{
	const GroupWord word{{0, false}, {0, true}, {1, false}, {1, true}};
	EXPECT_THROW(canonicalBases(word, Array<ExtendedIsometry>(2)), InternalError);
}

/// The side pairings of the regular polygon with 4 \p genus sides and the sum of angles 2 pi: sides
/// a1 b1 a1^-1 b1^-1 ... in their order. cosh(inradius) = cot(angle / 2) for the angle pi / (2 genus).
Handles regularHandles(int genus)
{
	const int sides = 4 * genus;
	const double angle = 2 * kPi / sides, inradius = std::acosh(1 / std::tan(angle / 2));
	const auto toSide = [&](int side) {
		return ExtendedIsometry::rotation(angle * side) * ExtendedIsometry::translation(inradius);
	};
	// From side j to side i, turned over: the copy of the polygon beyond side i.
	const auto pairing = [&](int i, int j) {
		return (toSide(i) * ExtendedIsometry::rotation(kExtendedPi) * toSide(j).inverse())
			.normalised();
	};
	Array<ExtendedIsometry> letters;
	for (int side = 0; side < sides; side += 4) {
		letters.push_back(pairing(side, side + 2));
		letters.push_back(pairing(side + 3, side + 1));
	}
	closeRelation(
		canonicalWord(genus), ExtendedIsometry(), letters); // they have the precision of double
	return Handles(letters.begin(), letters.end());
}

/// Random Dehn twists, which make long generators of short ones.
Handles tangled(Handles handles, int twists, Random& random)
{
	for (int i = 0; i < twists; ++i) {
		const std::size_t a = at(2 * random.index(static_cast<int>(handles.size()) / 2));
		ExtendedIsometry &a1 = handles[a], &b1 = handles[a + 1];
		const int kind = random.index(3);
		if (kind == 0)
			a1 = a1 * b1;
		else if (kind == 1)
			b1 = b1 * a1;
		else if (a + 2 < handles.size()) {
			ExtendedIsometry &a2 = handles[a + 2], &b2 = handles[a + 3];
			const ExtendedIsometry c = b1.inverse() * a2 * b2 * a2.inverse();
			a1 = a1 * c.inverse();
			b1 = c * b1 * c.inverse();
			a2 = c * a2;
		}
	}
	return handles;
}

/// The condition of [a1,b1] ... [ag,bg] that bestConditioned() lowers: the sum of |p| |w| |q| over all letters w, where
/// p is the product of the letters before w and q = p w.
double conditionOf(const Handles& handles)
{
	const auto size = [](const ExtendedIsometry& m) {
		return static_cast<double>(abs(m.a) + abs(m.b));
	};
	double sum = 0.0;
	ExtendedIsometry corner;
	for (std::size_t i = 0; i + 1 < handles.size(); i += 2)
		for (const ExtendedIsometry& letter :
			 {handles[i], handles[i + 1], handles[i].inverse(), handles[i + 1].inverse()}) {
			const ExtendedIsometry next = corner * letter;
			sum += size(corner) * size(letter) * size(next);
			corner = next;
		}
	return sum;
}

TEST(BestConditioned, TakesTheBestAndRefusesTheFar)
{
	Random random(883);
	const Handles regular = regularHandles(2), longer = tangled(regular, 6, random);
	const double best = conditionOf(bestConditioned({longer, regular}, {}));
	EXPECT_LE(best, conditionOf(regular));
	EXPECT_TRUE(bestConditioned({}, {}).empty());
	Handles far = {extendedAlong(0.0, 1.0), extendedAlong(kPi / 2, kMaxGeneratorDistance + 2)};
	EXPECT_TRUE(bestConditioned({far}, {relationOf(far).inverse()}).empty());
	far[0].b = std::numeric_limits<double>::quiet_NaN();
	EXPECT_TRUE(bestConditioned({far}, {}).empty());
}

} // namespace
} // namespace ricci::testing
