// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/math/disjoint_sets.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace ricci::testing {
namespace {

TEST(DisjointSets, StartApart)
{
	DisjointSets sets(5);
	EXPECT_EQ(sets.size(), 5);
	for (int i = 0; i < 5; ++i)
		EXPECT_EQ(sets.find(i), i);
}

TEST(DisjointSets, AreRepresentedByTheirLowestMembers)
{
	// Against a list of labels in which every merge renames a whole set.
	Random random(310);
	for (int trial = 0; trial < 200; ++trial) {
		const int n = 1 + random.index(60);
		DisjointSets sets(n);
		std::vector<int> label;
		for (int i = 0; i < n; ++i)
			label.push_back(i);
		for (int merges = random.index(2 * n); merges > 0; --merges) {
			const int a = random.index(n), b = random.index(n);
			const int la = label[positionOf(a)], lb = label[positionOf(b)];
			EXPECT_EQ(sets.merge(a, b), la != lb);
			for (int& l : label)
				if (l == la || l == lb)
					l = std::min(la, lb);
			const int i = random.index(n); // shortens paths between the merges
			EXPECT_EQ(sets.find(i), label[positionOf(i)]);
		}
		for (int i = 0; i < n; ++i)
			EXPECT_EQ(sets.find(i), label[positionOf(i)]);
	}
}

struct Item : Index<Item>
{
	using Index::Index;
};

TEST(DisjointSets, OfTypedIndices)
{
	DisjointSetsOf<Item> sets(4);
	EXPECT_TRUE(sets.merge(Item(3), Item(1)));
	EXPECT_FALSE(sets.merge(Item(1), Item(3)));
	EXPECT_EQ(sets.find(Item(3)), Item(1));
	EXPECT_EQ(sets.find(Item(2)), Item(2));
}

/// Elements of two hidden colours: relations that are true are taken and give back the colours,
/// relations that are false are refused.
TEST(ParitySets, KnowTheParityOfAllPairsThatWereRelated)
{
	Random random(5);
	constexpr int kCount = 200;
	std::vector<char> colour;
	for (int i = 0; i < kCount; ++i)
		colour.push_back(static_cast<char>(random.index(2)));
	ParitySets sets(kCount);
	std::vector<std::vector<char>> related(kCount, std::vector<char>(kCount, 0));
	int refused = 0;
	for (int step = 0; step < 2000; ++step) {
		const int a = random.index(kCount), b = random.index(kCount);
		const auto parity = static_cast<char>(colour[std::size_t(a)] ^ colour[std::size_t(b)]);
		const bool wereOne = sets.find(a) == sets.find(b);
		if (wereOne) {
			EXPECT_EQ(sets.parity(a) ^ sets.parity(b), parity);
			EXPECT_FALSE(sets.merge(a, b, static_cast<char>(1 - parity)));
			++refused;
		}
		EXPECT_TRUE(sets.merge(a, b, parity));
		EXPECT_EQ(sets.find(a), sets.find(b));
		EXPECT_LE(sets.find(a), a);
		EXPECT_EQ(sets.parity(sets.find(a)), 0);
	}
	EXPECT_GT(refused, 500);
}

} // namespace
} // namespace ricci::testing
