// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/math/min_cut.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

struct Link
{
	int a, b;
	std::int64_t there, back;
};

/// What leads from the side \p isOnSide(node) to the other.
template<class IsOnSide>
std::int64_t capacityOf(const std::vector<Link>& links, const IsOnSide& isOnSide)
{
	std::int64_t sum = 0;
	for (const Link& link : links) {
		if (isOnSide(link.a) && !isOnSide(link.b))
			sum += link.there;
		if (isOnSide(link.b) && !isOnSide(link.a))
			sum += link.back;
	}
	return sum;
}

TEST(MinCut, LooksBackAlongTheFlow)
{
	// The short way 0 1 2 5 takes all of 2 5. Then 1 can be reached only by 0 3 4 2 and against the
	// flow, and belongs to the side of 0: else 0 1 would be cut for nothing.
	MinCut cut(6);
	cut.join(0, 1, 1, 0);
	cut.join(1, 2, 1, 0);
	cut.join(2, 5, 1, 0);
	cut.join(0, 3, 5, 0);
	cut.join(3, 4, 5, 0);
	cut.join(4, 2, 5, 0);
	EXPECT_EQ(cut.run(0, 5), (Array<char>{1, 1, 1, 1, 1, 0}));
}

TEST(MinCut, IsTheSmallestOfAllCutsWithTheFewestNodes)
{
	Random random(340);
	int connected = 0, ambiguous = 0;
	for (int trial = 0; trial < 1000; ++trial) {
		const int n = 2 + random.index(9);
		const bool directed = random.coin();
		std::vector<Link> links;
		for (int i = random.index(3 * n); i > 0; --i) {
			const std::int64_t there = random.index(4);
			links.push_back(
				{random.index(n), random.index(n), there, directed ? random.index(4) : there});
		}
		const int source = random.index(n), sink = (source + 1 + random.index(n - 1)) % n;
		MinCut cut(n);
		for (const Link& link : links)
			cut.join(link.a, link.b, link.there, link.back);
		const Array<char> side = cut.run(source, sink);
		ASSERT_EQ(side.size(), n);
		EXPECT_TRUE(side[source]);
		EXPECT_FALSE(side[sink]);

		std::int64_t least = std::numeric_limits<std::int64_t>::max();
		int common = 0, count = 0; // sets of nodes as bits
		for (int set = 0; set < 1 << n; ++set) {
			const auto isOnSide = [&](int node) { return (set >> node & 1) != 0; };
			if (!isOnSide(source) || isOnSide(sink))
				continue;
			const std::int64_t capacity = capacityOf(links, isOnSide);
			if (capacity < least) {
				least = capacity;
				common = set;
				count = 0;
			}
			if (capacity == least) {
				common &= set; // the sides of minimum cuts are closed under intersection
				++count;
			}
		}
		EXPECT_EQ(capacityOf(links, [&](int node) { return side[node] != 0; }), least);
		for (int node = 0; node < n; ++node)
			EXPECT_EQ(side[node] != 0, (common >> node & 1) != 0);
		connected += least > 0;
		ambiguous += least > 0 && count > 1;
	}
	EXPECT_GT(connected, 100);
	EXPECT_GT(ambiguous, 50);
}

TEST(MinCut, OfAGridWithAGap)
{
	// Two blocks of a grid that are joined by one cheap column of edges.
	const int width = 20, height = 30, gap = 13;
	MinCut cut(width * height + 2);
	const int source = width * height, sink = source + 1;
	for (int y = 0; y < height; ++y)
		for (int x = 0; x < width; ++x) {
			const int node = y * width + x;
			if (x + 1 < width) {
				const std::int64_t capacity = x == gap ? 2 : 5;
				cut.join(node, node + 1, capacity, capacity);
			}
			if (y + 1 < height)
				cut.join(node, node + width, 5, 5);
		}
	for (int y = 0; y < height; ++y) {
		cut.join(source, y * width, 100, 100);
		cut.join(y * width + width - 1, sink, 100, 100);
	}
	const Array<char> side = cut.run(source, sink);
	for (int y = 0; y < height; ++y)
		for (int x = 0; x < width; ++x)
			EXPECT_EQ(side[y * width + x] != 0, x <= gap);
}

} // namespace
} // namespace ricci::testing
