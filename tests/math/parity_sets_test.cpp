// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/math/disjoint_sets.h>

#include <gtest/gtest.h>

#include <vector>

namespace ricci::testing {
namespace {

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
