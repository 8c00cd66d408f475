// SPDX-License-Identifier: GPL-3.0-or-later
// Words in isometries, their canonical form, and the moves that make it short.
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/base/graphs.h>
#include <ricci/base/numbers.h>
#include <ricci/base/tolerances.h>
#include <ricci/error.h>
#include <ricci/hyperbolic/canonical_generators.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace ricci::testing {
namespace {

double errorOf(const ExtendedIsometry& m)
{
	return static_cast<double>(m.distanceFromIdentity());
}

/// Translation along the straight line through 0 of this direction.
ExtendedIsometry extendedAlong(double direction, double length)
{
	return ExtendedIsometry::rotation(direction) * ExtendedIsometry::translation(length) *
		   ExtendedIsometry::rotation(-direction);
}

ExtendedIsometry randomIsometry(double maxLength, Random& random)
{
	return (ExtendedIsometry::rotation(random.real(-kPi, kPi)) *
			ExtendedIsometry::translation(random.real(0.0, maxLength)) *
			ExtendedIsometry::rotation(random.real(-kPi, kPi)))
		.normalised();
}

Array<ExtendedIsometry> randomIsometries(int count, double maxLength, Random& random)
{
	Array<ExtendedIsometry> generators(count);
	for (ExtendedIsometry& g : generators)
		g = randomIsometry(maxLength, random);
	return generators;
}

ExtendedIsometry productOf(const GroupWord& word, const Array<ExtendedIsometry>& generators)
{
	ExtendedIsometry product;
	for (const auto& [generator, isInverse] : word)
		product = product * (isInverse ? generators[generator].inverse() : generators[generator]);
	return product;
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

/// Every generator and its inverse, in random order.
GroupWord randomWord(int generators, Random& random)
{
	GroupWord word;
	for (int g = 0; g < generators; ++g)
		for (const bool inverse : {false, true})
			word.push_back({g, inverse});
	random.shuffle(word);
	return word;
}

/// Points that the corners of the polygon with these sides become when its sides are glued.
std::size_t cornerCount(const GroupWord& word)
{
	const int n = static_cast<int>(word.size());
	DisjointSets points(n); // corner k is where side k begins
	for (int i = 0; i < n; ++i)
		for (int j = 0; j < n; ++j)
			if (i != j && word[at(i)].generator == word[at(j)].generator) {
				points.merge(i, (j + 1) % n);
				points.merge((i + 1) % n, j);
			}
	std::set<int> different;
	for (int k = 0; k < n; ++k)
		different.insert(points.find(k));
	return different.size();
}

/// The relation is one of the free group: it holds whatever isometries stand for the letters. A
/// polygon whose corners are not all one point has no such basis.
TEST(CanonicalGenerators, HaveTheProductOfTheWord)
{
	Random random(871);
	int canonical = 0, refused = 0;
	for (int trial = 0; trial < 600; ++trial) {
		const int generators = 2 * (1 + random.index(3));
		const GroupWord word = randomWord(generators, random);
		const Array<ExtendedIsometry> g = randomIsometries(generators, 0.5, random);
		if (cornerCount(word) != 1) {
			EXPECT_THROW(canonicalBases(word, g), InternalError);
			++refused;
			continue;
		}
		const std::vector<Handles> bases = canonicalBases(word, g);
		ASSERT_FALSE(bases.empty());
		for (const Handles& handles : bases) {
			ASSERT_EQ(handles.size(), at(generators));
			double size = 1.0;
			for (const ExtendedIsometry& h : handles)
				size *= std::pow(static_cast<double>(abs(h.a) + abs(h.b)), 2);
			EXPECT_LT(
				errorOf(relationOf(handles).inverse() * productOf(word, g)), 100 * 0x1p-66 * size);
		}
		++canonical;
	}
	EXPECT_GT(canonical, 50); // or the test says little
	EXPECT_GT(refused, 50);
}

/// The word with x P y Q x^-1 R y^-1 S put for P S R Q, for every handle in turn: all corners of its
/// polygon are one point, and the letters of a handle lie far apart. Beyond genus 25 fewer words are followed.
TEST(CanonicalGenerators, OfManyHandlesHaveTheProductOfTheWord)
{
	Random random(874);
	const int handles = 26;
	GroupWord word;
	for (int g = 0; g < 2 * handles; g += 2) {
		std::array<std::ptrdiff_t, 3> place{};
		for (std::ptrdiff_t& i : place)
			i = random.index(static_cast<int>(word.size()) + 1);
		std::sort(place.begin(), place.end());
		const auto begin = word.begin();
		GroupWord next{{g, false}};
		next.insert(next.end(), begin, begin + place[0]);
		next.push_back({g + 1, false});
		next.insert(next.end(), begin + place[2], word.end());
		next.push_back({g, true});
		next.insert(next.end(), begin + place[1], begin + place[2]);
		next.push_back({g + 1, true});
		next.insert(next.end(), begin + place[0], begin + place[1]);
		word = next;
	}
	ASSERT_EQ(cornerCount(word), 1u);
	const Array<ExtendedIsometry> g = randomIsometries(2 * handles, 1e-3, random);
	const Handles found = canonicalBases(word, g).front();
	ASSERT_EQ(found.size(), at(2 * handles));
	EXPECT_LT(errorOf(relationOf(found).inverse() * productOf(word, g)), 1e-12);
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

/// By how much g was moved, in the Lie algebra, from the left: the sum of squares.
double moveOf(const ExtendedIsometry& before, const ExtendedIsometry& after)
{
	const ExtendedIsometry m = after * before.inverse();
	return static_cast<double>(
		m.a.imag() * m.a.imag() + m.b.real() * m.b.real() + m.b.imag() * m.b.imag());
}

/// Generators that fit are disturbed: taking the disturbance back would close the relation, so that
/// the least move is not larger.
TEST(CloseRelation, ClosesItByALeastMove)
{
	Random random(873);
	int closed = 0;
	for (int trial = 0; trial < 300; ++trial) {
		const int generators = 2 * (1 + random.index(3));
		const GroupWord word = randomWord(generators, random);
		if (cornerCount(word) != 1)
			continue;
		++closed;
		const Array<ExtendedIsometry> exact = randomIsometries(generators, 0.7, random);
		const ExtendedIsometry tail = productOf(word, exact).inverse();
		Array<ExtendedIsometry> disturbed = exact;
		for (ExtendedIsometry& g : disturbed)
			g = ExtendedIsometry::rotation(random.real(-1e-6, 1e-6)) *
				ExtendedIsometry::translation(random.real(-1e-6, 1e-6)) * g;
		Array<ExtendedIsometry> mended = disturbed;
		closeRelation(word, tail, mended);
		EXPECT_LT(errorOf(productOf(word, mended) * tail), 1e-15);
		double moved = 0.0, back = 0.0;
		for (const int g : mended.indices()) {
			moved += moveOf(disturbed[g], mended[g]);
			back += moveOf(disturbed[g], exact[g]);
		}
		EXPECT_LE(moved, back * (1.0 + 1e-4));
		EXPECT_GT(moved, 0.0);
	}
	EXPECT_GT(closed, 20); // or the test says little
}

const auto kProductEpsilon = std::ldexp(1.0, -101);

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

/// Generators that random twists have made long become short again, and stand for the same surface: they
/// close the relation, and no element has a fixed point.
TEST(BestConditioned, ShortensWhatTwistsHaveMadeLong)
{
	Random random(881);
	for (const int genus : {2, 3, 5}) {
		SCOPED_TRACE(genus);
		const Handles regular = regularHandles(genus);
		const double least = conditionOf(regular);
		ASSERT_LT(errorOf(relationOf(regular)), 1e-20);
		int trials = 0, nearlyMinimal = 0;
		while (trials < 10) {
			const Handles longer = tangled(regular, 6, random);
			if (conditionOf(longer) > 1e25)
				continue; // nothing but rounding is left of the relation
			++trials;
			const Handles found = bestConditioned({longer}, {});
			ASSERT_EQ(found.size(), longer.size());
			const double condition = conditionOf(found);
			EXPECT_LE(condition, conditionOf(longer));
			EXPECT_LT(condition, 1e8 * least);
			nearlyMinimal += condition < 100 * least;
			EXPECT_LT(errorOf(relationOf(found)), kProductEpsilon * condition);
			for (const ExtendedIsometry& m : found)
				EXPECT_GT(std::abs(static_cast<double>(m.trace())), 2.0);
		}
		EXPECT_GE(nearlyMinimal, 7);
	}
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
