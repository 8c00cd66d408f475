// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TEST_MAX_FLOW_H
#define RICCI_TEST_MAX_FLOW_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <vector>

namespace ricci::testing {

/// An edge with the capacities there, from a to b, and back.
struct Link
{
	int a, b;
	std::int64_t there, back;
};

/// Capacity of a minimum cut, as the flow of augmenting paths.
inline std::int64_t flowBetween(int nodeCount, const std::vector<Link>& links, int source, int sink)
{
	const auto n = static_cast<std::size_t>(nodeCount);
	std::vector<std::vector<std::size_t>> at(n);
	std::vector<std::int64_t> left; // [2 link + direction]
	for (const Link& link : links) {
		at[static_cast<std::size_t>(link.a)].push_back(left.size());
		left.push_back(link.there);
		at[static_cast<std::size_t>(link.b)].push_back(left.size());
		left.push_back(link.back);
	}
	const auto endOf = [&](std::size_t arc) {
		return static_cast<std::size_t>(arc % 2 == 0 ? links[arc / 2].b : links[arc / 2].a);
	};
	for (std::int64_t flow = 0;;) {
		std::vector<std::int64_t> by(n, -1);
		std::queue<std::size_t> queue;
		queue.push(static_cast<std::size_t>(source));
		by[static_cast<std::size_t>(source)] = 0;
		for (; !queue.empty(); queue.pop())
			for (const std::size_t arc : at[queue.front()])
				if (left[arc] > 0 && by[endOf(arc)] < 0) {
					by[endOf(arc)] = static_cast<std::int64_t>(arc);
					queue.push(endOf(arc));
				}
		if (by[static_cast<std::size_t>(sink)] < 0)
			return flow;
		std::vector<std::size_t> path;
		for (int node = sink; node != source;) {
			path.push_back(static_cast<std::size_t>(by[static_cast<std::size_t>(node)]));
			node = static_cast<int>(endOf(path.back() ^ 1));
		}
		std::int64_t amount = left[path[0]];
		for (const std::size_t arc : path)
			amount = std::min(amount, left[arc]);
		for (const std::size_t arc : path) {
			left[arc] -= amount;
			left[arc ^ 1] += amount;
		}
		flow += amount;
	}
}

} // namespace ricci::testing

#endif
