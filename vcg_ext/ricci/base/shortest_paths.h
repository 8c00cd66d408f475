// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SHORTEST_PATHS_H
#define RICCI_SHORTEST_PATHS_H

#include "indexed.h"

#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace ricci {

/// Items with distances; the nearest comes first, and of equals the one with the lowest index, so
/// that results do not depend on the order of the calls. An item may be in the queue several times.
template<class Item>
class DistanceQueue
{
public:
	using Entry = std::pair<double, Item>;

	bool empty() const { return m_queue.empty(); }
	const Entry& top() const { return m_queue.top(); }
	void push(double distance, Item item) { m_queue.push({distance, item}); }
	Entry pop()
	{
		const Entry entry = m_queue.top();
		m_queue.pop();
		return entry;
	}
	void clear() { m_queue = Queue(); }

private:
	using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>>;
	Queue m_queue;
};

/// The distance of what is not reached.
constexpr double kFar = std::numeric_limits<double>::infinity();

/// Distances from some roots, and the way there.
template<class Node, class Link>
struct ShortestPaths
{
	IndexedArray<Node, double> distance; ///< infinite where no path leads
	IndexedArray<Node, Link> parent;     ///< the link by which the path arrives; Link(-1) at the
										 ///< roots and where no path leads
};

/// Dijkstra's algorithm [Dijkstra 1959], in the hands of its caller: nodes are offered distances,
/// and come back one after another with their final ones. \p Node is the type of the nodes' indices,
/// \p Link that of what leads from one to the next (a halfedge). Entries of the queue that a shorter
/// path has replaced are skipped when their turn comes.
template<class Node, class Link>
class SearchFront
{
public:
	explicit SearchFront(int nodeCount)
	{
		m_paths.distance.assign(nodeCount, kFar);
		m_paths.parent.assign(nodeCount, Link(-1));
	}

	/// Forgets everything, in time proportional to the number of nodes that were reached.
	void clear()
	{
		for (const Node node : m_reached) {
			m_paths.distance[node] = kFar;
			m_paths.parent[node] = Link(-1);
		}
		m_reached.clear();
		m_queue.clear();
	}

	/// A path of this length leads to \p node, by \p link at its end.
	void offer(Node node, double distance, Link link = Link(-1))
	{
		double& known = m_paths.distance[node];
		if (!(distance < known))
			return;
		if (known == kFar)
			m_reached.push_back(node);
		known = distance;
		m_paths.parent[node] = link;
		m_queue.push(distance, node);
	}

	/// Distance of the node whose turn is next, infinite if none is left.
	double nearest()
	{
		while (!m_queue.empty() && m_queue.top().first != m_paths.distance[m_queue.top().second])
			m_queue.pop();
		return m_queue.empty() ? kFar : m_queue.top().first;
	}

	/// The next node, whose distance is final, or Node(-1) if none nearer than \p bound is left.
	Node next(double bound = kFar) { return nearest() < bound ? m_queue.pop().second : Node(-1); }

	double operator[](Node node) const { return m_paths.distance[node]; }
	Link parent(Node node) const { return m_paths.parent[node]; }

	/// Moves the result out of the front, which then is of no further use.
	ShortestPaths<Node, Link> release() { return std::move(m_paths); }

private:
	ShortestPaths<Node, Link> m_paths;
	std::vector<Node> m_reached;
	DistanceQueue<Node> m_queue;
};

/// Shortest paths from the nearest of \p roots to all nodes.
/// \param forNeighbours forNeighbours(node, visit) calls visit(neighbour, length, link) for each link
/// that leads on from \p node; lengths are not negative
template<class Node, class Link, class ForNeighbours>
ShortestPaths<Node, Link>
shortestPaths(int nodeCount, const std::vector<Node>& roots, const ForNeighbours& forNeighbours)
{
	SearchFront<Node, Link> front(nodeCount);
	for (const Node root : roots)
		front.offer(root, 0.0);
	while (front.nearest() < std::numeric_limits<double>::infinity()) {
		const Node node = front.next();
		const double distance = front[node];
		forNeighbours(node, [&](Node neighbour, double length, Link link) {
			front.offer(neighbour, distance + length, link);
		});
	}
	return front.release();
}

} // namespace ricci

#endif
