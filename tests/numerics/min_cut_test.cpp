// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/listener.h"
#include "support/random.h"

#include <ricci/numerics/min_cut.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

/// An edge with the capacities there, from a to b, and back.
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

/// The edges of each node.
MinCut::ForEdges graphOf(int nodeCount, const std::vector<Link>& links)
{
	std::vector<std::vector<Link>> at(static_cast<std::size_t>(nodeCount));
	for (const Link& link : links) {
		at[static_cast<std::size_t>(link.a)].push_back(link);
		at[static_cast<std::size_t>(link.b)].push_back({link.b, link.a, link.back, link.there});
	}
	return [at](int node, const MinCut::AddEdge& add) {
		for (const Link& link : at[static_cast<std::size_t>(node)])
			add(link.b, link.there, link.back);
	};
}

/// [node] 1 on the side of the sources.
std::vector<char> sidesOf(int nodeCount, const MinCut::Side& found)
{
	std::vector<char> isOfSources(static_cast<std::size_t>(nodeCount), !found.isOfSources);
	for (const int node : found.nodes)
		isOfSources[static_cast<std::size_t>(node)] = found.isOfSources;
	return isOfSources;
}

TEST(MinCut, IsTheSmallestOfAllCutsWithTheFewestNodes)
{
	Random random(340);
	int connected = 0, ambiguous = 0, ofSinks = 0;
	for (int trial = 0; trial < 2000; ++trial) {
		const int n = 2 + random.index(9);
		const bool directed = random.coin();
		std::vector<Link> links;
		for (int i = random.index(3 * n); i > 0; --i) {
			const std::int64_t there = random.index(4);
			links.push_back(
				{random.index(n), random.index(n), there, directed ? random.index(4) : there});
		}
		// One or more of each.
		std::vector<int> sources, sinks;
		const int source = random.index(n), sink = (source + 1 + random.index(n - 1)) % n;
		for (int node = 0; node < n; ++node) {
			const int kind = random.index(8);
			if (node == source || (node != sink && kind == 0))
				sources.push_back(node);
			else if (node == sink || kind == 1)
				sinks.push_back(node);
		}
		const MinCut::Side found = MinCut(n).run(sources, sinks, graphOf(n, links));
		const std::vector<char> side = sidesOf(n, found);
		const auto isSource = [&](int node) { return side[static_cast<std::size_t>(node)] != 0; };
		for (const int node : sources)
			EXPECT_TRUE(isSource(node));
		for (const int node : sinks)
			EXPECT_FALSE(isSource(node));

		std::int64_t least = std::numeric_limits<std::int64_t>::max();
		int common = 0, count = 0; // sets of nodes as bits, on the side that was found
		for (int set = 0; set < 1 << n; ++set) {
			const auto isOnSide = [&](int node) { return (set >> node & 1) != 0; };
			if (!std::all_of(sources.begin(), sources.end(), isOnSide) ||
				std::any_of(sinks.begin(), sinks.end(), isOnSide))
				continue;
			const std::int64_t capacity = capacityOf(links, isOnSide);
			const int nodes = found.isOfSources ? set : ~set;
			if (capacity < least) {
				least = capacity;
				common = nodes;
				count = 0;
			}
			if (capacity == least) {
				common &= nodes; // the sides of minimum cuts are closed under intersection
				++count;
			}
		}
		EXPECT_EQ(capacityOf(links, isSource), least);
		EXPECT_EQ(found.capacity, least);
		for (int node = 0; node < n; ++node)
			EXPECT_EQ(isSource(node) == found.isOfSources, (common >> node & 1) != 0);
		connected += least > 0;
		ambiguous += least > 0 && count > 1;
		ofSinks += least > 0 && !found.isOfSources;
	}
	EXPECT_GT(connected, 100);
	EXPECT_GT(ambiguous, 50);
	EXPECT_GT(ofSinks, 50);
}

/// One object serves many cuts of large graphs: grids with random capacities, some of them 0. The capacity of the cut
/// is the flow that it was found with, and no cut has less.
TEST(MinCut, IsAsLargeAsTheFlow)
{
	Random random(341);
	const int width = 25, height = 20, n = width * height;
	MinCut cut(n);
	for (int trial = 0; trial < 200; ++trial) {
		std::vector<Link> links;
		const int most = trial % 2 == 0 ? 3 : 1000;
		for (int node = 0; node < n; ++node)
			for (const int other :
				 {(node + 1) % width != 0 ? node + 1 : n, node + width, random.index(9 * n)})
				if (other < n) {
					const std::int64_t there = random.index(most);
					links.push_back({node, other, there, there});
				}
		const int source = random.index(n), sink = (source + 1 + random.index(n - 1)) % n;
		const MinCut::Side found = cut.run({source}, {sink}, graphOf(n, links));
		const std::vector<char> side = sidesOf(n, found);
		EXPECT_EQ(
			capacityOf(links, [&](int node) { return side[static_cast<std::size_t>(node)] != 0; }),
			found.capacity);
	}
}

/// Two blocks of a grid that are joined by one cheap column of edges; \p asked counts the nodes.
MinCut::ForEdges gridWithAGap(int width, int height, int gap, int& asked)
{
	return [=, &asked](int node, const MinCut::AddEdge& add) {
		++asked;
		const int x = node % width, y = node / width;
		const auto join = [&](int other, std::int64_t capacity) { add(other, capacity, capacity); };
		if (x + 1 < width)
			join(node + 1, x == gap ? 2 : 5);
		if (x > 0)
			join(node - 1, x - 1 == gap ? 2 : 5);
		if (y + 1 < height)
			join(node + width, 5);
		if (y > 0)
			join(node - width, 5);
	};
}

/// What lies far from the smaller side is not looked at.
TEST(MinCut, IsLocal)
{
	const int width = 2000, height = 50, gap = 9;
	for (const bool isLeftSource : {false, true}) {
		std::vector<int> left, right;
		for (int y = 0; y < height; ++y) {
			left.push_back(y * width);
			right.push_back(y * width + 40);
		}
		int asked = 0;
		const MinCut::Side found = MinCut(width * height)
									   .run(
										   isLeftSource ? left : right,
										   isLeftSource ? right : left,
										   gridWithAGap(width, height, gap, asked));
		EXPECT_EQ(found.isOfSources, isLeftSource);
		EXPECT_EQ(found.nodes.size(), static_cast<std::size_t>((gap + 1) * height));
		EXPECT_LT(asked, 100 * height);
	}
}

TEST(MinCut, CanBeEnded)
{
	const int width = 500, height = 500;
	int asked = 0;
	Listener impatient(1);
	const Task task(impatient);
	EXPECT_THROW(
		MinCut(width * height)
			.run({0}, {width * height - 1}, gridWithAGap(width, height, -2, asked)),
		Cancelled);
}

} // namespace
} // namespace ricci::testing
