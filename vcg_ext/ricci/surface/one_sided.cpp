// SPDX-License-Identifier: GPL-3.0-or-later
#include "one_sided.h"

#include "../math/adjacency.h"
#include "../math/parity_sets.h"

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

int startOf(const std::vector<Triangle>& triangles, int side)
{
	return triangles[positionOf(side / 3)][positionOf(side % 3)];
}

int endOf(const std::vector<Triangle>& triangles, int side)
{
	return triangles[positionOf(side / 3)][positionOf((side + 1) % 3)];
}

/// The corner of its triangle at which a side ends.
int cornerAtEnd(int side)
{
	return side - side % 3 + (side + 1) % 3;
}

/// An edge as seen from one of its ends.
struct Link
{
	int vertex;  // the other end
	int side;    // the lower of its sides
	char parity; // 1 if the orientations kept at the two ends are opposite
	double length;
};

/// The graph of the edges, in which a loop is one-sided if the parities of its edges add up to an odd
/// number.
Adjacency<int, Link> orientationGraph(
	const std::vector<Point3>& positions,
	const std::vector<Triangle>& triangles,
	const std::vector<int>& glued)
{
	// Round a vertex the corners of its triangles agree on an orientation.
	ParitySets corners(static_cast<int>(glued.size()));
	for (int s = 0; s < static_cast<int>(glued.size()); ++s) {
		const int t = glued[positionOf(s)];
		if (t < s)
			continue;
		const bool sameWay = startOf(triangles, s) == startOf(triangles, t);
		corners.merge(s, sameWay ? t : cornerAtEnd(t), sameWay);
		corners.merge(cornerAtEnd(s), sameWay ? cornerAtEnd(t) : t, sameWay);
	}
	return Adjacency<int, Link>(static_cast<int>(positions.size()), [&](const auto& add) {
		for (int s = 0; s < static_cast<int>(glued.size()); ++s) {
			if (glued[positionOf(s)] >= 0 && glued[positionOf(s)] < s)
				continue;
			const int a = startOf(triangles, s), b = endOf(triangles, s);
			const auto parity =
				static_cast<char>(corners.parity(s) ^ corners.parity(cornerAtEnd(s)));
			const double length = distance(positions[positionOf(a)], positions[positionOf(b)]);
			add(a, Link{b, s, parity, length});
			add(b, Link{a, s, parity, length});
		}
	});
}

/// Shortest one-sided loops through given vertices.
class LoopSearch
{
public:
	LoopSearch(Adjacency<int, Link> graph, std::size_t vertexCount) :
			m_graph(std::move(graph)), m_places(vertexCount)
	{
	}

	struct Loop
	{
		double length = kInfinity;
		std::vector<int> sides;
	};

	/// Replaces \p best by the shortest one-sided loop through \p root if that is shorter.
	void improve(int root, Loop& best)
	{
		using Entry = std::pair<double, int>;
		std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
		std::vector<int> touched{root};
		m_places[positionOf(root)] = {0.0, {-1, -1, 0, 0.0}, 0, false};
		queue.push({0.0, root});
		bool found = false;
		std::pair<int, Link> closing;
		while (!queue.empty()) {
			const auto [length, v] = queue.top();
			queue.pop();
			Place& place = m_places[positionOf(v)];
			if (place.done)
				continue;
			if (2.0 * length >= best.length)
				break;
			place.done = true;
			for (const Link& link : m_graph[v]) {
				Place& next = m_places[positionOf(link.vertex)];
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
				for (; v != root; v = m_places[positionOf(v)].from.vertex)
					best.sides.push_back(m_places[positionOf(v)].from.side);
			// What both ways to the root share is no part of the loop.
			std::sort(best.sides.begin(), best.sides.end());
			std::vector<int> once;
			for (const int s : best.sides)
				if (!once.empty() && once.back() == s)
					once.pop_back();
				else
					once.push_back(s);
			best.sides = std::move(once);
		}
		for (const int v : touched)
			m_places[positionOf(v)] = Place();
	}

private:
	struct Place
	{
		double length = kInfinity; // from the root
		Link from{-1, -1, 0, 0.0};
		char parity = 0; // of the way from the root
		bool done = false;
	};

	Adjacency<int, Link> m_graph;
	std::vector<Place> m_places;
};

/// Glued edges, by one of their sides.
struct EdgeSet
{
	std::vector<int> sides;
	double length = 0.0;
};

void unglue(int side, std::vector<int>& glued)
{
	int& other = glued[positionOf(side)];
	if (other >= 0)
		glued[positionOf(other)] = -1;
	other = -1;
}

} // namespace

FacePartition partitionFaces(const std::vector<Triangle>& triangles, const std::vector<int>& glued)
{
	FacePartition part;
	std::vector<Face> queue;
	part.component.assign(triangles.size(), -1);
	part.reversed.assign(triangles.size(), 0);
	for (const Face seed : part.component.indices()) {
		if (part.component[seed] >= 0)
			continue;
		bool isOneSided = false;
		std::size_t turned = 0;
		queue.assign(1, seed);
		part.component[seed] = part.componentCount;
		for (std::size_t head = 0; head < queue.size(); ++head) {
			const Face f = queue[head];
			for (int s = 3 * f.number(); s < 3 * f.number() + 3; ++s) {
				const int t = glued[positionOf(s)];
				if (t < 0)
					continue;
				const Face g(t / 3);
				const bool agrees = startOf(triangles, s) != startOf(triangles, t);
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
			for (const Face f : queue)
				part.reversed[f] ^= 1;
		part.isOneSided.push_back(isOneSided);
		++part.componentCount;
	}
	return part;
}

void cutOneSided(
	const std::vector<Point3>& positions,
	const std::vector<Triangle>& triangles,
	const FacePartition& partition,
	bool everywhere,
	std::vector<int>& glued)
{
	if (everywhere) {
		for (const int s : partition.contradicted)
			unglue(s, glued);
		return;
	}
	const auto add = [&](int s, EdgeSet& set) {
		set.sides.push_back(s);
		set.length += distance(
			positions[positionOf(startOf(triangles, s))],
			positions[positionOf(endOf(triangles, s))]);
	};
	const auto edgeSet = [&](const std::vector<int>& loop) { // a loop may run along the border
		EdgeSet set;
		for (const int s : loop)
			if (glued[positionOf(s)] >= 0)
				add(s, set);
		return set;
	};
	std::vector<EdgeSet> incoherent(positionOf(partition.componentCount));
	for (int s = 0; s < static_cast<int>(glued.size()); ++s) {
		const int c = partition.component[Face(s / 3)], t = glued[positionOf(s)];
		if (t > s && partition.isOneSided[positionOf(c)] &&
			startOf(triangles, s) == startOf(triangles, t))
			add(s, incoherent[positionOf(c)]);
	}
	LoopSearch search(orientationGraph(positions, triangles, glued), positions.size());
	// The contradicted edges of a component follow each other, and every one-sided loop crosses them.
	const std::vector<int>& sides = partition.contradicted;
	const auto componentOf = [&](std::size_t i) { return partition.component[Face(sides[i] / 3)]; };
	for (std::size_t first = 0, last; first < sides.size(); first = last) {
		for (last = first; last < sides.size() && componentOf(last) == componentOf(first);)
			++last;
		LoopSearch::Loop loop;
		const std::size_t count = std::min(kRoots, last - first);
		for (std::size_t i = 0; i < count; ++i)
			search.improve(startOf(triangles, sides[first + i * (last - first) / count]), loop);
		const EdgeSet shortest = edgeSet(loop.sides);
		const EdgeSet& given = incoherent[positionOf(componentOf(first))];
		for (const int s :
			 given.length <= kOrderFactor * shortest.length ? given.sides : shortest.sides)
			unglue(s, glued);
	}
}

} // namespace ricci
