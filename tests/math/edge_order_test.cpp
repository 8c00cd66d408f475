// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/math/edge_order.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

namespace ricci::testing {
namespace {

struct NumberedSide
{
	int low, high, number;
};

TEST(EdgeOrder, IsThatOfAStableSort)
{
	Random random(331);
	for (int trial = 0; trial < 200; ++trial) {
		const int vertices = 2 + random.index(30);
		std::vector<NumberedSide> sides;
		for (int i = random.index(80); i > 0; --i) {
			const int a = random.index(vertices), b = random.index(vertices);
			if (a != b)
				sides.push_back({std::min(a, b), std::max(a, b), i});
		}
		std::vector<NumberedSide> expected = sides;
		std::stable_sort(expected.begin(), expected.end(), [](const auto& a, const auto& b) {
			return std::tie(a.low, a.high) < std::tie(b.low, b.high);
		});
		sortByEdge(sides);
		ASSERT_EQ(sides.size(), expected.size());
		for (std::size_t i = 0; i < sides.size(); ++i)
			EXPECT_EQ(sides[i].number, expected[i].number);
	}
}

} // namespace
} // namespace ricci::testing
