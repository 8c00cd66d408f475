// SPDX-License-Identifier: GPL-3.0-or-later
#include "border_flow.h"

#include "../base/task.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace ricci {

namespace {

/// Vertices that are looked at between two checkpoints.
constexpr int kNodesBetweenTicks = 1 << 14;

/// Vertices for each terminal that a path looks at once the spare ones are used up; what is farther is left to
/// be found. Where a chart has many holes, whose borders cost nothing, all of it can be nearer than the end of
/// each path.
constexpr std::size_t kNodesOfTriangle = 64;

} // namespace

BorderFlow::BorderFlow(const DualGraph& graph) :
		m_graph(graph), m_nodeAt(3 * graph.part.size(), -1),
		m_spareNodes(positionOf(m_nodeAt.size()))
{
}

void BorderFlow::find(
	const std::vector<int>& sources, const std::vector<int>& sinks, const Array<Terminal>& terminal)
{
	for (const Corner corner : m_known)
		m_nodeAt[corner] = -1;
	m_known.clear();
	m_nodes.clear();
	m_paths.clear();
	m_mostNodes = kNodesOfTriangle * (sources.size() + sinks.size());
	if (findFrom(sources, 1, terminal) == 0)
		findFrom(sinks, -1, terminal);
}

/// \return the number of paths between the ends of the triangles' rim
int BorderFlow::findFrom(
	const std::vector<int>& triangles, std::int64_t sign, const Array<Terminal>& terminal)
{
	int count = 0;
	for (const int i : triangles)
		for (const Corner side : cornersOf(i)) {
			const Corner other = m_graph.neighbour(side);
			if (!other.isValid() || terminal[other.face()] == terminal[i] ||
				besideOnRim(side, false, terminal).isValid())
				continue;
			Corner last = side;
			for (Corner s = side; s.isValid(); s = besideOnRim(s, true, terminal))
				last = s;
			m_paths.push_back({sign, 0});
			measure(side, last.next(), terminal);
			++count;
		}
	return count;
}

/// The side of the rim behind \p side, or before it; none at the border of the part.
Corner BorderFlow::besideOnRim(Corner side, bool isNext, const Array<Terminal>& terminal) const
{
	for (Corner s = m_graph.neighbour(side);;) {
		s = m_graph.neighbour(isNext ? s.previous() : s.next());
		if (!s.isValid() || terminal[s.face()] == terminal[side.face()])
			return s;
	}
}

/// Finds the distances from a corner of those vertices that are nearer than corner \p to, or of the nearest
/// ones, for the last path: cut off at any distance it is a flow. It has no length where it meets another
/// one. A path that follows the border costs nothing.
void BorderFlow::measure(Corner from, Corner to, const Array<Terminal>& terminal)
{
	const int path = m_paths.size() - 1, target = nodeAt(to);
	using Entry = std::pair<std::int64_t, int>; // distance, node
	std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
	bool isFree = true;
	std::vector<int> reached;
	const auto reach = [&](Corner corner, std::int64_t distance) {
		const int number = nodeAt(corner);
		Node& node = m_nodes[number];
		if (node.path >= 0 && node.path != path)
			isFree = false;
		else if (node.path < 0 || distance < node.distance) {
			if (node.path < 0)
				reached.push_back(number);
			node.path = path;
			node.distance = distance;
			queue.push({distance, number});
		}
	};
	const auto follow = [&](Corner side, Corner corner, std::int64_t distance) {
		const Corner other = m_graph.neighbour(side);
		const Terminal own = terminal[side.face()];
		if (!other.isValid() && own == kNoTerminal)
			reach(corner, distance);
		else if (other.isValid() && (own == kNoTerminal || own != terminal[other.face()]))
			reach(corner, distance + m_graph.weight(side));
	};
	int untilTick = kNodesBetweenTicks;
	std::int64_t length = 0;
	for (reach(from, 0); isFree && !queue.empty();) {
		const auto [distance, number] = queue.top();
		queue.pop();
		length = distance;
		if (number == target || reached.size() > m_mostNodes + m_spareNodes)
			break;
		if (distance > m_nodes[number].distance)
			continue;
		if (--untilTick == 0) {
			untilTick = kNodesBetweenTicks;
			checkpoint();
		}
		forCorners(m_nodes[number].corner, [&, distance = distance](Corner corner) {
			follow(corner, corner.next(), distance);
			follow(corner.previous(), corner.previous(), distance);
		});
	}
	m_paths[path].length = length;
	if (reached.size() > m_mostNodes)
		m_spareNodes -= std::min(m_spareNodes, reached.size() - m_mostNodes);
	if (!isFree)
		for (const int number : reached)
			m_nodes[number].path = -1;
}

/// Calls visit(corner) for the corners of the part at one vertex.
template<class Visit>
void BorderFlow::forCorners(Corner corner, const Visit& visit) const
{
	visit(corner);
	for (Corner s = m_graph.neighbour(corner); s.isValid(); s = m_graph.neighbour(s)) {
		s = s.next();
		if (s == corner)
			return;
		visit(s);
	}
	for (Corner s = corner; (s = m_graph.neighbour(s.previous())).isValid();)
		visit(s);
}

int BorderFlow::nodeAt(Corner corner)
{
	if (m_nodeAt[corner] < 0) {
		forCorners(corner, [&](Corner c) {
			m_nodeAt[c] = m_nodes.size();
			m_known.push_back(c);
		});
		m_nodes.push_back({corner});
	}
	return m_nodeAt[corner];
}

/// What the function has at a corner above its values far from the paths.
std::int64_t BorderFlow::excessAt(Corner corner) const
{
	const int number = m_nodeAt[corner];
	if (number < 0 || m_nodes[number].path < 0)
		return 0;
	const Path& path = m_paths[m_nodes[number].path];
	return path.sign * (std::min(m_nodes[number].distance, path.length) - path.length);
}

} // namespace ricci
