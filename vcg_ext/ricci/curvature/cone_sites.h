// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_SITES_H
#define RICCI_CONE_SITES_H

#include "../math/adjacency.h"
#include "../surface/flow_domain.h"

namespace ricci {

/// Where cones may lie on a surface, the ways from one site to the next, and those that seams take without
/// any cone. Lengths are in units of the square root of the surface's area.
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

	/// How far every site is from the seams that open the surface to a disk or a sphere without cones, and
	/// from its boundary; infinite where there are none.
	const VertexArray<double>& toCut() const { return m_toCut; }

	/// Length of those seams.
	double cutLength() const { return m_cutLength; }

private:
	void findCut(const EmbeddedSurface& surface);

	VertexArray<char> m_isAllowed;
	Adjacency<Vertex, Way> m_ways;
	VertexArray<double> m_toCut; // of the surface's own vertices: 0 or infinite
	double m_cutLength = 0.0;
};

} // namespace ricci

#endif
