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

} // namespace
} // namespace ricci::testing
