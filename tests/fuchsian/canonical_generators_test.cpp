// SPDX-License-Identifier: GPL-3.0-or-later
#include "isometries.h"
#include "support/listener.h"
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/base/tolerances.h>
#include <ricci/error.h>
#include <ricci/fuchsian/canonical_generators.h>
#include <ricci/math/disjoint_sets.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <vector>

namespace ricci::testing {
namespace {

Array<ExtendedIsometry> randomIsometries(int count, double maxLength, Random& random)
{
	Array<ExtendedIsometry> generators(count);
	for (ExtendedIsometry& g : generators)
		g = randomIsometry(maxLength, random);
	return generators;
}

/// Every generator and its inverse, in random order.
GroupWord randomWord(int generators, Random& random)
{
	GroupWord word;
	for (int g = 0; g < generators; ++g) {
		word.push_back({g, false});
		word.push_back({g, true});
	}
	random.shuffle(word);
	return word;
}

/// Points that the corners of the polygon with these sides become when its sides are glued.
int cornerCount(const GroupWord& word)
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
	return static_cast<int>(different.size());
}

TEST(CanonicalGenerators, ProductsAreReadFromTheLeft)
{
	Random random(870);
	const Array<ExtendedIsometry> g = randomIsometries(2, 1.0, random);
	const ExtendedIsometry product = productOf({{0, false}, {1, true}, {0, true}}, g);
	const ExtendedIsometry wanted = g[0] * g[1].inverse() * g[0].inverse();
	EXPECT_LT(static_cast<double>((product.inverse() * wanted).distanceFromIdentity()), 1e-17);
	EXPECT_EQ(productOf({}, g).distanceFromIdentity(), 0.0);
}

/// The relation is one of the free group: it holds whatever isometries stand for the letters. A
/// polygon whose corners are not all one point has no such basis.
TEST(CanonicalGenerators, HaveTheProductOfTheWord)
{
	Random random(871);
	int canonical = 0, refused = 0;
	for (int trial = 0; trial < 600; ++trial) {
		const int generators = 2 * (1 + random.index(3)), genus = generators / 2;
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
			ASSERT_EQ(handles.size(), at(2 * genus));
			double size = 1.0;
			for (const ExtendedIsometry& h : handles)
				size *= std::pow(static_cast<double>(abs(h.a) + abs(h.b)), 2);
			const ExtendedIsometry difference = relationOf(handles).inverse() * productOf(word, g);
			EXPECT_LT(
				difference.distanceFromIdentity(),
				100 * std::numeric_limits<DoubleDouble>::epsilon() * size);
		}
		++canonical;
	}
	EXPECT_GT(canonical, 50); // or the test says little
	EXPECT_GT(refused, 50);
}

TEST(CanonicalGenerators, OfACanonicalWordOfOneHandleAreItsLetters)
{
	Random random(872);
	const Array<ExtendedIsometry> g = randomIsometries(2, 0.3, random);
	const Handles handles =
		canonicalBases({{0, false}, {1, false}, {0, true}, {1, true}}, g).front();
	ASSERT_EQ(handles.size(), 2u);
	// The letters as they stand are one way to read the word; the one that moves 0 least is taken.
	DoubleDouble farthest;
	for (const ExtendedIsometry& h : handles)
		farthest = std::max(farthest, h.displacement());
	EXPECT_LE(farthest, std::max(g[0].displacement(), g[1].displacement()) + 1e-17);
}

/// The word with x P y Q x^-1 R y^-1 S put for P S R Q, for every handle in turn: all corners of its
/// polygon are one point, and the letters of a handle lie far apart.
GroupWord tangledWord(int handles, Random& random)
{
	GroupWord word;
	for (int g = 0; g < 2 * handles; g += 2) {
		std::array<std::size_t, 3> place{};
		for (std::size_t& i : place)
			i = at(random.index(static_cast<int>(word.size()) + 1));
		std::sort(place.begin(), place.end());
		GroupWord next;
		const auto append = [&](std::size_t begin, std::size_t end, GroupLetter letter) {
			for (std::size_t i = begin; i < end; ++i)
				next.push_back(word[i]);
			next.push_back(letter);
		};
		next.push_back({g, false});
		append(0, place[0], {g + 1, false});
		append(place[2], word.size(), {g, true});
		append(place[1], place[2], {g + 1, true});
		next.insert(
			next.end(),
			word.begin() + static_cast<std::ptrdiff_t>(place[0]),
			word.begin() + static_cast<std::ptrdiff_t>(place[1]));
		word = next;
	}
	return word;
}

/// Beyond genus 25, where fewer words are followed.
TEST(CanonicalGenerators, OfManyHandlesHaveTheProductOfTheWordAndAreHeard)
{
	Random random(874);
	const int handles = 40;
	const GroupWord word = tangledWord(handles, random);
	ASSERT_EQ(cornerCount(word), 1);
	const Array<ExtendedIsometry> g = randomIsometries(2 * handles, 1e-3, random);
	Listener ticks;
	const Handles found = heard(ticks, [&] { return canonicalBases(word, g); }).front();
	ASSERT_EQ(found.size(), at(2 * handles));
	EXPECT_LT((relationOf(found).inverse() * productOf(word, g)).distanceFromIdentity(), 1e-12);
	EXPECT_GE(ticks.calls(), handles);
	Listener impatient(1);
	EXPECT_THROW(heard(impatient, [&] { canonicalBases(word, g); }), Cancelled);
}

TEST(CanonicalGenerators, AreNotGivenWhereTheyAreTooLarge)
{
	const GroupWord word = {{0, false}, {1, false}, {0, true}, {1, true}};
	Array<ExtendedIsometry> g(2);
	g[0] = ExtendedIsometry::translation(1.0);
	for (const double length : {kMaxSearchedDistance - 3, kMaxSearchedDistance + 3}) {
		// Across the first axis, so that no way to read the word leads to shorter ones.
		g[1] = ExtendedIsometry::rotation(kPi / 2) * ExtendedIsometry::translation(length) *
			   ExtendedIsometry::rotation(-kPi / 2);
		EXPECT_EQ(canonicalBases(word, g).empty(), length > kMaxSearchedDistance);
	}
	g[1].b = std::numeric_limits<double>::quiet_NaN();
	EXPECT_TRUE(canonicalBases(word, g).empty());
}

/// What g became, in the Lie algebra, from the left.
std::array<double, 3> moveOf(const ExtendedIsometry& before, const ExtendedIsometry& after)
{
	const ExtendedIsometry m = after * before.inverse();
	const double sign = m.a.real() < 0 ? -1.0 : 1.0;
	const auto entry = [&](DoubleDouble x) { return sign * static_cast<double>(x); };
	return {entry(m.a.imag()), entry(m.b.real()), entry(m.b.imag())};
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
		EXPECT_LT(
			static_cast<double>((productOf(word, mended) * tail).distanceFromIdentity()), 1e-15);
		double moved = 0.0, back = 0.0;
		for (const int g : mended.indices())
			for (std::size_t k = 0; k < 3; ++k) {
				moved += std::pow(moveOf(disturbed[g], mended[g])[k], 2);
				back += std::pow(moveOf(disturbed[g], exact[g])[k], 2);
			}
		EXPECT_LE(moved, back * (1.0 + 1e-4));
		EXPECT_GT(moved, 0.0);
	}
	EXPECT_GT(closed, 20); // or the test says little
}

} // namespace
} // namespace ricci::testing
