// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/charts/connected_pieces.h>
#include <ricci/math/disjoint_sets.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace ricci::testing {
namespace {

using Pieces = std::vector<std::vector<int>>;

/// All pieces with one of the starts are returned but one, which is none of the smaller.
TEST(ConnectedPieces, OfRandomGraphs)
{
	Random random(1210);
	int several = 0;
	for (int trial = 0; trial < 2000; ++trial) {
		const int n = 1 + random.index(40);
		std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(n));
		DisjointSets sets(n);
		for (int i = random.index(n + 1); i > 0; --i) {
			const int a = random.index(n), b = random.index(n);
			neighbours[static_cast<std::size_t>(a)].push_back(b);
			neighbours[static_cast<std::size_t>(b)].push_back(a);
			sets.merge(a, b);
		}
		std::vector<int> starts;
		for (int i = random.index(n + 1); i > 0; --i)
			starts.push_back(random.index(n));
		Array<int> scratch(n, -1);
		Pieces found = smallerPieces(
			starts,
			[&](int i, const auto& visit) {
				for (const int j : neighbours[static_cast<std::size_t>(i)])
					visit(j);
			},
			scratch);
		EXPECT_EQ(std::count(scratch.begin(), scratch.end(), -1), n);

		std::set<int> roots;
		for (const int start : starts)
			roots.insert(sets.find(start));
		std::map<int, std::vector<int>> wanted;
		for (int i = 0; i < n; ++i)
			if (roots.count(sets.find(i)))
				wanted[sets.find(i)].push_back(i);
		std::size_t largestFound = 0;
		for (std::vector<int>& piece : found) {
			std::sort(piece.begin(), piece.end());
			const auto known = wanted.find(sets.find(piece.front()));
			ASSERT_NE(known, wanted.end());
			EXPECT_EQ(piece, known->second);
			largestFound = std::max(largestFound, piece.size());
			wanted.erase(known);
		}
		ASSERT_EQ(wanted.size(), starts.empty() ? 0u : 1u);
		if (!starts.empty()) {
			EXPECT_GE(wanted.begin()->second.size(), largestFound);
		}
		several += found.size() > 1;
	}
	EXPECT_GT(several, 300);
}

/// Two lines of very different lengths.
TEST(ConnectedPieces, AreFoundAtTheCostOfTheSmallOnes)
{
	const int shortEnd = 20, n = 100000;
	int asked = 0;
	Array<int> scratch(n, -1);
	const Pieces found = smallerPieces(
		{n / 2, 0, n / 2 + 4, shortEnd - 1},
		[&](int i, const auto& visit) {
			++asked;
			if (i > 0 && i != shortEnd)
				visit(i - 1);
			if (i + 1 < n && i + 1 != shortEnd)
				visit(i + 1);
		},
		scratch);
	ASSERT_EQ(found.size(), 1u);
	EXPECT_EQ(found[0].size(), static_cast<std::size_t>(shortEnd));
	EXPECT_LT(asked, 4 * shortEnd);
}

} // namespace
} // namespace ricci::testing
