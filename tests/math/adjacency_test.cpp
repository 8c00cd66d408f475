// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/math/adjacency.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

struct Key : Index<Key>
{
	using Index::Index;
};

TEST(Adjacency, ListsTheItemsOfEachKeyInTheirOrder)
{
	Random random(330);
	for (int trial = 0; trial < 100; ++trial) {
		const int keys = 1 + random.index(20);
		std::vector<std::pair<Key, int>> given;
		for (int i = random.index(60); i > 0; --i)
			given.push_back({Key(random.index(keys)), random.index(1000)});
		const Adjacency<Key, int> lists(keys, [&](const auto& add) {
			for (const auto& [key, item] : given)
				add(key, item);
		});
		ASSERT_EQ(lists.keyCount(), keys);
		for (const Key key : IndexRange<Key>(keys)) {
			std::vector<int> expected;
			for (const auto& [k, item] : given)
				if (k == key)
					expected.push_back(item);
			EXPECT_EQ(std::vector<int>(lists[key].begin(), lists[key].end()), expected);
			EXPECT_EQ(lists[key].size(), static_cast<int>(expected.size()));
			EXPECT_EQ(lists[key].empty(), expected.empty());
			for (int i = 0; i < lists[key].size(); ++i)
				EXPECT_EQ(lists[key][i], expected[positionOf(i)]);
		}
		EXPECT_EQ(lists.items().size(), given.size());
	}
}

TEST(Adjacency, WithoutKeysHasNone)
{
	EXPECT_EQ((Adjacency<int, int>().keyCount()), 0);
	EXPECT_EQ((Adjacency<int, int>(0, [](const auto&) {}).keyCount()), 0);
}

} // namespace
} // namespace ricci::testing
