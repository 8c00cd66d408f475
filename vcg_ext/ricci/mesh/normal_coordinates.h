// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_NORMAL_COORDINATES_H
#define RICCI_NORMAL_COORDINATES_H

#include "triangulation.h"

#include <algorithm>
#include <array>
#include <vector>

namespace ricci {

/// Where the edges of one triangulation run on another that flips have made of it, in integers
/// alone [Gillespie Sharp Crane 2021]: for each edge its normal coordinate n, the number of
/// crossings, and for each halfedge its roundabout r, its place among the original halfedges round
/// its origin. "Curves" below are the edges of the original triangulation, pulled tight. An edge
/// that is itself a curve has n = -1.
///
/// Curves in a triangle ijk either cut off a corner or emanate from one and leave through the
/// opposite side. Their numbers, c and e, follow from the normal coordinates of the sides (negative
/// ones taken as 0):
///
///             k                 e_k = max(0, n_ij - n_jk - n_ki),
///           /   \               c_k = (n_jk + n_ki - n_ij) / 2  if all e are 0,
///     n_ki / c_k \ n_jk         c_k = 0, c_i = n_ki, c_j = n_jk if e_k > 0;
///         /       \             the others by turning the letters.
///        i ------- j
///           n_ij
///
/// Along ij, from i: c_i curves, then e_k, then c_j.
///
/// A flip of ij, with c, e of triangle ijk and c', e' of jil:
///
///             k                          k
///           /   \                      / | \             .
///     n_ki /     \ n_jk          n_ki /  |  \ n_jk
///         /  n_ij \                  /   |   \           .
///        i ------> j       ->       i  n_kl   j
///         \       /                  \   ^   /
///     n_il \     / n_lj          n_il \  |  / n_lj
///           \   /                      \ | /
///             l                          l
///
///   n_kl = c_k + c'_l + e_i + e_j + e'_i + e'_j + [1 if n_ij = -1]
///          + max(0, c_i - c'_i - e'_l) + max(0, c'_i - c_i - e_k),
///
/// the curves that run from the side of i to the side of j; -1 if a curve runs from k to l. The
/// roundabout of a halfedge is that of the next one clockwise, plus the curves that start at that
/// one or between the two: r_lk = r_lj + [1 if n_lj = -1] + e''_l modulo the degree of l, with e''
/// of the new triangle ljk; r_kl likewise.
class NormalCoordinates
{
public:
	explicit NormalCoordinates(const Triangulation& original);

	/// The same with some of the edges for curves. What is said of original edges and halfedges below
	/// holds for these alone.
	/// \param isCurve 1 on these edges, which include those of the boundary
	NormalCoordinates(const Triangulation& original, const EdgeArray<char>& isCurve);

	/// Follow a flip of edge \p e, forwards or backwards (see Triangulation).
	/// \pre \p e is flippable
	void flip(Edge e) { follow(e, &Triangulation::flip); }
	void unflip(Edge e) { follow(e, &Triangulation::unflip); }

	const Triangulation& triangulation() const { return m_triangulation; }

	/// Number of curves across edge \p e; 0 also where the edge is itself a curve.
	int crossings(Edge e) const { return std::max(m_normal[e], 0); }

	/// Whether edge \p e is one of the original edges.
	bool isCurve(Edge e) const { return m_normal[e] < 0; }

	/// A point where a curve leaves a triangle: across a halfedge of that triangle, as number
	/// \p position of the curves across it, counted from 0 at the origin of the halfedge.
	struct Crossing
	{
		Halfedge halfedge;
		int position;
	};

	/// The way of one original edge e, from the origin of e.halfedge().
	struct Curve
	{
		/// The halfedge at the curve's beginning from which it leaves counter-clockwise, into the
		/// triangle on the left; where the curve is an edge, that edge's halfedge in its direction.
		Halfedge first;
		Halfedge last;                   ///< the same, seen from the curve's other end
		std::vector<Crossing> crossings; ///< empty where the curve is an edge
	};

	/// The ways of all original edges, by original edge.
	EdgeArray<Curve> trace() const;

	/// Whether any curve starts at \p v.
	bool hasCurves(Vertex v) const { return m_degree[v] > 0; }

	/// The original halfedge that \p h is, or that lies next clockwise from it, at its origin; or the
	/// one that lies \p after places counter-clockwise from there.
	/// \pre a curve starts there
	Halfedge originalAtOrBefore(Halfedge h, int after = 0) const;

	/// Numbers of curves in the triangle on the left of a halfedge ij, apex k.
	struct CornerCurves
	{
		int cutOffI = 0, cutOffJ = 0, cutOffK = 0; ///< c: curves that cut off the corner
		int emanateFromI = 0, emanateFromJ = 0, emanateFromK = 0; ///< e: curves that start there
	};

	/// \pre \p h is not exterior
	CornerCurves cornerCurves(Halfedge h) const;

private:
	int flippedNormalCoordinate(Edge e) const;
	void follow(Edge e, void (Triangulation::*change)(Edge));
	void updateRoundabout(Halfedge h);

	/// The original halfedge of this rank, modulo the degree, at \p v.
	Halfedge original(Vertex v, int rank) const
	{
		return m_ranked[m_start[v] + rank % m_degree[v]];
	}

	Triangulation m_triangulation;
	EdgeArray<int> m_normal;         // -1 where the edge is a curve
	HalfedgeArray<int> m_roundabout; // rank, at its origin, of the first curve at or after it
	VertexArray<int> m_degree;       // original halfedges that start there
	VertexArray<int> m_start;        // into m_ranked
	Array<Halfedge> m_ranked;        // original halfedges, counter-clockwise round each vertex
};

/// Unfolds the strip of triangles that \p curve runs through, in the flat metric of these \p lengths on \p t, on which
/// the curve was traced, from its beginning at the origin of the plane. Directions are carried as angles, which rounding
/// changes less than coordinates where triangles are thin.
/// \param crossed the ends of the crossed halfedge, of every crossing in order
/// \return the end of the curve
/// \pre the curve has at least one crossing
Point2 unfold(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const NormalCoordinates::Curve& curve,
	std::vector<std::array<Point2, 2>>& crossed);

} // namespace ricci

#endif
