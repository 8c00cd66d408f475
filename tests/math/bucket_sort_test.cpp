// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/math/adjacency.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

TEST(BucketSort, IsASort)
{
	Random random(350);
	using Item = std::pair<int, int>;
	for (int trial = 0; trial < 200; ++trial) {
		const int keys = trial % 2 == 0 ? 1 + random.index(30) : 1000000000; // few or far apart
		const int first = random.index(1000) - 500;
		std::vector<Item> items;
		for (int i = random.index(100); i > 0; --i)
			items.push_back({first + random.index(keys), random.index(10)});
		std::vector<Item> sorted = items;
		std::sort(sorted.begin(), sorted.end());
		bucketSort(
			items,
			[](const Item& item) { return item.first; },
			[](const Item& a, const Item& b) { return a.second < b.second; });
		EXPECT_EQ(items, sorted);
	}
}

} // namespace
} // namespace ricci::testing
