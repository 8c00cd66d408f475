// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_SITES_H
#define RICCI_CONE_SITES_H

#include "../math/adjacency.h"
#include "../surface/flow_domain.h"

namespace ricci {

/// Where cones may lie on a surface, and the ways from one site to the next.
class ConeSites
{
public:
	/// A way to a site next to another.
	struct Way
	{
		Vertex to;
		double length;
	};

	/// The vertices of \p surface and its edges.
	/// \param vertices cones may lie at vertices with a number below this; -1: at any
	ConeSites(const EmbeddedSurface& surface, int vertices);

	/// Some of the sites of \p fine, numbered anew. Two of them are joined where regions nearest to
	/// them meet, by the shortest way through the two; the minimum spanning trees of shortest paths
	/// stay the same [Mehlhorn 1988].
	ConeSites(const ConeSites& fine, const VertexArray<Vertex>& chosen);

	/// Whether a cone may lie at \p v: in the interior, with a number that is low enough.
	bool isAllowed(Vertex v) const { return m_isAllowed[v] != 0; }

	/// Number of sites where a cone may lie.
	int count() const;

	/// The ways from \p v.
	ItemRange<const Way> ways(Vertex v) const { return m_ways[v]; }

	/// Lengths of the shortest paths from \p v to every site.
	VertexArray<double> distancesFrom(Vertex v) const;

private:
	VertexArray<char> m_isAllowed;
	Adjacency<Vertex, Way> m_ways;
};

} // namespace ricci

#endif
