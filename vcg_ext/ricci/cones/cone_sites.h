// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_SITES_H
#define RICCI_CONE_SITES_H

#include "../base/graphs.h"
#include "../mesh/component.h"

#include <utility>
#include <vector>

namespace ricci {

/// Where cones may lie on a surface, the ways from one site to the next, and those that seams take without
/// any cone. Lengths are in units of the square root of the surface's area.
class ConeSites
{
public:
	/// To a site next to another, and how long it is.
	using Way = std::pair<Vertex, double>;

	/// The vertices of \p surface and its edges.
	/// \param vertices cones may lie at vertices with a number below this; -1: at any
	ConeSites(const EmbeddedSurface& surface, int vertices);

	/// Some of the sites of \p fine, renumbered. Two of them are joined where regions nearest to
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
	VertexArray<char> m_isAllowed;
	Adjacency<Vertex, Way> m_ways;
	VertexArray<double> m_toCut; // of the surface's own vertices: 0 or infinite
	double m_cutLength = 0.0;
};

/// An estimate of the seams of a map with cones: those that the surface has without them
/// (ConeSites::toCut()) and paths along edges, by each of which a cone joins what is there by the
/// shortest way [Takahashi Matsuyama 1980]. Lengths as those of ConeSites.
class SeamTree
{
public:
	/// With \p cones, the nearest to the tree first, and the first one first where there are no
	/// seams without cones.
	explicit SeamTree(const ConeSites& sites, const std::vector<Vertex>& cones = {});

	double length() const { return m_length; }

	/// How much longer the tree becomes by a cone at \p v; infinite where it is empty.
	double distance(Vertex v) const { return m_distance[v]; }

	void add(Vertex cone);

	/// Takes the cone out again, and the path to it, up to where another one joins.
	/// \return the length of that; 0 where paths of other cones pass
	double remove(Vertex cone);

	/// What remove() would return.
	double ownLength(Vertex cone) const;

private:
	double lengthOfStep(Vertex v) const;
	std::vector<Vertex> join(Vertex cone);
	void spread(const std::vector<Vertex>& from);
	template<class IsEnd>
	Vertex spread(DistanceQueue<Vertex>& queue, const IsEnd& isEnd);

	const ConeSites* m_sites;
	double m_length;
	VertexArray<double> m_distance; // to the tree
	VertexArray<Vertex> m_next;     // on the way to the tree, and on it to where its paths began
	VertexArray<int> m_uses;        // cones at a vertex, and paths that go on from it
};

} // namespace ricci

#endif
