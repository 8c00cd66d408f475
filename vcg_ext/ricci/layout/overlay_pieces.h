// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_OVERLAY_PIECES_H
#define RICCI_OVERLAY_PIECES_H

#include "common_refinement.h"

#include "../numbers.h"

#include <array>
#include <vector>

namespace ricci {

/// Where a node of the overlay lies on the end triangulation.
struct EndPlace
{
	enum Kind { Vertex, Edge, Face } kind = Vertex;
	int element = -1;                      ///< vertex, edge or face
	double along = 0.0;                    ///< Edge: from the origin of its even halfedge
	std::array<double, 3> corner{0, 0, 0}; ///< Face: weights of the origins of halfedges(face)
};

/// A vertex of the overlay.
struct OverlayNode
{
	SurfacePoint point;
	EndPlace end;
	/// Of a vertex, or a crossing with an end edge: weight sum in the end metric over that in the
	/// start metric.
	double scale = 1.0;
};

/// A corner of a piece, and the side from there to the next corner, counter-clockwise.
struct PieceCorner
{
	int node = -1;
	int side = -1;        ///< name of the side, shared with the neighbour piece
	int input = -1;       ///< input halfedge along this side, or -1
	int end = -1;         ///< end halfedge along this side, or -1
	int inputCorner = -1; ///< at a vertex: input halfedge whose corner this is
	int endCorner = -1;   ///< at a vertex: end halfedge whose corner this is
};

/// The parts into which the edges of the input's and of the end's triangulation divide the start
/// triangles: each lies in one triangle of all three.
class OverlayPieces
{
public:
	std::vector<OverlayNode> nodes; ///< the vertices first, in order
	int sideCount = 0;

	int count() const { return static_cast<int>(m_first.size()) - 1; }
	int size(int piece) const { return m_first[at(piece + 1)] - m_first[at(piece)]; }

	/// Number of a corner among those of all pieces. \p i may run past the last corner.
	int corner(int piece, int i) const { return m_first[at(piece)] + i % size(piece); }
	int cornerCount() const { return m_first.back(); }

	PieceCorner& operator()(int piece, int i) { return m_corners[at(corner(piece, i))]; }
	const PieceCorner& operator()(int piece, int i) const
	{
		return m_corners[at(corner(piece, i))];
	}

	/// The corners of a piece, in order.
	struct Corners
	{
		const PieceCorner *first, *last;
		const PieceCorner* begin() const { return first; }
		const PieceCorner* end() const { return last; }
	};
	Corners corners(int piece) const
	{
		return {m_corners.data() + m_first[at(piece)], m_corners.data() + m_first[at(piece + 1)]};
	}

	void startPiece() { m_first.push_back(m_first.back()); }
	void append(const PieceCorner& c)
	{
		m_corners.push_back(c);
		++m_first.back();
	}

	/// Forgets the pieces for which \p kept(piece) does not hold.
	template<class Kept>
	void keep(Kept kept)
	{
		int pieces = 0, corners = 0;
		for (int p = 0; p < count(); ++p) {
			const int first = m_first[at(p)], last = m_first[at(p + 1)];
			if (!kept(p))
				continue;
			m_first[at(pieces++)] = corners;
			for (int c = first; c < last; ++c)
				m_corners[at(corners++)] = m_corners[at(c)];
		}
		m_first[at(pieces)] = corners;
		m_first.resize(at(pieces) + 1);
		m_corners.resize(at(corners));
	}

private:
	std::vector<PieceCorner> m_corners;
	std::vector<int> m_first{0};
};

/// Computes the pieces. Integers decide which edges cross where, see commonRefinement().
OverlayPieces divideStartTriangles(const FlippedSurface& surface, const OverlayListener& listener);

/// Integers decide how the triangulations lie on each other, so this is a fault of the program.
inline constexpr const char* kInconsistentOverlay =
	"The overlay of the triangulations is inconsistent: choose the output 'Keep the mesh' with the "
	"surgery 'None' or 'Edge swap', and report the mesh.";

/// A face and weights of the origins of its halfedges.
struct InFace
{
	int face = -1;
	std::array<double, 3> weight{0, 0, 0};
};

/// The point on halfedge \p h of \p t at \p x, a share of its length, from its origin.
InFace pointOnSide(const Triangulation& t, int h, double x);

} // namespace ricci

#endif
