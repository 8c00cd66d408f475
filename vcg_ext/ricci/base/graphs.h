// SPDX-License-Identifier: GPL-3.0-or-later
// Sets that grow together, neighbours by lists, shortest paths.
#ifndef RICCI_GRAPHS_H
#define RICCI_GRAPHS_H

#include "indexed.h"
#include "numbers.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

namespace ricci {

/// Partition of the elements 0 .. n - 1, which starts with a set for each of them. \p I is the type
/// of their indices. The lowest member stands for its set, so that the representatives depend on
/// the partition alone, not on the order of the merges (union-find with path halving,
/// [Tarjan van Leeuwen 1984]).
template<class I>
class DisjointSetsOf
{
public:
	explicit DisjointSetsOf(int n) : m_parent(n)
	{
		for (const I i : m_parent.indices())
			m_parent[i] = i;
	}

	int size() const { return m_parent.size(); }

	/// The lowest member of the set of \p i.
	I find(I i)
	{
		while (m_parent[i] != i)
			i = m_parent[i] = m_parent[m_parent[i]];
		return i;
	}

	/// Unites the sets of \p a and \p b.
	/// \return whether they were two
	bool merge(I a, I b)
	{
		a = find(a), b = find(b);
		m_parent[std::max(a, b)] = std::min(a, b);
		return a != b;
	}

private:
	IndexedArray<I, I> m_parent; // never above its element
};

/// The same on plain numbers.
using DisjointSets = DisjointSetsOf<int>;

/// Partition of the elements 0 .. n - 1 in which any two members of one set have a known parity to
/// each other: 0 where they are alike, 1 where they are opposite, such as the orientations of faces.
class ParitySets
{
public:
	explicit ParitySets(int n) : m_sets(2 * n) {}

	/// The lowest member of the set of \p i.
	int find(int i) { return m_sets.find(2 * i) / 2; }

	/// Parity of \p i to the lowest member of its set.
	char parity(int i) { return static_cast<char>(m_sets.find(2 * i) % 2); }

	/// Unites the sets of \p a and \p b, whose parity to each other shall be \p parity.
	/// \return false, and nothing is done, if it is known to be the other
	bool merge(int a, int b, char parity)
	{
		if (m_sets.find(2 * a) == m_sets.find(2 * b + 1 - parity))
			return false;
		m_sets.merge(2 * a, 2 * b + parity);
		m_sets.merge(2 * a + 1, 2 * b + 1 - parity);
		return true;
	}

private:
	DisjointSets m_sets; // of 2 i: i as it is, and 2 i + 1: its opposite
};

/// Consecutive items of an array.
template<class T>
class ItemRange
{
public:
	ItemRange(T* first, T* last) : m_first(first), m_last(last) {}
	T* begin() const { return m_first; }
	T* end() const { return m_last; }
	int size() const { return static_cast<int>(m_last - m_first); }
	bool empty() const { return m_first == m_last; }
	T& operator[](int i) const { return m_first[i]; }

private:
	T *m_first, *m_last;
};

/// A list of items for each key, all in one array (compressed sparse rows): neighbours by vertex,
/// pieces by face. Filled by a counting sort, so that the items of a key keep the order in which
/// they were given.
template<class Key, class Item>
class Adjacency
{
public:
	Adjacency() = default;

	/// \param forItems forItems(add) calls add(key, item) for every item. It is called twice and must
	/// give the same keys both times.
	template<class ForItems>
	Adjacency(int keyCount, const ForItems& forItems) :
			Adjacency(
				keyCount,
				[&](const auto& count) { forItems([&](Key key, const Item&) { count(key); }); },
				forItems)
	{
	}

	/// For items that take work to make.
	/// \param forKeys forKeys(count) calls count(key) for every item
	/// \param forItems forItems(add) calls add(key, item) for every item, in any order of the keys
	template<class ForKeys, class ForItems>
	Adjacency(int keyCount, const ForKeys& forKeys, const ForItems& forItems) :
			m_first(positionOf(keyCount) + 1, 0)
	{
		forKeys([&](Key key) { ++m_first[positionOf(key) + 1]; });
		std::partial_sum(m_first.begin(), m_first.end(), m_first.begin());
		m_items.resize(positionOf(m_first.back()));
		std::vector<int> next(m_first.begin(), m_first.end() - 1);
		forItems([&](Key key, const Item& item) {
			m_items[positionOf(next[positionOf(key)]++)] = item;
		});
	}

	ItemRange<const Item> operator[](Key key) const
	{
		return {m_items.data() + first(key), m_items.data() + last(key)};
	}
	ItemRange<Item> operator[](Key key)
	{
		return {m_items.data() + first(key), m_items.data() + last(key)};
	}

	int keyCount() const { return static_cast<int>(m_first.size()) - 1; }
	const std::vector<Item>& items() const { return m_items; }

private:
	int first(Key key) const { return m_first[positionOf(key)]; }
	int last(Key key) const { return m_first[positionOf(key) + 1]; }

	std::vector<int> m_first{0}; // [key] in m_items, and behind the last one
	std::vector<Item> m_items;   // by key
};

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

/// Dijkstra's algorithm [Dijkstra 1959], in the hands of its caller: nodes are offered distances,
/// and come back one after another with their final ones. \p Node is the type of the nodes' indices,
/// \p Link that of what leads from one to the next (a halfedge). Entries of the queue that a shorter
/// path has replaced are skipped when their turn comes.
template<class Node, class Link>
class SearchFront
{
public:
	explicit SearchFront(int nodeCount) :
			m_distance(nodeCount, kInfinity), m_parent(nodeCount, Link(-1))
	{
	}

	/// Forgets everything, in time proportional to the number of nodes that were reached.
	void clear()
	{
		for (const Node node : m_reached) {
			m_distance[node] = kInfinity;
			m_parent[node] = Link(-1);
		}
		m_reached.clear();
		m_queue.clear();
	}

	/// A path of this length leads to \p node, by \p link at its end.
	void offer(Node node, double distance, Link link = Link(-1))
	{
		double& known = m_distance[node];
		if (!(distance < known))
			return;
		if (known == kInfinity)
			m_reached.push_back(node);
		known = distance;
		m_parent[node] = link;
		m_queue.push(distance, node);
	}

	/// Distance of the node whose turn is next, infinite if none is left.
	double nearest()
	{
		while (!m_queue.empty() && m_queue.top().first != m_distance[m_queue.top().second])
			m_queue.pop();
		return m_queue.empty() ? kInfinity : m_queue.top().first;
	}

	/// The next node, whose distance is final, or Node(-1) if none nearer than \p bound is left.
	Node next(double bound = kInfinity)
	{
		return nearest() < bound ? m_queue.pop().second : Node(-1);
	}

	/// The distances so far, infinite where no path leads.
	const IndexedArray<Node, double>& distances() const { return m_distance; }
	double operator[](Node node) const { return m_distance[node]; }
	/// The links by which the paths arrive: Link(-1) at roots and where no path leads.
	const IndexedArray<Node, Link>& parents() const { return m_parent; }
	Link parent(Node node) const { return m_parent[node]; }

private:
	IndexedArray<Node, double> m_distance;
	IndexedArray<Node, Link> m_parent;
	std::vector<Node> m_reached;
	DistanceQueue<Node> m_queue;
};

/// All shortest paths from the nearest of \p roots to all nodes.
/// \param forNeighbours forNeighbours(node, visit) calls visit(neighbour, length, link) for each link
/// that leads on from \p node; lengths are not negative
template<class Node, class Link, class ForNeighbours>
SearchFront<Node, Link>
shortestPaths(int nodeCount, const std::vector<Node>& roots, const ForNeighbours& forNeighbours)
{
	SearchFront<Node, Link> front(nodeCount);
	for (const Node root : roots)
		front.offer(root, 0.0);
	while (front.nearest() < kInfinity) {
		const Node node = front.next();
		const double distance = front[node];
		forNeighbours(node, [&](Node neighbour, double length, Link link) {
			front.offer(neighbour, distance + length, link);
		});
	}
	return front;
}

} // namespace ricci

#endif
