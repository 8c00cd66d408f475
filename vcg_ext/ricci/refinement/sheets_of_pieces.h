// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SHEETS_OF_PIECES_H
#define RICCI_SHEETS_OF_PIECES_H

#include "../layout/end_sheets.h"
#include "overlay_pieces.h"

namespace ricci {

/// Whether the side of a piece that begins at this corner is on the cut.
inline bool isOnCut(const PieceCorner& c, const EdgeArray<char>& isCut)
{
	return c.input.isValid() && isCut[c.input.edge()];
}

/// Makes the sheets that belong to the pieces of an overlay, glued along end edges where the pieces
/// meet off the cut. They form a surface without a cut.
/// \param isCut [input edge]
EndSheets
makeSheets(const OverlayPieces& pieces, const FlowResult& flow, const EdgeArray<char>& isCut);

} // namespace ricci

#endif
