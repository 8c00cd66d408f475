// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MIN_CUT_H
#define RICCI_MIN_CUT_H

#include "../base/indexed.h"

#include <cstdint>
#include <vector>

namespace ricci {

/// Minimum cut between two nodes of a graph with integer capacities: shortest augmenting paths along
/// distance labels, which are corrected where a search fails [Ahuja Orlin 1991]. Integers make
/// the result exact.
class MinCut
{
public:
	/// A graph of the nodes 0 .. nodeCount - 1 without edges.
	explicit MinCut(int nodeCount) : m_firstArc(nodeCount, -1) {}

	/// Adds an edge with the capacities \p there from a to b and \p back from b to a, at least 0.
	void join(int a, int b, std::int64_t there, std::int64_t back);

	/// A cut of minimum capacity between \p source and \p sink, two different nodes. Call it once:
	/// the capacities are used up.
	/// \return [node] 1 on the side of \p source; of all minimum cuts the one with the fewest nodes
	/// on that side
	Array<char> run(int source, int sink);

private:
	struct Arc
	{
		int to, next; ///< next: of the arcs that leave the same node, or -1
		std::int64_t capacity;
	};

	int nodeCount() const { return m_firstArc.size(); }
	void addArc(int from, int to, std::int64_t capacity);
	bool leadsOn(int node, int a) const;
	void labelDistances(int sink);
	void relabel(int node);
	void augment(const std::vector<int>& path);
	Array<char> reachableFrom(int source) const;

	Array<Arc> m_arcs;       ///< arc a ^ 1 runs the other way
	Array<int> m_firstArc;   ///< [node]
	Array<int> m_currentArc; ///< [node] those before it do not lead on
	Array<int> m_distance;   ///< [node] arcs to the sink, at least
	Array<int> m_countAt;    ///< [distance] nodes
};

} // namespace ricci

#endif
