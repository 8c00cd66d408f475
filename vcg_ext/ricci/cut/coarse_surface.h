// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_COARSE_SURFACE_H
#define RICCI_COARSE_SURFACE_H

#include "../math/shortest_paths.h"
#include "../surface/triangulation.h"

namespace ricci {

/// A surface with fewer triangles, on which cuts are looked for.
///
/// Every vertex of the given surface belongs to the nearest of some centres: all marked vertices, all
/// boundary loops, and as many others as there is room for. The shortest paths from the centres are
/// drawn together, which changes no topology. Triangles with a side drawn together vanish, and of the
/// edges that then coincide the one with the cheapest path between its two centres remains.
///
/// The result is closed, as every boundary loop becomes one vertex. It may have loops and several
/// edges between two vertices.
class CoarseSurface
{
public:
	/// \param cost of the edges, not negative
	/// \param marked 1 at vertices that are to be centres
	/// \param vertexCount about how many vertices there shall be; more where much is marked
	CoarseSurface(
		const Triangulation& t,
		const EdgeArray<double>& cost,
		const VertexArray<char>& marked,
		int vertexCount);

	/// Without triangles if all of them have vanished: then there is no coarse surface.
	const Triangulation& triangulation() const { return m_coarse; }

	/// The cost of the path that an edge stands for, from centre to centre.
	const EdgeArray<double>& cost() const { return m_cost; }

	/// 1 at vertices that stand for marked ones and for boundary loops.
	const VertexArray<char>& marked() const { return m_marked; }

	/// The vertex of this surface that stands for \p v of the given one; none if \p v has no face.
	Vertex centreOf(Vertex v) const { return m_centre[v]; }

	/// The edges of the given surface along the paths of a cut of this one. Opened along them it is a disk
	/// if this one is; they may have dead ends.
	EdgeArray<char> lifted(const EdgeArray<char>& isCut) const;

private:
	using Front = SearchFront<Vertex, Halfedge>;

	void chooseCentres(const VertexArray<char>& marked, int vertexCount);
	void grow(double radius, Front& front) const;
	void drawTogether();
	double pathCost(Halfedge h) const;

	const Triangulation& m_t;
	const EdgeArray<double>& m_fineCost;
	ShortestPaths<Vertex, Halfedge> m_paths; // from the nearest centre
	VertexArray<Vertex> m_centre;            // see centreOf()
	Triangulation m_coarse;
	EdgeArray<double> m_cost;
	VertexArray<char> m_marked;
	EdgeArray<Edge> m_middle; // the edge of a path that joins the trees of its ends
};

} // namespace ricci

#endif
