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
		int first = 0;
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
			EXPECT_EQ(lists.first(key), first);
			first += lists[key].size();
			EXPECT_EQ(lists.last(key), first);
		}
		EXPECT_EQ(lists.items().size(), given.size());
	}
}

TEST(Adjacency, CountsKeysApartFromTheItems)
{
	// The items come in another order than their keys were counted.
	const std::vector<int> keys{2, 0, 2, 1};
	Adjacency<int, double> lists(
		4,
		[&](const auto& count) {
			for (int key : keys)
				count(key);
		},
		[&](const auto& add) {
			for (std::size_t i = keys.size(); i-- > 0;)
				add(keys[i], static_cast<double>(i));
		});
	EXPECT_EQ(lists.items(), (std::vector<double>{1.0, 3.0, 2.0, 0.0}));
	EXPECT_TRUE(lists[3].empty());
	for (double& item : lists[2])
		item += 10.0;
	EXPECT_EQ(lists.items(), (std::vector<double>{1.0, 3.0, 12.0, 10.0}));
}

TEST(Adjacency, WithoutKeysHasNone)
{
	EXPECT_EQ((Adjacency<int, int>().keyCount()), 0);
	EXPECT_EQ((Adjacency<int, int>(0, [](const auto&) {}).keyCount()), 0);
}

} // namespace
} // namespace ricci::testing
