// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MIN_CUT_H
#define RICCI_MIN_CUT_H

#include "../base/indexed.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

namespace ricci {

/// Minimum cuts between sets of nodes of a graph with integer capacities: two trees of paths with
/// capacity left grow towards each other, one from each set, and are mended where a path is used up
/// [Boykov Kolmogorov 2004]. The cut is found when one of them cannot grow any more, whatever lies
/// behind the other: the work depends on the smaller side of the cut and on how far the trees have to
/// go for the flow, not on the graph, which is asked for the edges of a node when a tree reaches it.
/// Integers make the result exact.
class MinCut
{
public:
	/// Adds an edge to another node with the capacities \p there and, from that node, \p back.
	using AddEdge = std::function<void(int to, std::int64_t there, std::int64_t back)>;
	/// Adds all edges of a node. Those between two nodes are the same for both.
	using ForEdges = std::function<void(int node, const AddEdge& add)>;

	/// For graphs with the nodes 0 .. nodeCount - 1.
	explicit MinCut(int nodeCount) : m_local(nodeCount, -1) {}

	/// One side of a cut.
	struct Side
	{
		bool isOfSources;
		std::vector<int> nodes;
	};

	/// A cut of minimum capacity between \p sources and \p sinks, which have no node in common.
	/// \return the side that was found: of all minimum cuts the one with the fewest nodes on it
	Side
	run(const std::vector<int>& sources, const std::vector<int>& sinks, const ForEdges& forEdges);

private:
	enum Tree : char { kSources, kSinks, kNone };

	struct Node
	{
		int number; ///< in the graph
		int firstArc = -1;
		int parentArc = -1; ///< none for roots, orphans and free nodes
		int distance = 0;   ///< edges to the root, at the time of the mark
		int mark = 0;
		Tree tree = kNone;
		bool isRoot = false;
		bool isOpen = false; ///< all its arcs are there
		bool isActive[2]{};  ///< in the queue of a tree, which may grow from here
	};
	struct Arc
	{
		int to, next; ///< next: of the arcs that leave the same node, or -1
		std::int64_t capacity;
	};

	void clear();
	int localOf(int number);
	void open(int node, const ForEdges& forEdges);
	void activate(int node);
	void growFrom(int node, const ForEdges& forEdges);
	std::int64_t towards(int arc, Tree tree) const;
	void augment(int arc);
	void pushBack(int node, Tree tree, std::int64_t amount);
	void adopt(const ForEdges& forEdges);
	int distanceOf(int node);

	Array<int> m_local; // [number] node, or -1
	Array<Node> m_nodes;
	Array<Arc> m_arcs;           // arc a ^ 1 runs the other way
	std::deque<int> m_active[2]; // of each tree
	std::deque<int> m_orphans;   // nodes that have lost their parents
	int m_mark = 0;              // paths that were used up
};

} // namespace ricci

#endif
