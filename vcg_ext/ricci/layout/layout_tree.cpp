// SPDX-License-Identifier: GPL-3.0-or-later
#include "layout_tree.h"

#include "../numbers.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace ricci {

std::vector<int> layoutTree(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<char>& isCut,
	int root)
{
	const auto loss = [&](int across) {
		double longest = 0.0;
		for (int h : {across, Triangulation::twin(across)})
			for (int side : t.halfedges(t.face(h)))
				longest = std::max(longest, lengths[at(Triangulation::edge(side))]);
		return longest / lengths[at(Triangulation::edge(across))];
	};
	using Entry = std::pair<double, int>; // accumulated loss, halfedge that leads into a triangle
	std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
	std::vector<char> seen(at(t.faceCount()), 0);
	const auto leave = [&](int f, double lost) {
		seen[at(f)] = 1;
		for (int h : t.halfedges(f)) {
			const int across = Triangulation::twin(h);
			if (!isCut[at(Triangulation::edge(h))] && !t.isOuter(across) &&
				!seen[at(t.face(across))])
				queue.push({lost + loss(across), across});
		}
	};
	std::vector<int> order;
	leave(root, 0.0);
	while (!queue.empty()) {
		const auto [lost, h] = queue.top();
		queue.pop();
		if (seen[at(t.face(h))])
			continue;
		order.push_back(h);
		leave(t.face(h), lost);
	}
	return order;
}

} // namespace ricci
