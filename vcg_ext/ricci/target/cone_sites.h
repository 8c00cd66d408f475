// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_SITES_H
#define RICCI_CONE_SITES_H

#include "../math/adjacency.h"
#include "../surface/flow_domain.h"

namespace ricci {

/// Where cones may lie on a surface, and the ways along its edges. Refers to the surface.
class ConeSites
{
public:
	/// \param vertices cones may lie at vertices with a number below this; -1: at any
	ConeSites(const EmbeddedSurface& surface, int vertices);

	/// Whether a cone may lie at \p v: in the interior, with a number that is low enough.
	bool isAllowed(Vertex v) const
	{
		return v.number() < m_vertices && !m_surface.topology.boundary[v];
	}

	/// Number of vertices where a cone may lie.
	int count() const;

	/// The halfedges that leave \p v, in increasing order.
	ItemRange<const Halfedge> leaving(Vertex v) const { return m_leaving[v]; }
	Vertex target(Halfedge h) const { return m_surface.triangulation.target(h); }

	/// Lengths of the shortest paths along edges from \p v to every vertex.
	VertexArray<double> distancesFrom(Vertex v) const;

private:
	const EmbeddedSurface& m_surface;
	int m_vertices;
	Adjacency<Vertex, Halfedge> m_leaving;
};

} // namespace ricci

#endif
