// SPDX-License-Identifier: GPL-3.0-or-later
#include "min_cut.h"

#include <algorithm>
#include <limits>

namespace ricci {

void MinCut::join(int a, int b, std::int64_t there, std::int64_t back)
{
	addArc(a, b, there);
	addArc(b, a, back);
}

void MinCut::addArc(int from, int to, std::int64_t capacity)
{
	m_arcs.push_back({to, m_firstArc[from], capacity});
	m_firstArc[from] = m_arcs.size() - 1;
}

Array<char> MinCut::run(int source, int sink)
{
	labelDistances(sink);
	m_currentArc = m_firstArc;
	std::vector<int> path; // arcs from the source to node
	int node = source;
	while (m_distance[source] < nodeCount()) {
		if (node == sink) {
			augment(path);
			path.clear();
			node = source;
			continue;
		}
		int& a = m_currentArc[node];
		while (a >= 0 && !leadsOn(node, a))
			a = m_arcs[a].next;
		if (a >= 0) {
			path.push_back(a);
			node = m_arcs[a].to;
			continue;
		}
		const int before = m_distance[node];
		relabel(node);
		if (--m_countAt[before] == 0)
			break; // no path can cross the gap
		if (node != source) {
			node = m_arcs[path.back() ^ 1].to;
			path.pop_back();
		}
	}
	return reachableFrom(source);
}

bool MinCut::leadsOn(int node, int a) const
{
	const Arc& arc = m_arcs[a];
	return arc.capacity > 0 && m_distance[arc.to] + 1 == m_distance[node];
}

/// Numbers of arcs to the sink; nodeCount() where no path leads.
void MinCut::labelDistances(int sink)
{
	m_distance.assign(nodeCount(), nodeCount());
	m_distance[sink] = 0;
	std::vector<int> queue{sink};
	for (std::size_t head = 0; head < queue.size(); ++head)
		for (int a = m_firstArc[queue[head]]; a >= 0; a = m_arcs[a].next) {
			int& distance = m_distance[m_arcs[a].to];
			if (m_arcs[a ^ 1].capacity > 0 && distance == nodeCount()) {
				distance = m_distance[queue[head]] + 1;
				queue.push_back(m_arcs[a].to);
			}
		}
	m_countAt.assign(nodeCount() + 1, 0);
	for (int distance : m_distance)
		++m_countAt[distance];
}

void MinCut::relabel(int node)
{
	int distance = nodeCount();
	for (int a = m_firstArc[node]; a >= 0; a = m_arcs[a].next)
		if (m_arcs[a].capacity > 0)
			distance = std::min(distance, m_distance[m_arcs[a].to] + 1);
	m_distance[node] = distance;
	++m_countAt[distance];
	m_currentArc[node] = m_firstArc[node];
}

/// Sends as much along \p path as it takes.
void MinCut::augment(const std::vector<int>& path)
{
	std::int64_t amount = std::numeric_limits<std::int64_t>::max();
	for (int a : path)
		amount = std::min(amount, m_arcs[a].capacity);
	for (int a : path) {
		m_arcs[a].capacity -= amount;
		m_arcs[a ^ 1].capacity += amount;
	}
}

Array<char> MinCut::reachableFrom(int source) const
{
	Array<char> side(nodeCount(), 0);
	side[source] = 1;
	std::vector<int> queue{source};
	for (std::size_t head = 0; head < queue.size(); ++head)
		for (int a = m_firstArc[queue[head]]; a >= 0; a = m_arcs[a].next)
			if (m_arcs[a].capacity > 0 && !side[m_arcs[a].to]) {
				side[m_arcs[a].to] = 1;
				queue.push_back(m_arcs[a].to);
			}
	return side;
}

} // namespace ricci
