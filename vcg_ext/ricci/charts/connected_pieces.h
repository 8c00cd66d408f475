// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONNECTED_PIECES_H
#define RICCI_CONNECTED_PIECES_H

#include "../base/disjoint_sets.h"
#include "../base/indexed.h"

#include <cstddef>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace ricci {

/// The connected pieces of a graph that contain one of \p starts, but for the largest. They are
/// searched from all starts at once, the one with the fewest nodes first, and only until one piece is
/// left: the work depends on the small ones, or on how far the starts of one piece are apart.
/// \param forNeighbours forNeighbours(i, visit) calls visit(j) for all neighbours of a node
/// \param scratch [node] -1, as it is left
template<class ForNeighbours>
std::vector<std::vector<int>> smallerPieces(
	const std::vector<int>& starts, const ForNeighbours& forNeighbours, Array<int>& scratch)
{
	struct Search
	{
		std::vector<int> nodes, queue;
		std::size_t head = 0; // of the queue
	};
	std::vector<Search> searches;
	for (const int start : starts)
		if (scratch[start] < 0) {
			scratch[start] = static_cast<int>(searches.size());
			searches.push_back({{start}, {start}});
		}
	DisjointSets sets(static_cast<int>(searches.size()));
	const auto at = [&](int search) -> Search& { return searches[positionOf(search)]; };
	using Entry = std::pair<std::size_t, int>; // nodes, search
	std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> smallest;
	for (int i = 0; i < sets.size(); ++i)
		smallest.push({1, i});
	std::vector<std::vector<int>> pieces;
	for (int left = sets.size(); left > 1;) {
		const auto [size, first] = smallest.top();
		smallest.pop();
		int own = sets.find(first);
		if (own != first || at(own).nodes.size() != size)
			continue; // the search has a newer entry
		if (at(own).head == at(own).queue.size()) {
			pieces.push_back(at(own).nodes);
			--left;
			continue;
		}
		forNeighbours(at(own).queue[at(own).head++], [&](int i) {
			if (scratch[i] < 0) {
				scratch[i] = own;
				at(own).nodes.push_back(i);
				at(own).queue.push_back(i);
				return;
			}
			const int other = sets.find(scratch[i]);
			if (!sets.merge(own, other))
				return;
			--left;
			if (at(own).nodes.size() < at(other).nodes.size())
				std::swap(at(own), at(other));
			Search &kept = at(own), &gone = at(other);
			kept.nodes.insert(kept.nodes.end(), gone.nodes.begin(), gone.nodes.end());
			for (; gone.head < gone.queue.size(); ++gone.head)
				kept.queue.push_back(gone.queue[gone.head]);
			gone = Search();
			own = sets.find(own);
			if (own == other)
				std::swap(kept, gone);
		});
		smallest.push({at(own).nodes.size(), own});
	}
	for (const Search& search : searches)
		for (const int i : search.nodes)
			scratch[i] = -1;
	return pieces;
}

} // namespace ricci

#endif
