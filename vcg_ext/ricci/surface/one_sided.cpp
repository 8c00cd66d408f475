// SPDX-License-Identifier: GPL-3.0-or-later
#include "one_sided.h"

#include "../math/adjacency.h"
#include "../math/disjoint_sets.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace ricci {

namespace {

/// Vertices of each component from which one-sided loops are looked for.
constexpr std::size_t kRoots = 16;

/// How much longer than the cut along a one-sided loop that along the edges between faces of opposite
/// orders may be.
constexpr double kOrderFactor = 2.0;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// An edge as seen from one of its ends.
struct Link
{
	int vertex = -1; // the other end
	Corner side;     // the lower of its sides
	char parity = 0; // 1 if the orientations kept at the two ends are opposite
	double length = 0.0;
};

/// The graph of the edges, in which a loop is one-sided if the parities of its edges add up to an odd
/// number.
Adjacency<int, Link> orientationGraph(
	const Array<Point3>& positions,
	const Array<Triangle>& triangles,
	const CornerArray<Corner>& glued)
{
	// Round a vertex the corners of its triangles agree on an orientation.
	ParitySets corners(glued.size());
	for (const Corner s : glued.indices()) {
		const Corner t = glued[s];
		if (t < s)
			continue;
		const bool sameWay = triangles[s] == triangles[t];
		corners.merge(s.number(), (sameWay ? t : t.next()).number(), sameWay);
		corners.merge(s.next().number(), (sameWay ? t.next() : t).number(), sameWay);
	}
	return Adjacency<int, Link>(positions.size(), [&](const auto& add) {
		for (const Corner s : glued.indices()) {
			if (glued[s].isValid() && glued[s] < s)
				continue;
			const int a = triangles[s], b = triangles[s.next()];
			const auto parity =
				static_cast<char>(corners.parity(s.number()) ^ corners.parity(s.next().number()));
			const double length = distance(positions[a], positions[b]);
			add(a, Link{b, s, parity, length});
			add(b, Link{a, s, parity, length});
		}
	});
}

/// Shortest one-sided loops through given vertices.
class LoopSearch
{
public:
	explicit LoopSearch(Adjacency<int, Link> graph) :
			m_graph(std::move(graph)), m_places(m_graph.keyCount())
	{
	}

	struct Loop
	{
		double length = kInfinity;
		std::vector<Corner> sides;
	};

	/// Replaces \p best by the shortest one-sided loop through \p root if that is shorter.
	void improve(int root, Loop& best)
	{
		using Entry = std::pair<double, int>;
		std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
		std::vector<int> touched{root};
		m_places[root] = {0.0, {}, 0, false};
		queue.push({0.0, root});
		bool found = false;
		std::pair<int, Link> closing;
		while (!queue.empty()) {
			const auto [length, v] = queue.top();
			queue.pop();
			Place& place = m_places[v];
			if (place.done)
				continue;
			if (2.0 * length >= best.length)
				break;
			place.done = true;
			for (const Link& link : m_graph[v]) {
				Place& next = m_places[link.vertex];
				if (next.done) {
					const double loop = length + link.length + next.length;
					if ((place.parity ^ next.parity ^ link.parity) && loop < best.length) {
						best.length = loop;
						closing = {v, link};
						found = true;
					}
				}
				else if (length + link.length < next.length) {
					if (next.length == kInfinity)
						touched.push_back(link.vertex);
					next.length = length + link.length;
					next.from = {v, link.side, link.parity, link.length};
					next.parity = static_cast<char>(place.parity ^ link.parity);
					queue.push({next.length, link.vertex});
				}
			}
		}
		if (found) {
			best.sides = {closing.second.side};
			for (int v : {closing.first, closing.second.vertex})
				for (; v != root; v = m_places[v].from.vertex)
					best.sides.push_back(m_places[v].from.side);
			// What both ways to the root share is no part of the loop.
			std::sort(best.sides.begin(), best.sides.end());
			std::vector<Corner> once;
			for (const Corner s : best.sides)
				if (!once.empty() && once.back() == s)
					once.pop_back();
				else
					once.push_back(s);
			best.sides = std::move(once);
		}
		for (const int v : touched)
			m_places[v] = Place();
	}

private:
	struct Place
	{
		double length = kInfinity; // from the root
		Link from;
		char parity = 0; // of the way from the root
		bool done = false;
	};

	Adjacency<int, Link> m_graph;
	Array<Place> m_places; // [vertex]
};

/// Glued edges, by one of their sides.
struct EdgeSet
{
	std::vector<Corner> sides;
	double length = 0.0;
};

} // namespace

void unglue(Corner side, CornerArray<Corner>& glued)
{
	Corner& other = glued[side];
	if (other.isValid())
		glued[other] = Corner();
	other = Corner();
}

FacePartition partitionFaces(const Array<Triangle>& triangles, const CornerArray<Corner>& glued)
{
	FacePartition part;
	std::vector<int> queue;
	part.component.assign(triangles.size(), -1);
	part.reversed.assign(triangles.size(), 0);
	for (const int seed : part.component.indices()) {
		if (part.component[seed] >= 0)
			continue;
		bool isOneSided = false;
		std::size_t turned = 0;
		queue.assign(1, seed);
		part.component[seed] = part.componentCount;
		for (std::size_t head = 0; head < queue.size(); ++head) {
			const int f = queue[head];
			for (const Corner s : cornersOf(f)) {
				const Corner t = glued[s];
				if (!t.isValid())
					continue;
				const int g = t.face();
				const bool agrees = triangles[s] != triangles[t];
				const auto wanted = static_cast<char>(part.reversed[f] ^ (agrees ? 0 : 1));
				if (part.component[g] < 0) {
					part.component[g] = part.componentCount;
					part.reversed[g] = wanted;
					turned += wanted != 0;
					queue.push_back(g);
				}
				else if (part.reversed[g] != wanted) {
					isOneSided = true;
					if (s < t)
						part.contradicted.push_back(s);
				}
			}
		}
		if (2 * turned > queue.size())
			for (const int f : queue)
				part.reversed[f] ^= 1;
		part.isOneSided.push_back(isOneSided);
		++part.componentCount;
	}
	return part;
}

void cutOneSided(
	const Array<Point3>& positions,
	const Array<Triangle>& triangles,
	const FacePartition& partition,
	bool everywhere,
	CornerArray<Corner>& glued)
{
	if (everywhere) {
		for (const Corner s : partition.contradicted)
			unglue(s, glued);
		return;
	}
	const auto add = [&](Corner s, EdgeSet& set) {
		set.sides.push_back(s);
		set.length += distance(positions[triangles[s]], positions[triangles[s.next()]]);
	};
	const auto edgeSet = [&](const std::vector<Corner>& loop) { // a loop may run along the border
		EdgeSet set;
		for (const Corner s : loop)
			if (glued[s].isValid())
				add(s, set);
		return set;
	};
	const auto componentOf = [&](Corner s) { return partition.component[s.face()]; };
	Array<EdgeSet> incoherent(partition.componentCount);
	for (const Corner s : glued.indices())
		if (const Corner t = glued[s];
			t > s && partition.isOneSided[componentOf(s)] && triangles[s] == triangles[t])
			add(s, incoherent[componentOf(s)]);
	LoopSearch search(orientationGraph(positions, triangles, glued));
	// The contradicted edges of a component follow each other, and every one-sided loop crosses them.
	const std::vector<Corner>& sides = partition.contradicted.values();
	for (std::size_t first = 0, last; first < sides.size(); first = last) {
		const int component = componentOf(sides[first]);
		for (last = first; last < sides.size() && componentOf(sides[last]) == component;)
			++last;
		LoopSearch::Loop loop;
		const std::size_t count = std::min(kRoots, last - first);
		for (std::size_t i = 0; i < count; ++i)
			search.improve(triangles[sides[first + i * (last - first) / count]], loop);
		const EdgeSet shortest = edgeSet(loop.sides);
		const EdgeSet& given = incoherent[component];
		for (const Corner s :
			 given.length <= kOrderFactor * shortest.length ? given.sides : shortest.sides)
			unglue(s, glued);
	}
}

} // namespace ricci
