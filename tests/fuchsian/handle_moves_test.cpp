// SPDX-License-Identifier: GPL-3.0-or-later
#include "isometries.h"
#include "support/listener.h"
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/base/tolerances.h>
#include <ricci/fuchsian/handle_moves.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

const auto kExtendedEpsilon = std::ldexp(1.0, -101); // of products

/// The side pairings of the regular polygon with 4 \p genus sides and the sum of angles 2 pi: sides
/// a1 b1 a1^-1 b1^-1 ... in their order. cosh(inradius) = cot(angle / 2) for the angle pi / (2 genus).
Handles regularHandles(int genus)
{
	const int sides = 4 * genus;
	const double angle = 2 * kPi / sides, cosh = 1 / std::tan(angle / 2);
	const double inradius = std::acosh(cosh);
	const auto toSide = [&](int side) {
		return ExtendedIsometry::rotation(angle * side) * ExtendedIsometry::translation(inradius);
	};
	// From side j to side i, turned over: the copy of the polygon beyond side i.
	const auto pairing = [&](int i, int j) {
		return (toSide(i) * ExtendedIsometry::rotation(kExtendedPi) * toSide(j).inverse())
			.normalised();
	};
	Handles handles;
	for (int side = 0; side < sides; side += 4) {
		handles.push_back(pairing(side, side + 2));
		handles.push_back(pairing(side + 3, side + 1));
	}
	// The numbers above have the precision of double.
	GroupWord word;
	Array<ExtendedIsometry> letters(2 * genus);
	for (int i = 0; i < 2 * genus; i += 2)
		for (const GroupLetter& letter :
			 {GroupLetter{i, false}, {i + 1, false}, {i, true}, {i + 1, true}})
			word.push_back(letter);
	std::copy(handles.begin(), handles.end(), letters.begin());
	closeRelation(word, ExtendedIsometry(), letters);
	return Handles(letters.begin(), letters.end());
}

/// Random Dehn twists, which make long generators of short ones.
Handles tangled(Handles handles, int twists, Random& random)
{
	for (int i = 0; i < twists; ++i) {
		const std::size_t a = at(2 * random.index(static_cast<int>(handles.size()) / 2));
		ExtendedIsometry &a1 = handles[a], &b1 = handles[a + 1];
		switch (random.index(3)) {
		case 0:
			a1 = a1 * b1;
			break;
		case 1:
			b1 = b1 * a1;
			break;
		default:
			if (a + 2 < handles.size()) {
				ExtendedIsometry &a2 = handles[a + 2], &b2 = handles[a + 3];
				const ExtendedIsometry c = b1.inverse() * a2 * b2 * a2.inverse();
				a1 = a1 * c.inverse();
				b1 = c * b1 * c.inverse();
				a2 = c * a2;
			}
		}
	}
	return handles;
}

/// Each letter wrong by a relative error of e changes the product by e times the condition at most,
/// and by much of it where errors add up.
TEST(RelationCondition, BoundsTheErrorOfTheRelation)
{
	Random random(880);
	constexpr double kError = 1e-12;
	for (const int genus : {2, 3, 4}) {
		const Handles exact = tangled(regularHandles(genus), 4, random);
		const double bound = kError * relationCondition(exact);
		double largest = 0.0;
		for (int trial = 0; trial < 200; ++trial) {
			Handles wrong = exact;
			for (ExtendedIsometry& m : wrong) {
				const ExtendedComplex turn = polar(kError, random.real(-kPi, kPi));
				const ExtendedComplex other = polar(kError, random.real(-kPi, kPi));
				m = {m.a + turn * m.a, m.b + other * m.b};
			}
			largest =
				std::max(largest, static_cast<double>(relationOf(wrong).distanceFromIdentity()));
		}
		EXPECT_LT(largest, bound + 1e-15);
		EXPECT_GT(largest, 1e-4 * bound);
	}
}

/// Generators that random twists have made long become short again, and stand for the same surface: they
/// close the relation, and no element has a fixed point.
TEST(BestConditioned, ShortensWhatTwistsHaveMadeLong)
{
	Random random(881);
	for (const int genus : {2, 3, 5}) {
		SCOPED_TRACE(genus);
		const Handles regular = regularHandles(genus);
		const double least = relationCondition(regular);
		ASSERT_LT(static_cast<double>(relationOf(regular).distanceFromIdentity()), 1e-20);
		int trials = 0, nearlyMinimal = 0;
		while (trials < 10) {
			const Handles longer = tangled(regular, 6, random);
			if (relationCondition(longer) > 1e25)
				continue; // nothing but rounding is left of the relation
			++trials;
			const Handles found = bestConditioned({longer}, {});
			ASSERT_EQ(found.size(), longer.size());
			const double condition = relationCondition(found);
			EXPECT_LE(condition, relationCondition(longer));
			EXPECT_LT(condition, 1e8 * least);
			nearlyMinimal += condition < 100 * least;
			EXPECT_LT(
				static_cast<double>(relationOf(found).distanceFromIdentity()),
				kExtendedEpsilon * condition);
			for (const ExtendedIsometry& m : found)
				EXPECT_GT(std::abs(static_cast<double>(m.trace())), 2.0);
		}
		EXPECT_GE(nearlyMinimal, 7);
	}
}

/// With boundary loops, the element of the free group is kept, so that those behind still fit.
TEST(BestConditioned, KeepsTheProductWherePeripheralElementsFollow)
{
	Random random(882);
	int improved = 0;
	for (int trial = 0; trial < 40; ++trial) {
		Handles handles;
		for (int i = 0; i < 2 * (1 + trial % 3); ++i)
			handles.push_back(randomIsometry(1.5, random));
		handles = tangled(handles, 3, random);
		const ExtendedIsometry product = relationOf(handles);
		const Handles found = bestConditioned({handles}, {product.inverse()});
		ASSERT_EQ(found.size(), handles.size());
		const double before = relationCondition(handles), after = relationCondition(found);
		EXPECT_LE(after, before);
		improved += after < 0.5 * before;
		EXPECT_LT(
			static_cast<double>((relationOf(found) * product.inverse()).distanceFromIdentity()),
			kExtendedEpsilon * after * std::pow(static_cast<double>(abs(product.a)), 2) * 8);
	}
	EXPECT_GT(improved, 10);
}

TEST(BestConditioned, TakesTheBestAndRefusesTheFar)
{
	Random random(883);
	const Handles regular = regularHandles(2), longer = tangled(regular, 6, random);
	const double best = relationCondition(bestConditioned({longer, regular}, {}));
	EXPECT_LE(best, relationCondition(regular));
	EXPECT_TRUE(bestConditioned({}, {}).empty());

	Handles far = {ExtendedIsometry::translation(1.0), ExtendedIsometry()};
	far[1] = ExtendedIsometry::rotation(kPi / 2) *
			 ExtendedIsometry::translation(kMaxGeneratorDistance + 2) *
			 ExtendedIsometry::rotation(-kPi / 2);
	EXPECT_TRUE(bestConditioned({far}, {relationOf(far).inverse()}).empty());
	far[0].b = std::numeric_limits<double>::quiet_NaN();
	EXPECT_TRUE(bestConditioned({far}, {}).empty());
}

/// Work is bounded: a checkpoint for at most 16 moves, and each lowers the condition by a tenth.
TEST(BestConditioned, IsHeardAndStops)
{
	Random random(884);
	const Handles longer = tangled(regularHandles(3), 6, random);
	Listener ticks;
	const Handles found = heard(ticks, [&] { return bestConditioned({longer, longer}, {}); });
	const double lowered = relationCondition(longer) / relationCondition(found);
	EXPECT_GE(ticks.calls(), 2);
	EXPECT_LE(ticks.calls(), 2 * (1 + std::log(lowered) / std::log(1 / 0.9)));
	Listener impatient(1);
	EXPECT_THROW(heard(impatient, [&] { bestConditioned({longer}, {}); }), Cancelled);
}

} // namespace
} // namespace ricci::testing
