// SPDX-License-Identifier: GPL-3.0-or-later
// The folder refinement: the common subdivision of the mesh and of the start and the end of the flow. Maps that
// keep the mesh never come here.
// Points of edges and triangles by barycentric coordinates.
//
// An affine coordinate of a point of an edge is its share: 0 at the origin of the edge's halfedge(),
// 1 at the target. Homogeneous coordinates are weights, of which only the ratio counts.
// The overlay of the triangulations that a flow with flips goes through.
//
// They are three, of one surface, with the same vertices: the input; the start, reached from it by
// flips in the input's metric, whose edges are straight there; and the end, reached from the start by
// flips that keep the conformal class. The overlay is made triangle by triangle of the start:
//
//            k            i, j, k: vertices, corners of a start triangle
//           /:\           o--x--o: chord of an input edge
//          / : \          k: :x: :o: chord of an end edge
//         o--x--o         o: crossing of an input or end edge with a start edge
//        /   :   \        x: crossing of an input edge with an end edge
//       /    :    \       Here the chords divide the start triangle into four pieces.
//      i-----o-----j
//
//   chord     the part of an input edge or of an end edge inside one start triangle: two families
//   crossing  a point where edges of two of the triangulations cross
//   node      a vertex of the overlay: a vertex, a crossing, or crossings of both families that are
//             one point of a start edge
//   piece     a part of a start triangle between the chords; it lies in one triangle of each
//             triangulation
//   side      a part of a piece's border between two of its nodes
#ifndef RICCI_OVERLAY_PIECES_H
#define RICCI_OVERLAY_PIECES_H

#include "../base/graphs.h"
#include "../base/tolerances.h"
#include "../flow/ricci_flow.h"
#include "../layout/corner_layout.h"
#include "../mesh/surface_mesh.h"
#include "../mesh/triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ricci {

inline double keepInside(double share)
{
	return std::min(
		std::max(std::isfinite(share) ? share : 0.5, kManyRoundings), 1.0 - kManyRoundings);
}

inline double mix(double a, double b, double t)
{
	return (1.0 - t) * a + t * b;
}

/// Homogeneous coordinates of a point of an edge.
struct EdgeWeights
{
	double from = 0.0, to = 0.0; ///< weights of the edge's ends

	/// The point with \p share, in the coordinates for which over(radii).affine() is the share.
	static EdgeWeights ofShare(double share, double fromRadius, double toRadius)
	{
		return {(1.0 - share) * fromRadius, share * toRadius};
	}

	/// From coordinates in the basis of the ends' unit vectors of R^{2,1}, which belong to their
	/// circles, to those in the basis of the points themselves.
	EdgeWeights over(double fromRadius, double toRadius) const
	{
		return {from / fromRadius, to / toRadius};
	}
	/// The same point, the edge seen from its other end.
	EdgeWeights reversed() const { return {to, from}; }

	double sum() const { return from + to; }
	double affine() const { return to / (from + to); }
};

inline double determinant(const EdgeWeights& a, const EdgeWeights& b)
{
	return a.from * b.to - a.to * b.from;
}

/// Affine coordinates of a point of a triangle, in the order of its halfedges().
using FaceWeights = std::array<double, 3>;

/// The point of halfedge \p h of \p t with \p share, counted from the origin of \p h, in the triangle
/// on its left.
/// \pre \p h is not exterior
inline FaceWeights pointOnSide(const Triangulation& t, Halfedge h, double share)
{
	FaceWeights p{0, 0, 0};
	const std::size_t k = t.corner(h).index();
	p[k] = 1.0 - share;
	p[(k + 1) % 3] = share;
	return p;
}

/// A point of the end triangulation, by the element inside which it lies.
struct PointOnEnd
{
	enum Kind { AtVertex, OnEdge, InFace };

	Kind kind = AtVertex;
	int element = -1;            ///< number of the vertex, edge or face
	double share = 0.0;          ///< on an edge
	FaceWeights weight{0, 0, 0}; ///< in a face
};

/// A vertex of the overlay.
struct OverlayNode
{
	SurfacePoint point; ///< on the input
	PointOnEnd end;
	/// Of a vertex, or a crossing with an end edge: weight sum in the end metric over that in the
	/// start metric.
	double scale = 1.0;
};

/// A corner of a piece, and the side from there to the next corner, counter-clockwise.
struct PieceCorner
{
	int node = -1;
	int side = -1;        ///< number of the side, shared with the piece on its other side
	Halfedge input;       ///< input halfedge along this side, if any
	Halfedge end;         ///< end halfedge along this side, if any
	Halfedge inputCorner; ///< at a vertex: input halfedge whose corner this is
	Halfedge endCorner;   ///< at a vertex: end halfedge whose corner this is
};

/// A corner of a piece, or the side from there to the next corner.
struct PieceSide
{
	int piece = -1, corner = -1;

	bool isValid() const { return piece >= 0; }
};

/// All pieces and their nodes, the neighbours of the pieces across their sides, and the triangles in which
/// they lie.
class OverlayPieces
{
public:
	Array<OverlayNode> nodes; ///< the vertices first, in order
	int sideCount = 0;

	/// [side] The pieces on both sides of it, the lower one first; the second is none on the border.
	Array<std::array<PieceSide, 2>> links;
	Array<Face> inputFace; ///< [piece]
	Array<Face> endFace;   ///< [piece]

	int count() const { return m_first.size() - 1; }
	int size(int piece) const { return m_first[piece + 1] - m_first[piece]; }

	/// Number of a corner among those of all pieces. \p i may run past the last corner.
	int corner(int piece, int i) const { return m_first[piece] + i % size(piece); }
	int cornerCount() const { return m_first.back(); }

	PieceCorner& operator()(int piece, int i) { return m_corners[corner(piece, i)]; }
	const PieceCorner& operator()(int piece, int i) const { return m_corners[corner(piece, i)]; }

	const PieceCorner& at(const PieceSide& side) const { return (*this)(side.piece, side.corner); }

	/// The corners of a piece, in order.
	ItemRange<const PieceCorner> corners(int piece) const
	{
		return {m_corners.data() + m_first[piece], m_corners.data() + m_first[piece + 1]};
	}

	/// Adds a piece without corners; append() adds corners to the last piece.
	void startPiece() { m_first.push_back(m_first.back()); }
	void append(const PieceCorner& c)
	{
		m_corners.push_back(c);
		++m_first.back();
	}

	/// Finds the neighbours and the triangles of all pieces, then forgets the pieces that do not lie in
	/// the first \p keptFaces faces of the input.
	/// \throw InternalError if a piece has no triangle: a fault of the program
	void link(const Triangulation& input, const Triangulation& end, int keptFaces);

private:
	void findLinks();
	void findFaces(const Triangulation& input, const Triangulation& end);
	template<class IsBorder>
	void spread(Array<Face>& face, const IsBorder& isBorder) const;
	void keepFacesBelow(Face firstDropped);

	Array<PieceCorner> m_corners;
	Array<int> m_first = Array<int>(1, 0);
};

/// Computes the pieces of all start triangles, and links them (OverlayPieces::link()).
///
/// Which edge crosses which, and in what order, is decided by integers (normal coordinates,
/// [Gillespie Sharp Crane 2021]) wherever two of the triangulations are concerned, so that the
/// pieces always fit together. Inside a start triangle an input edge is a straight chord in
/// barycentric coordinates, because its flips are isometric. So is an end edge: it is straight in
/// the Klein picture of the decorated triangle, and that chart differs from the barycentric one by a
/// projective map, the diagonal scaling with the radii [Springborn Schroeder Pinkall 2008],
/// [Bobenko Lutz 2023]. The order of the two families of crossings along a start edge is that of
/// their numeric positions there, used by both start triangles; whether two chords cross then
/// follows from the order of their ends.
///
/// Asks requireOverlayMemory() before there is an array of crossings.
/// \pre the flow ran with intrinsic flips
/// \param domain where the flow's surface goes on beyond the domain's (its double, caps on holes), the overlay ends at
/// the boundary of that
/// \throw InternalError if the chords do not fit together: a fault of the program
OverlayPieces divideStartTriangles(const FlowDomain& domain, const FlowResult& flow);

/// A corner of a piece in the piece's end triangle.
/// \throw InternalError if the corner is not in that triangle: a fault of the program
FaceWeights
inEndTriangle(const OverlayPieces& pieces, const Triangulation& end, int piece, int corner);

/// Triangulates a polygon that is convex both in the plane and in space (where it is flat too); some
/// of its corners may be straight. The worst triangle, in the plane or in space, is as good as it can
/// be (quality: area over the square of the longest side), so that straight corners never make a
/// triangle of their own. By dynamic programming over the diagonals [Klincsek 1980], cubic in the
/// number of corners.
/// \param plane, space the corners, counter-clockwise; at least 3
/// \return triangles as indices into the corners, counter-clockwise
std::vector<std::array<std::size_t, 3>>
triangulatePiece(const std::vector<Point2>& plane, const std::vector<Point3>& space);

/// The layout of the overlay, divideStartTriangles(), of the triangles of the input, of the start and of the end of \p flow, cut
/// along the surface's edges with \p isCut: every piece lies in one triangle of each, and the map to the plane or
/// the disk is the flow's own there. The vertices of the refinement are the surface's, then the points where
/// edges cross.
///
/// Positions: affine on the input's faces; in the plane by the projective map of the decorated
/// discrete conformal equivalence, b'_i ~ b_i exp(-(u_i - u0_i)) between a start triangle and an
/// end triangle with the same vertices [Springborn Schroeder Pinkall 2008], [Bobenko Lutz 2023];
/// on the refinement it is continuous across all edges [Gillespie Springborn Crane 2021].
/// \pre the flow ran with intrinsic flips
SurfaceLayout
layOutRefinement(const FlowDomain& domain, const FlowResult& flow, const EdgeArray<char>& isCut);

} // namespace ricci

#endif
