// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CUT_SEGMENTS_H
#define RICCI_CUT_SEGMENTS_H

#include "../surface/triangulation.h"

#include <utility>
#include <vector>

namespace ricci {

/// A cut of a surface as a graph of which parts are taken out and put in, for shortenCut().
///
/// Its nodes are the vertices at which it branches or ends, and those on the boundary or with a
/// mark. A segment is a path of cut edges from node to node, or a closed one without any node.
class CutSegments
{
public:
	using Around = Triangulation::Around;

	/// \param cost of the edges, not negative; infinite where no path may run
	/// \param marked 1 at vertices that the cut must reach
	/// \param isCut kept up to date
	CutSegments(
		const Triangulation& t,
		const EdgeArray<double>& cost,
		const VertexArray<char>& marked,
		EdgeArray<char>& isCut);

	const Triangulation& triangulation() const { return m_t; }
	const EdgeArray<double>& cost() const { return m_cost; }
	bool isCut(Edge e) const { return m_isCut[e]; }
	bool isMarked(Vertex v) const { return m_marked[v]; }

	/// Whether \p e is cut, or on the boundary.
	bool isBorder(Edge e) const { return m_isCut[e] || m_t.isBoundary(e); }

	/// Cut edges at \p v.
	int degree(Vertex v) const { return m_degree[v]; }

	/// Whether paths end at \p v: it lies on the cut or the boundary, or the cut must reach it.
	bool isOnGraph(Vertex v) const { return m_onGraph[v]; }

	/// Whether a path may run along \p e: not cut, not on the boundary, not of infinite cost.
	bool isFree(Edge e) const { return m_free[e]; }

	/// The halfedges that leave \p v, clockwise from the lowest one inside the surface. Of equally
	/// short paths the first is taken; with this start that choice does not depend on the flips
	/// that led to the triangulation, as it would with Triangulation::around().
	Around around(Vertex v) const { return {m_t, m_first[v]}; }

	/// One edge of every segment.
	std::vector<Edge> segments();

	/// The edges of the segment of \p e. Those of a closed segment without a node are named twice.
	std::vector<Edge> segmentOf(Edge e) const;

	/// Nodes inside the surface at which several segments meet.
	std::vector<Vertex> branchNodes();

	/// The segments at a node.
	struct Star
	{
		std::vector<Edge> edges;
		int segments = 0;
		bool hasLoop = false; ///< a segment from the node to itself
	};
	Star starOf(Vertex node) const;

	void add(const std::vector<Edge>& edges);

	/// Takes \p edges out of the cut.
	void remove(const std::vector<Edge>& edges);

	/// Takes \p edges out of the cut, and then the dead ends that are left.
	/// \return all that was removed
	std::vector<Edge> removeWithDeadEnds(const std::vector<Edge>& edges);

	/// Numbers the circles: the boundaries of the surface opened along the cut. A marked vertex
	/// that the cut does not reach counts as a circle of its own. The halfedges that leave a circle
	/// are those between two sides (halfedges along the border, with the open surface on their left),
	/// the second of these included: from a side h they are found clockwise.
	///
	///                \  |  /
	///        ===h===> o ===n===>       border edges: cut or boundary .
	///
	/// Circle 0 is the one with the most sides, or the first mark where there are none.
	/// \return the number of circles
	int labelCircles();

	/// Brings the numbers up to date where \p removed has been taken out of the cut and \p added put in, and
	/// nothing else has changed. The other sides keep their places, and the new ones get the next, so that
	/// sides() are in order only in stretches: the more there are, the longer all that follows takes.
	/// \return the first new place
	int update(const std::vector<Edge>& removed, const std::vector<Edge>& added);

	/// Whether there are so many stretches that labelCircles() saves time.
	bool isFragmented() const { return m_whole.size() * m_whole.size() > m_sides.size(); }

	/// Numbers the circles where \p removed has been taken out of the cut, and nothing else has changed: in time
	/// proportional to what was removed and to the stretches. To be called again for other edges of the same
	/// cut, once those are in it again.
	/// \return the number of circles
	int splitCircles(const std::vector<Edge>& removed);

	/// Makes circle \p number a part of circle 0, which a path has joined to it that is now on the cut.
	void joinCircles(int number);

	/// The circle that \p h leaves; -1 if none.
	int circle(Halfedge h) const;

	/// A halfedge that leaves a circle.
	struct Departure
	{
		Vertex origin; ///< of the halfedge
		Halfedge halfedge;
		int circle;
	};

	/// Appends those between the sides at \p places and the sides before them, where these belong to other
	/// circles than circle 0.
	void addDepartures(const std::vector<int>& places, std::vector<Departure>& found) const;

	/// Appends those of marked vertices off the cut.
	void addDeparturesOfMarks(std::vector<Departure>& found) const;

	/// The sides in the order in which labelCircles() went along the circles; see update().
	const std::vector<Halfedge>& sides() const { return m_sides; }

	/// The place in sides() of the one up to which \p h lies; -1 if there is none.
	int place(Halfedge h) const;

private:
	bool isNode(Vertex v) const { return m_marked[v] || m_boundary[v] || m_degree[v] != 2; }
	void set(Edge e, bool cut);
	void noteVertex(Vertex v);
	void noteEdge(Edge e);
	void tidy();
	Vertex walk(Halfedge h, std::vector<Edge>& edges) const;
	Halfedge sideFrom(Halfedge h) const;

	/// Places from the first one on up to the next stretch, of sides that come one after another.
	struct Stretch
	{
		int first;
		int circle; ///< -1: taken out
	};
	void takeOut(const std::vector<Edge>& edges, std::vector<Stretch>& stretches) const;
	void beginAt(int place, std::vector<Stretch>& stretches) const;
	void appendSides(Halfedge first);
	std::size_t stretchOf(int place) const;
	int endOf(std::size_t stretch) const;
	void noteLoneMark(Vertex v);
	void findLoneMarks();

	const Triangulation& m_t;
	const EdgeArray<double>& m_cost;
	const VertexArray<char>& m_marked;
	EdgeArray<char>& m_isCut;
	VertexArray<char> m_boundary;
	VertexArray<Halfedge> m_first; // lowest halfedge inside that leaves the vertex
	VertexArray<int> m_degree;
	VertexArray<char> m_onGraph;      // see isOnGraph()
	EdgeArray<char> m_free;           // see isFree()
	std::vector<Halfedge> m_sides;    // see sides()
	HalfedgeArray<int> m_place;       // in m_sides; -1: none
	std::vector<Stretch> m_whole;     // of all places, in the whole cut; circles are not numbered
	std::vector<Stretch> m_stretches; // without what splitCircles() was told of
	std::vector<std::pair<Vertex, int>>
		m_loneMarks;                  // marked vertices off the cut, and their circles
	std::size_t m_wholeLoneMarks = 0; // those of the whole cut, which come first
	std::vector<Edge> m_cutEdges;     // all of them, and some that are no longer; see tidy()
	std::vector<Edge> m_boundaryEdges;
	std::vector<Vertex> m_marks; // marked vertices inside
};

} // namespace ricci

#endif
