// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_NORMAL_COORDINATES_H
#define RICCI_NORMAL_COORDINATES_H

#include "triangulation.h"

#include <algorithm>
#include <vector>

namespace ricci {

/// Where the edges of one triangulation run on another that flips have made of it, in integers
/// alone: for each edge the number of crossings, and for each halfedge its place among the original
/// halfedges round its origin (normal coordinates and roundabouts, Gillespie, Sharp and Crane
/// 2021). "Curves" below are the edges of the original triangulation, pulled tight.
class NormalCoordinates
{
public:
	explicit NormalCoordinates(const Triangulation& original);

	/// Follow a flip of edge \p e, forwards or backwards (see Triangulation).
	void flip(int e);
	void unflip(int e);

	const Triangulation& triangulation() const { return m_triangulation; }

	/// Number of curves across edge \p e; 0 also where the edge is itself a curve.
	int crossings(int e) const { return std::max(m_crossings[static_cast<std::size_t>(e)], 0); }

	/// Whether edge \p e is one of the original edges.
	bool isCurve(int e) const { return m_crossings[static_cast<std::size_t>(e)] < 0; }

	/// A point where a curve leaves a triangle: across halfedge h of that triangle, as number
	/// \p position of the curves across it, counted from 0 at the origin of h.
	struct Crossing
	{
		int halfedge;
		int position;
	};

	/// The way of one original edge, from the origin of its even halfedge.
	struct Curve
	{
		/// Halfedge from which the curve leaves counter-clockwise, at its origin; where the curve is
		/// an edge, that edge's halfedge in its direction.
		int first = -1;
		int last = -1;                   ///< the same, seen from the curve's other end
		std::vector<Crossing> crossings; ///< empty where the curve is an edge
	};

	/// The ways of all original edges.
	std::vector<Curve> trace() const;

	/// The original halfedge that \p h is, or that lies next clockwise from it, at its origin.
	int originalAtOrBefore(int h) const;

private:
	/// Curves in the triangle on the left of halfedge h = ij, apex k.
	struct Corners
	{
		int cutI, cutJ, cutK;    ///< curves that cut off a corner
		int fromI, fromJ, fromK; ///< curves that leave through the side opposite a corner
	};

	Corners cornersOf(int h) const;
	int flipped(int e) const;
	void updateRoundabout(int h);

	Triangulation m_triangulation;
	std::vector<int> m_crossings; // [edge]; -1 where the edge is a curve
	std::vector<int>
		m_roundabout;          // [halfedge] rank, at its origin, of the first curve at or after it
	std::vector<int> m_degree; // [vertex] original halfedges that start there
	std::vector<int> m_start;  // [vertex] into m_ranked
	std::vector<int> m_ranked; // original halfedges, counter-clockwise round each vertex
};

} // namespace ricci

#endif
