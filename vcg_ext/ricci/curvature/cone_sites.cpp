// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_sites.h"

#include "../math/shortest_paths.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

namespace ricci {

ConeSites::ConeSites(const EmbeddedSurface& surface, int vertices) :
		m_isAllowed(surface.triangulation.vertexCount()),
		m_ways(surface.triangulation.vertexCount(), [&](const auto& add) {
			const Triangulation& t = surface.triangulation;
			for (const Halfedge h : t.halfedges())
				add(t.origin(h), Way{t.target(h), surface.lengths[h.edge()]});
		})
{
	for (const Vertex v : m_isAllowed.indices())
		m_isAllowed[v] = (vertices < 0 || v.number() < vertices) && !surface.topology.boundary[v];
}

ConeSites::ConeSites(const ConeSites& fine, const VertexArray<Vertex>& chosen)
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
		for (const Way& way : fine.ways(v))
			front.offer(way.to, front[v] + way.length, v);
	}
	std::vector<std::tuple<Vertex, Vertex, double>> ways; // from, to, length
	for (const Vertex v : nearest.indices())
		for (const Way& way : fine.ways(v))
			if (nearest[v].isValid() && nearest[way.to].isValid() && nearest[v] != nearest[way.to])
				ways.emplace_back(
					nearest[v], nearest[way.to], front[v] + way.length + front[way.to]);
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

VertexArray<double> ConeSites::distancesFrom(Vertex v) const
{
	auto paths =
		shortestPaths<Vertex, Vertex>(m_isAllowed.size(), {v}, [&](Vertex from, const auto& visit) {
			for (const Way& way : ways(from))
				visit(way.to, way.length, from);
		});
	return std::move(paths.distance);
}

} // namespace ricci
