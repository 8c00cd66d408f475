// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MIN_CUT_H
#define RICCI_MIN_CUT_H

#include "../base/indexed.h"
#include "../base/task.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
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
		std::int64_t capacity; ///< of the cut
	};

	/// A cut of minimum capacity between \p sources and \p sinks, which have no node in common.
	/// \return the side that was found: of all minimum cuts the one with the fewest nodes on it
	Side
	run(const std::vector<int>& sources, const std::vector<int>& sinks, const ForEdges& forEdges)
	{
		clear();
		for (const Tree tree : {kSources, kSinks})
			for (const int number : tree == kSources ? sources : sinks) {
				const int node = localOf(number);
				m_nodes[node].tree = tree;
				m_nodes[node].isRoot = true;
				activate(node);
			}
		std::int64_t work[2] = {0, 0};
		while (!m_active[0].empty() && !m_active[1].empty()) {
			checkpointNowAndThen(static_cast<std::size_t>(work[kSources] + work[kSinks]));
			const Tree tree = work[kSources] <= work[kSinks] ? kSources : kSinks;
			++work[tree];
			const int node = m_active[tree].front();
			m_active[tree].pop_front();
			m_nodes[node].isActive[tree] = false;
			if (m_nodes[node].tree == tree)
				growFrom(node, forEdges);
		}
		const Tree found = m_active[kSources].empty() ? kSources : kSinks;
		Side side{found == kSources, {}, m_flow};
		for (const Node& node : m_nodes)
			if (node.tree == found)
				side.nodes.push_back(node.number);
		return side;
	}

private:
	enum Tree : char { kSources, kSinks, kNone };

	struct Node
	{
		int number; ///< in the graph
		int firstArc = -1;
		int parentArc = -1; ///< none for roots, orphans and free nodes
		int parent = -1;    ///< where it leads: paths are long, and walked without arcs
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
	void clear()
	{
		for (const Node& node : m_nodes)
			m_local[node.number] = -1;
		m_nodes.clear();
		m_arcs.clear();
		m_active[kSources].clear();
		m_active[kSinks].clear();
		m_orphans.clear();
		m_mark = 0;
		m_flow = 0;
	}

	int localOf(int number)
	{
		int& local = m_local[number];
		if (local < 0) {
			local = m_nodes.size();
			m_nodes.push_back({number});
		}
		return local;
	}

	void open(int node, const ForEdges& forEdges)
	{
		if (m_nodes[node].isOpen)
			return;
		m_nodes[node].isOpen = true;
		forEdges(m_nodes[node].number, [&](int number, std::int64_t there, std::int64_t back) {
			const int to = localOf(number);
			if (m_nodes[to].isOpen) // and has made the arcs; or the edge is a loop
				return;
			m_arcs.push_back({to, m_nodes[node].firstArc, there});
			m_nodes[node].firstArc = m_arcs.size() - 1;
			m_arcs.push_back({node, m_nodes[to].firstArc, back});
			m_nodes[to].firstArc = m_arcs.size() - 1;
		});
	}

	void activate(int node)
	{
		const Tree tree = m_nodes[node].tree;
		if (m_nodes[node].isActive[tree])
			return;
		m_nodes[node].isActive[tree] = true;
		m_active[tree].push_back(node);
	}

	/// Adds the neighbours of \p node to its tree, and sends flow where it meets the other one.
	void growFrom(int node, const ForEdges& forEdges)
	{
		open(node, forEdges);
		const Tree tree = m_nodes[node].tree;
		for (int a = m_nodes[node].firstArc; a >= 0; a = m_arcs[a].next)
			while (towards(a, tree) > 0) {
				Node &own = m_nodes[node], &other = m_nodes[m_arcs[a].to];
				if (own.tree != tree)
					return;
				if (other.tree == tree) {
					if (!other.isRoot && other.mark <= own.mark && other.distance > own.distance) {
						// A shorter way.
						other.parentArc = a ^ 1;
						other.parent = node;
						other.mark = own.mark;
						other.distance = own.distance + 1;
					}
					break;
				}
				if (other.tree == kNone) {
					other.tree = tree;
					other.parentArc = a ^ 1;
					other.parent = node;
					other.mark = own.mark;
					other.distance = own.distance + 1;
					activate(m_arcs[a].to);
					break;
				}
				augment(tree == kSources ? a : a ^ 1);
				adopt(forEdges);
			}
	}

	/// What can be sent along \p arc away from the root of its node, in direction of the flow.
	std::int64_t towards(int arc, Tree tree) const
	{
		return m_arcs[tree == kSources ? arc : arc ^ 1].capacity;
	}

	/// Sends as much as it takes from the source to the sink, along \p arc between the trees.
	void augment(int arc)
	{
		std::int64_t amount = m_arcs[arc].capacity;
		const int ends[2] = {m_arcs[arc ^ 1].to, m_arcs[arc].to};
		for (const Tree tree : {kSources, kSinks})
			for (int node = ends[tree]; m_nodes[node].parentArc >= 0; node = m_nodes[node].parent)
				amount = std::min(amount, towards(m_nodes[node].parentArc ^ 1, tree));
		m_flow += amount;
		m_arcs[arc].capacity -= amount;
		m_arcs[arc ^ 1].capacity += amount;
		pushBack(ends[kSources], kSources, amount);
		pushBack(ends[kSinks], kSinks, amount);
	}

	/// Takes \p amount from the path between \p node and its root.
	void pushBack(int node, Tree tree, std::int64_t amount)
	{
		while (m_nodes[node].parentArc >= 0) {
			const int up = m_nodes[node].parentArc, next = m_nodes[node].parent;
			const int along = tree == kSources ? up ^ 1 : up;
			m_arcs[along].capacity -= amount;
			m_arcs[along ^ 1].capacity += amount;
			if (m_arcs[along].capacity == 0) {
				m_nodes[node].parentArc = -1;
				m_orphans.push_back(node);
			}
			node = next;
		}
	}

	/// Finds new parents for the nodes that have lost theirs; those without are free.
	void adopt(const ForEdges& forEdges)
	{
		++m_mark;
		while (!m_orphans.empty()) {
			const int node = m_orphans.front();
			m_orphans.pop_front();
			const Tree tree = m_nodes[node].tree;
			open(node, forEdges);
			int parent = -1, nearest = std::numeric_limits<int>::max();
			for (int a = m_nodes[node].firstArc; a >= 0; a = m_arcs[a].next)
				if (m_nodes[m_arcs[a].to].tree == tree && towards(a ^ 1, tree) > 0)
					if (const int d = distanceOf(m_arcs[a].to); d >= 0 && d < nearest) {
						nearest = d;
						parent = a;
					}
			m_nodes[node].parentArc = parent;
			if (parent >= 0) {
				m_nodes[node].parent = m_arcs[parent].to;
				m_nodes[node].mark = m_mark;
				m_nodes[node].distance = nearest + 1;
				continue;
			}
			for (int a = m_nodes[node].firstArc; a >= 0; a = m_arcs[a].next) {
				const int to = m_arcs[a].to;
				if (m_nodes[to].tree != tree)
					continue;
				if (towards(a ^ 1, tree) > 0)
					activate(to);
				if (m_nodes[to].parentArc == (a ^ 1)) {
					m_nodes[to].parentArc = -1;
					m_orphans.push_back(to);
				}
			}
			m_nodes[node].tree = kNone;
		}
	}

	/// Edges between \p node and its root; -1 where an orphan is on the way. What is found is marked.
	int distanceOf(int node)
	{
		int steps = 0, i = node;
		for (; m_nodes[i].mark != m_mark; i = m_nodes[i].parent, ++steps) {
			if (m_nodes[i].isRoot) {
				m_nodes[i].mark = m_mark;
				m_nodes[i].distance = 0;
				break;
			}
			if (m_nodes[i].parentArc < 0)
				return -1;
		}
		const int distance = m_nodes[i].distance + steps;
		int d = distance;
		for (i = node; m_nodes[i].mark != m_mark; i = m_nodes[i].parent) {
			m_nodes[i].mark = m_mark;
			m_nodes[i].distance = d--;
		}
		return distance;
	}

	Array<int> m_local; // [number] node, or -1
	Array<Node> m_nodes;
	Array<Arc> m_arcs;           // arc a ^ 1 runs the other way
	std::deque<int> m_active[2]; // of each tree
	std::deque<int> m_orphans;   // nodes that have lost their parents
	int m_mark = 0;              // paths that were used up
	std::int64_t m_flow = 0;
};

} // namespace ricci

#endif
