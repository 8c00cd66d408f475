// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_sites.h"

#include "../math/shortest_paths.h"

#include <utility>

namespace ricci {

ConeSites::ConeSites(const EmbeddedSurface& surface, int vertices) :
		m_surface(surface),
		m_vertices(vertices < 0 ? surface.triangulation.vertexCount() : vertices),
		m_leaving(surface.triangulation.vertexCount(), [&](const auto& add) {
			for (const Halfedge h : surface.triangulation.halfedges())
				add(surface.triangulation.origin(h), h);
		})
{
}

int ConeSites::count() const
{
	int count = 0;
	for (const Vertex v : m_surface.triangulation.vertices())
		count += isAllowed(v);
	return count;
}

VertexArray<double> ConeSites::distancesFrom(Vertex v) const
{
	auto paths = shortestPaths<Vertex, Halfedge>(
		m_surface.triangulation.vertexCount(), {v}, [&](Vertex from, const auto& visit) {
			for (const Halfedge h : leaving(from))
				visit(target(h), m_surface.lengths[h.edge()], h);
		});
	return std::move(paths.distance);
}

} // namespace ricci
