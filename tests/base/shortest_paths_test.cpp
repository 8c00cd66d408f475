// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/base/graphs.h>
#include <ricci/base/numbers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace ricci::testing {
namespace {

/// Links from one node to another, some of them parallel, some loops.
struct Graph
{
	struct Link
	{
		int from, to;
		double length;
	};
	int nodes;
	Array<Link> links;

	/// Lengths are small integers, so that many paths are equally long and sums are exact.
	Graph(int nodeCount, int linkCount, Random& random) : nodes(nodeCount)
	{
		for (int i = 0; i < linkCount; ++i)
			links.push_back(
				{random.index(nodes), random.index(nodes), static_cast<double>(random.index(6))});
	}

	template<class Visit>
	void neighbours(int node, const Visit& visit) const
	{
		for (const int i : links.indices())
			if (links[i].from == node)
				visit(links[i].to, links[i].length, i);
	}

	/// By relaxing all links until nothing changes.
	Array<double> distances(const std::vector<int>& roots) const
	{
		Array<double> d(nodes, kInfinity);
		for (int root : roots)
			d[root] = 0.0;
		for (int round = 0; round < nodes; ++round)
			for (const Link& link : links)
				d[link.to] = std::min(d[link.to], d[link.from] + link.length);
		return d;
	}
};

std::vector<int> someNodes(int count, int nodes, Random& random)
{
	std::vector<int> chosen;
	for (int i = 0; i < count; ++i)
		chosen.push_back(random.index(nodes));
	return chosen;
}

TEST(ShortestPaths, AreThoseOfBellmanAndFord)
{
	Random random(320);
	int unreached = 0;
	for (int trial = 0; trial < 300; ++trial) {
		const int n = 1 + random.index(25);
		const Graph graph(n, random.index(4 * n), random);
		const std::vector<int> roots = someNodes(1 + random.index(3), n, random);
		const auto paths = shortestPaths<int, int>(
			n, roots, [&](int node, const auto& visit) { graph.neighbours(node, visit); });
		EXPECT_EQ(paths.distances(), graph.distances(roots));
		for (int node = 0; node < n; ++node) {
			const bool isRoot = std::find(roots.begin(), roots.end(), node) != roots.end();
			unreached += paths[node] == kInfinity;
			if (isRoot || paths[node] == kInfinity) {
				EXPECT_EQ(paths.parent(node), -1);
				continue;
			}
			const Graph::Link& link = graph.links[paths.parent(node)];
			EXPECT_EQ(link.to, node);
			EXPECT_EQ(paths[link.from] + link.length, paths[node]);
			int last = node; // the parents lead to a root
			for (int steps = 0; paths.parent(last) >= 0 && steps <= n; ++steps)
				last = graph.links[paths.parent(last)].from;
			EXPECT_EQ(paths[last], 0.0);
			EXPECT_EQ(paths.parent(last), -1);
		}
	}
	EXPECT_GT(unreached, 100);
}

TEST(SearchFront, TakesEqualDistancesByNumber)
{
	SearchFront<int, int> front(6);
	for (int node : {4, 1, 5, 0, 3})
		front.offer(node, node == 5 ? 1.0 : 2.0, 10 + node);
	front.offer(2, 3.0, 1);
	front.offer(2, 2.0, 2); // replaces the longer path
	front.offer(2, 2.0, 3); // and is not replaced by an equal one
	std::vector<int> order;
	for (int node; (node = front.next()) >= 0;)
		order.push_back(node);
	EXPECT_EQ(order, (std::vector<int>{5, 0, 1, 2, 3, 4}));
	EXPECT_EQ(front.parent(2), 2);
	EXPECT_EQ(front.parent(4), 14);
	EXPECT_EQ(front.nearest(), kInfinity);
}

} // namespace
} // namespace ricci::testing
