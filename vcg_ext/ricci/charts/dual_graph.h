// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DUAL_GRAPH_H
#define RICCI_DUAL_GRAPH_H

#include "../base/graphs.h"
#include "../base/indexed.h"
#include "../cut/cut_graph.h"
#include "../layout/flat_mesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace ricci {

/// The connected pieces of a graph that contain one of \p starts, except for the largest. They are
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

/// The dual graph of charts that fall into parts: triangles with joined sides are neighbours. An edge
/// weighs what it costs to cut it: its length, times the mean price of its two triangles, and for a diagonal of a polygon
/// times kDiagonalFactor.
class DualGraph
{
public:
	explicit DualGraph(const FlatMesh& chart) : part(chart.size(), 0), m_chart(chart)
	{
		for (const auto& lengths : chart.lengths)
			m_longest = std::max({m_longest, lengths[0], lengths[1], lengths[2]});
	}

	Corner joined(Corner side) const { return m_chart.joined(side); }

	/// joined(), if it is in the same part; else none.
	Corner neighbour(Corner side) const
	{
		const Corner other = joined(side);
		return other.isValid() && part[other.face()] == part[side.face()] ? other : Corner();
	}

	/// In units of 1e-9 of the longest edge, at least 1.
	/// \pre the side is joined
	std::int64_t weight(Corner side) const
	{
		if (!(m_longest > 0.0))
			return 1;
		double cost = m_chart.lengths[side] / m_longest;
		if (!price.empty())
			cost *= 0.5 * (price[side.face()] + price[joined(side).face()]);
		if (!m_chart.isDiagonal.empty() && m_chart.isDiagonal[side])
			cost *= kDiagonalFactor;
		return static_cast<std::int64_t>(cost * 1e9) + 1;
	}

	/// The connected pieces of all parts: the triangles of each, in increasing order.
	std::vector<std::vector<int>> connectedPieces() const
	{
		return connectedPieces(part.indices());
	}

	/// Those that have some of these triangles.
	template<class Triangles>
	std::vector<std::vector<int>> connectedPieces(const Triangles& triangles) const
	{
		Array<int> number(part.size(), -1); // of its piece
		std::vector<std::vector<int>> pieces;
		std::vector<int> next;
		for (const int first : triangles) {
			if (number[first] >= 0)
				continue;
			const int piece = number[first] = static_cast<int>(pieces.size());
			pieces.emplace_back();
			for (next.push_back(first); !next.empty();) {
				const int f = next.back();
				next.pop_back();
				for (const Corner side : cornersOf(f))
					if (const Corner other = neighbour(side);
						other.isValid() && number[other.face()] < 0) {
						number[other.face()] = piece;
						next.push_back(other.face());
					}
			}
		}
		for (const int f : number.indices())
			if (number[f] >= 0)
				pieces[positionOf(number[f])].push_back(f);
		return pieces;
	}

	Array<int> part;     ///< [triangle] number
	Array<double> price; ///< [triangle] of a unit of length; empty: 1 everywhere

private:
	const FlatMesh& m_chart;
	double m_longest = 0.0; // edge, on the surface
};

} // namespace ricci

#endif
