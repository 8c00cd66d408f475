// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_sites.h"

#include "../base/numbers.h"
#include "../base/task.h"
#include "../cut/cut_graph.h"
#include "../mesh/triangulation.h"
#include "../metric/area.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ricci {

namespace {

double unit(const EmbeddedSurface& surface)
{
	return std::sqrt(euclideanArea(surface.triangulation, surface.lengths));
}

} // namespace

ConeSites::ConeSites(const EmbeddedSurface& surface, int vertices) :
		m_isAllowed(surface.triangulation.vertexCount()),
		m_ways(
			surface.triangulation.vertexCount(),
			[&](const auto& add) {
				const Triangulation& t = surface.triangulation;
				const double whole = unit(surface);
				for (const Halfedge h : t.halfedges())
					add(t.origin(h), Way{t.target(h), surface.lengths[h.edge()] / whole});
			}),
		m_toCut(surface.triangulation.vertexCount(), kInfinity)
{
	const Triangulation& t = surface.triangulation;
	for (const Vertex v : t.vertices()) {
		m_isAllowed[v] = (vertices < 0 || v.number() < vertices) && !surface.topology.boundary[v];
		if (surface.topology.boundary[v])
			m_toCut[v] = 0.0;
	}
	checkpoint();
	if (surface.topology.type.isSphere() || surface.topology.type.isDisk())
		return;
	VertexArray<double> lengths(t.vertexCount(), 0.0); // of the edges at a vertex
	for (const Halfedge h : t.halfedges())
		lengths[t.origin(h)] += surface.lengths[h.edge()];
	const auto root = std::max_element(lengths.begin(), lengths.end()); // whatever the numbers
	const CutGraph cut = cutToDisk(
		t,
		surface.lengths,
		VertexArray<char>(t.vertexCount(), 0),
		Vertex(static_cast<int>(root - lengths.begin())));
	for (const Edge e : t.edges())
		if (cut.isCut[e]) {
			m_cutLength += surface.lengths[e];
			for (const Vertex v : t.ends(e))
				m_toCut[v] = 0.0;
		}
	m_cutLength /= unit(surface);
	checkpoint();
}

ConeSites::ConeSites(const ConeSites& fine, const VertexArray<Vertex>& chosen) :
		m_toCut(chosen.size(), kInfinity), m_cutLength(fine.m_cutLength)
{
	SearchFront<Vertex, Vertex> front(fine.m_isAllowed.size());
	VertexArray<Vertex> nearest(fine.m_isAllowed.size());
	for (const Vertex c : chosen.indices()) {
		m_isAllowed.push_back(fine.m_isAllowed[chosen[c]]);
		nearest[chosen[c]] = c;
		front.offer(chosen[c], 0.0);
	}
	for (Vertex v = front.next(); v.isValid(); v = front.next()) {
		if (front.parent(v).isValid())
			nearest[v] = nearest[front.parent(v)];
		if (nearest[v].isValid())
			m_toCut[nearest[v]] = std::min(m_toCut[nearest[v]], front[v] + fine.m_toCut[v]);
		for (const auto& [to, length] : fine.ways(v))
			front.offer(to, front[v] + length, v);
	}
	checkpoint();
	std::vector<std::tuple<Vertex, Vertex, double>> ways; // from, to, length
	for (const Vertex v : nearest.indices())
		for (const auto& [to, length] : fine.ways(v))
			if (nearest[v].isValid() && nearest[to].isValid() && nearest[v] != nearest[to])
				ways.emplace_back(nearest[v], nearest[to], front[v] + length + front[to]);
	std::sort(ways.begin(), ways.end());
	const auto isSamePair = [](const auto& a, const auto& b) {
		return std::get<0>(a) == std::get<0>(b) && std::get<1>(a) == std::get<1>(b);
	};
	ways.erase(std::unique(ways.begin(), ways.end(), isSamePair), ways.end());
	m_ways = Adjacency<Vertex, Way>(chosen.size(), [&](const auto& add) {
		for (const auto& [from, to, length] : ways)
			add(from, Way{to, length});
	});
}

int ConeSites::count() const
{
	return static_cast<int>(std::count(m_isAllowed.begin(), m_isAllowed.end(), 1));
}

SeamTree::SeamTree(const ConeSites& sites, const std::vector<Vertex>& cones) :
		m_sites(&sites), m_length(sites.cutLength()), m_distance(sites.toCut()),
		m_next(sites.toCut().size()), m_uses(sites.toCut().size(), 0)
{
	DistanceQueue<Vertex> queue;
	for (const Vertex v : m_distance.indices())
		if (m_distance[v] < kInfinity)
			queue.push(m_distance[v], v);
	VertexArray<char> isLeft(m_uses.size(), 0);
	int left = 0;
	for (const Vertex v : cones) {
		left += isLeft[v] == 0;
		isLeft[v] = 1;
	}
	const auto isCone = [&](Vertex v) { return isLeft[v] != 0; };
	for (; left > 0; --left) {
		Vertex next = spread(queue, isCone);
		if (!next.isValid())
			next = *std::find_if(cones.begin(), cones.end(), isCone);
		isLeft[next] = 0;
		for (const Vertex v : join(next))
			queue.push(0.0, v);
	}
	spread(queue, [](Vertex) { return false; });
}

void SeamTree::add(Vertex cone)
{
	spread(join(cone));
}

/// Takes the way from \p cone into the tree. \return what has become part of it
std::vector<Vertex> SeamTree::join(Vertex cone)
{
	std::vector<Vertex> path;
	for (Vertex v = cone; v.isValid(); v = m_next[v]) {
		if (m_uses[v]++ > 0)
			break;
		m_length += lengthOfStep(v);
		m_distance[v] = 0.0;
		path.push_back(v);
	}
	return path;
}

double SeamTree::ownLength(Vertex cone) const
{
	double length = 0.0;
	for (Vertex v = cone; v.isValid() && m_uses[v] == 1; v = m_next[v])
		length += lengthOfStep(v);
	return length;
}

double SeamTree::remove(Vertex cone)
{
	std::vector<Vertex> loose;
	double length = 0.0;
	for (Vertex v = cone; v.isValid() && --m_uses[v] == 0; v = m_next[v]) {
		length += lengthOfStep(v);
		m_distance[v] = kInfinity;
		loose.push_back(v);
	}
	// All whose shortest way led there look for another.
	for (std::size_t i = 0; i < loose.size(); ++i)
		for (const auto& [to, step] : m_sites->ways(loose[i]))
			if (m_next[to] == loose[i] && m_distance[to] < kInfinity) {
				m_distance[to] = kInfinity;
				loose.push_back(to);
			}
	for (const Vertex v : loose) {
		m_distance[v] = m_sites->toCut()[v];
		m_next[v] = Vertex();
		for (const auto& [to, step] : m_sites->ways(v))
			if (m_distance[to] + step < m_distance[v]) {
				m_distance[v] = m_distance[to] + step;
				m_next[v] = to;
			}
	}
	spread(loose);
	m_length -= length;
	return length;
}

/// From \p v on the way to the tree; nothing where the tree begins.
double SeamTree::lengthOfStep(Vertex v) const
{
	if (!m_next[v].isValid())
		return m_sites->toCut()[v] < kInfinity ? m_sites->toCut()[v] : 0.0;
	double shortest = kInfinity;
	for (const auto& [to, step] : m_sites->ways(v))
		if (to == m_next[v])
			shortest = std::min(shortest, step);
	return shortest;
}

/// Makes the distances shorter that are so by those of \p from.
void SeamTree::spread(const std::vector<Vertex>& from)
{
	DistanceQueue<Vertex> queue;
	for (const Vertex v : from)
		if (m_distance[v] < kInfinity)
			queue.push(m_distance[v], v);
	spread(queue, [](Vertex) { return false; });
}

/// The same by those in \p queue, up to the first that \p isEnd.
/// \return that one; invalid if there is none
template<class IsEnd>
Vertex SeamTree::spread(DistanceQueue<Vertex>& queue, const IsEnd& isEnd)
{
	while (!queue.empty()) {
		const auto [distance, v] = queue.top();
		if (isEnd(v))
			return v;
		queue.pop();
		if (distance != m_distance[v])
			continue;
		for (const auto& [to, step] : m_sites->ways(v))
			if (distance + step < m_distance[to]) {
				m_distance[to] = distance + step;
				m_next[to] = v;
				queue.push(m_distance[to], to);
			}
	}
	return {};
}

} // namespace ricci
