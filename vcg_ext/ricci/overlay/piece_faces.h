// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PIECE_FACES_H
#define RICCI_PIECE_FACES_H

#include "overlay_pieces.h"

#include <array>

namespace ricci {

/// A corner of a piece, or the side from there to the next corner.
struct PieceSide
{
	int piece = -1, corner = -1;

	bool isValid() const { return piece >= 0; }
};

/// Pieces, their neighbours across their sides, and the triangles in which they lie.
struct LinkedPieces
{
	OverlayPieces pieces;

	/// [side] The pieces on both sides of it, the lower one first; the second is none on the border.
	Array<std::array<PieceSide, 2>> links;
	Array<Face> inputFace; ///< [piece]
	Array<Face> endFace;   ///< [piece]

	const PieceCorner& at(const PieceSide& side) const { return pieces(side.piece, side.corner); }
};

/// Finds the neighbours and the triangles of all pieces, then forgets the pieces that do not lie in
/// the first \p keptFaces faces of the input.
/// \throw InternalError if a piece has no triangle: a fault of the program
LinkedPieces linkPieces(
	OverlayPieces pieces, const Triangulation& input, const Triangulation& end, int keptFaces);

/// A corner of a piece in the piece's end triangle.
/// \throw InternalError if the corner is not in that triangle: a fault of the program
FaceWeights
inEndTriangle(const LinkedPieces& linked, const Triangulation& end, int piece, int corner);

} // namespace ricci

#endif
