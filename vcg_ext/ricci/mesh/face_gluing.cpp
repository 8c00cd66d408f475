// SPDX-License-Identifier: GPL-3.0-or-later
#include "face_gluing.h"

#include "../base/numbers.h"
#include "../base/tolerances.h"
#include "sides.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace ricci {

namespace {

/// Edges with more sides than this pair each only with the kNearest nearest to its continuation.
constexpr std::size_t kAllPairs = 64, kNearest = 8;

/// Two sides that could be glued: the fold between them in radians, how many sheets of equal triangles they are apart,
/// and themselves. The least are the best.
using Candidate = std::tuple<double, int, Corner, Corner>;

/// Of length 1; as it is where it has no length.
Point3 normalized(const Point3& p)
{
	const double size = length(p);
	return size > 0.0 ? p / size : p;
}

/// 0 where one page goes straight on in the other, pi where both lie on each other.
double foldBetween(const Page& p, const Page& q)
{
	return std::abs(kPi - std::abs(p.angle - q.angle)); // the same for the gap round the other way
}

/// [triangle] how many before it have the same vertices.
Array<int> layersOf(const Array<Triangle>& triangles, int& duplicates)
{
	std::vector<std::pair<Triangle, int>> faces; // vertices in order, and number
	faces.reserve(positionOf(triangles.size()));
	for (const int f : triangles.indices()) {
		faces.emplace_back(triangles[f], f);
		std::sort(faces.back().first.begin(), faces.back().first.end());
	}
	std::sort(faces.begin(), faces.end());
	Array<int> layer(triangles.size(), 0);
	for (std::size_t i = 1; i < faces.size(); ++i)
		if (faces[i].first == faces[i - 1].first) {
			layer[faces[i].second] = layer[faces[i - 1].second] + 1;
			++duplicates;
		}
	return layer;
}

/// Pairs the sides of edges that have more than two, given what is glued already.
class Pairing
{
public:
	Pairing(const Array<Triangle>& triangles, FaceGluing& gluing) :
			m_triangles(triangles), m_layer(layersOf(triangles, gluing.duplicateFaces)),
			m_gluing(gluing), m_orientation(triangles.size()), m_reversed(triangles.size(), 0)
	{
	}

	/// The orientation that most of each patch of glued triangles has is taken for the patch's.
	void orientPatches(const Sides& sides)
	{
		sides.forEdges([&](const auto& edge) {
			if (m_gluing.glued[edge[0]].isValid())
				m_orientation.merge(edge[0].face(), edge[1].face(), parityOf(edge[0], edge[1]));
		});
		Array<int> surplus(m_triangles.size(), 0); // of faces like the patch's first
		for (const int f : m_triangles.indices())
			surplus[m_orientation.find(f)] += m_orientation.parity(f) ? -1 : 1;
		for (const int f : m_triangles.indices()) {
			const bool firstIsRare = surplus[m_orientation.find(f)] < 0;
			m_reversed[f] = static_cast<char>(m_orientation.parity(f) ^ (firstIsRare ? 1 : 0));
		}
	}

	void offer(const std::vector<Page>& pages)
	{
		if (pages.size() <= kAllPairs) {
			for (std::size_t i = 0; i < pages.size(); ++i)
				for (std::size_t j = i + 1; j < pages.size(); ++j)
					offer(pages[i], pages[j]);
			return;
		}
		std::vector<Page> sorted = pages;
		std::stable_sort(sorted.begin(), sorted.end(), [](const Page& p, const Page& q) {
			return p.angle < q.angle;
		});
		for (const Page& p : sorted) {
			const double onward = p.angle > 0.0 ? p.angle - kPi : p.angle + kPi;
			const auto at = std::lower_bound(
				sorted.begin(), sorted.end(), onward, [](const Page& q, double angle) {
					return q.angle < angle;
				});
			const std::size_t n = sorted.size(),
							  start =
								  static_cast<std::size_t>(at - sorted.begin()) + n - kNearest / 2;
			for (std::size_t i = 0; i < kNearest; ++i)
				offer(p, sorted[(start + i) % n]);
		}
	}

	/// The best pairs first.
	void glue()
	{
		std::sort(m_candidates.begin(), m_candidates.end());
		for (const auto& [fold, layers, a, b] : m_candidates) {
			Corner &ofA = m_gluing.glued[a], &ofB = m_gluing.glued[b];
			if (ofA.isValid() || ofB.isValid() ||
				!m_orientation.merge(a.face(), b.face(), parityOf(a, b)))
				continue;
			ofA = b;
			ofB = a;
		}
	}

private:
	/// 1 where the triangles of two sides of an edge have opposite orders.
	char parityOf(Corner a, Corner b) const { return m_triangles[a] == m_triangles[b]; }

	void offer(const Page& p, const Page& q)
	{
		const auto [a, b] = std::minmax({p.side, q.side});
		const int f = a.face(), g = b.face();
		if (f == g || m_triangles[a.previous()] == m_triangles[b.previous()])
			return;
		if ((parityOf(a, b) ^ m_reversed[f] ^ m_reversed[g]) != 0)
			return; // of a sheet that went on there a part would have to be turned
		m_candidates.emplace_back(foldBetween(p, q), std::abs(m_layer[f] - m_layer[g]), a, b);
	}

	const Array<Triangle>& m_triangles;
	Array<int> m_layer;
	FaceGluing& m_gluing;
	ParitySets m_orientation; // of triangles
	Array<char> m_reversed;
	std::vector<Candidate> m_candidates;
};

/// Vertices of each component from which one-sided loops are looked for.
constexpr std::size_t kRoots = 16;

/// How much longer than the cut along a one-sided loop that along the edges between faces of opposite
/// orders may be.
constexpr double kOrderFactor = 2.0;

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
/// \param length length(side)
template<class Length>
Adjacency<int, Link> orientationGraph(
	int vertexCount,
	const Array<Triangle>& triangles,
	const CornerArray<Corner>& glued,
	const Length& length)
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
	return Adjacency<int, Link>(vertexCount, [&](const auto& add) {
		for (const Corner s : glued.indices()) {
			if (glued[s].isValid() && glued[s] < s)
				continue;
			const int a = triangles[s], b = triangles[s.next()];
			const auto parity =
				static_cast<char>(corners.parity(s.number()) ^ corners.parity(s.next().number()));
			add(a, Link{b, s, parity, length(s)});
			add(b, Link{a, s, parity, length(s)});
		}
	});
}

/// A vertex on the way from a root.
struct Place
{
	double length = kInfinity; // from the root
	Link from;
	char parity = 0; // of the way from the root
	bool done = false;
};

/// Replaces \p best by the shortest one-sided loop through \p root if that is shorter.
/// \param places [vertex] scratch, Place() between calls
void shortenLoop(const Adjacency<int, Link>& graph, int root, Array<Place>& places, EdgeSet& best)
{
	DistanceQueue<int> queue;
	std::vector<int> touched{root};
	places[root] = {0.0, {}, 0, false};
	queue.push(0.0, root);
	bool found = false;
	std::pair<int, Link> closing;
	while (!queue.empty()) {
		const auto [length, v] = queue.pop();
		Place& place = places[v];
		if (place.done)
			continue;
		if (2.0 * length >= best.length)
			break;
		place.done = true;
		for (const Link& link : graph[v]) {
			Place& next = places[link.vertex];
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
				queue.push(next.length, link.vertex);
			}
		}
	}
	if (found) {
		best.sides = {closing.second.side};
		for (int v : {closing.first, closing.second.vertex})
			for (; v != root; v = places[v].from.vertex)
				best.sides.push_back(places[v].from.side);
		// What both ways to the root share is not a part of the loop.
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
		places[v] = Place();
}

} // namespace

std::vector<Page> pagesOf(
	const std::vector<Point3>& positions,
	const Array<Triangle>& triangles,
	ItemRange<const Corner> sides)
{
	const auto [a, b] = std::minmax({triangles[sides[0]], triangles[sides[0].next()]});
	const Point3 &low = positions[positionOf(a)], &high = positions[positionOf(b)];
	const Point3 axis = normalized(high - low);
	std::vector<Page> pages;
	Point3 first{0, 0, 0};
	for (const Corner side : sides) {
		const Point3 arm = normalized(positions[positionOf(triangles[side.previous()])] - low);
		const Point3 away = arm - dot(arm, axis) * axis;
		if (dot(first, first) == 0.0)
			first = away;
		pages.push_back(
			{side,
			 std::atan2(dot(cross(first, away), axis), dot(first, away)),
			 dot(away, away) < kThinTriangle * kThinTriangle});
	}
	return pages;
}

FaceGluing glueFaces(const std::vector<Point3>& positions, const Array<Triangle>& triangles)
{
	FaceGluing gluing;
	gluing.glued.assign(3 * triangles.size(), Corner());
	const Sides sides(triangles.values());
	sides.forEdges([&](const auto& edge) {
		if (edge.size() == 1) {
			gluing.alone.push_back(edge[0]);
			return;
		}
		const Corner a = edge[0], b = edge[1];
		if (edge.size() == 2 && triangles[a.previous()] != triangles[b.previous()]) {
			gluing.glued[a] = b;
			gluing.glued[b] = a;
		}
		else
			++gluing.cutEdges;
	});
	if (gluing.cutEdges == 0)
		return gluing;
	Pairing pairing(triangles, gluing);
	pairing.orientPatches(sides);
	sides.forEdges([&](const auto& edge) {
		if (edge.size() > 2)
			pairing.offer(pagesOf(positions, triangles, edge));
	});
	pairing.glue();
	return gluing;
}

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
		part.component[seed] = part.componentCount();
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
					part.component[g] = part.componentCount();
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
	}
	return part;
}

void cutOneSided(
	const std::vector<Point3>& positions,
	const Array<Triangle>& triangles,
	const FacePartition& partition,
	OneSidedCut cut,
	CornerArray<Corner>& glued)
{
	if (cut == OneSidedCut::Everywhere) {
		for (const Corner s : partition.contradicted)
			unglue(s, glued);
		return;
	}
	const auto inSpace = [&](Corner s) {
		return distance(
			positions[positionOf(triangles[s])], positions[positionOf(triangles[s.next()])]);
	};
	Array<double> price(static_cast<int>(positions.size()), 0.0); // half that of passing a vertex
	if (cut == OneSidedCut::ClearOfBoundary) {
		double all = 0.0;
		for (const Corner s : glued.indices())
			all += inSpace(s);
		for (const Corner s : glued.indices())
			if (!glued[s].isValid())
				price[triangles[s]] = price[triangles[s.next()]] = all;
	}
	const auto length = [&](Corner s) {
		return inSpace(s) + price[triangles[s]] + price[triangles[s.next()]];
	};
	const auto add = [&](Corner s, EdgeSet& set) {
		set.sides.push_back(s);
		set.length += length(s);
	};
	const auto edgeSet = [&](const std::vector<Corner>& loop) { // a loop may run along the border
		EdgeSet set;
		for (const Corner s : loop)
			if (glued[s].isValid())
				add(s, set);
		return set;
	};
	const auto componentOf = [&](Corner s) { return partition.component[s.face()]; };
	Array<EdgeSet> incoherent(partition.componentCount());
	for (const Corner s : glued.indices())
		if (const Corner t = glued[s];
			t > s && partition.isOneSided[componentOf(s)] && triangles[s] == triangles[t])
			add(s, incoherent[componentOf(s)]);
	const Adjacency<int, Link> graph = orientationGraph(price.size(), triangles, glued, length);
	Array<Place> places(graph.keyCount());
	// The contradicted edges of a component follow each other, and every one-sided loop crosses them.
	const std::vector<Corner>& sides = partition.contradicted.values();
	for (std::size_t first = 0, last; first < sides.size(); first = last) {
		const int component = componentOf(sides[first]);
		for (last = first; last < sides.size() && componentOf(sides[last]) == component;)
			++last;
		EdgeSet loop{{}, kInfinity};
		std::vector<int> roots;
		for (std::size_t i = first; i < last; ++i)
			if (const int v = triangles[sides[i]]; roots.empty() || price[v] == 0.0)
				roots.push_back(v);
		const std::size_t count = std::min(kRoots, roots.size());
		for (std::size_t i = 0; i < count; ++i)
			shortenLoop(graph, roots[i * roots.size() / count], places, loop);
		const EdgeSet shortest = edgeSet(loop.sides);
		const EdgeSet& given = incoherent[component];
		for (const Corner s :
			 given.length <= kOrderFactor * shortest.length ? given.sides : shortest.sides)
			unglue(s, glued);
	}
}

} // namespace ricci
