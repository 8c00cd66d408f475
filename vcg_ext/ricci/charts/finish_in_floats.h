// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FINISH_IN_FLOATS_H
#define RICCI_FINISH_IN_FLOATS_H

#include "../layout/parametrization.h"

#include <functional>

namespace ricci {

/// What finishInFloats() may do, and what it calls for.
struct FloatFinish
{
	/// The triangles are the mesh's own: also mend those of a map that fills the unit square which six decimals
	/// would flip.
	bool forText = true;
	/// Measures the distortion of the map again.
	std::function<void()> measure;
	/// Packs the charts of the map once more.
	std::function<void()> packAgain;
	bool mayCut = true;         ///< else no triangle is cut off
	bool keepsBoundary = false; ///< see RepairRules
};

/// The last look at a packed map, at the coordinates as they will be stored: mends the triangles that are
/// flipped or flat once the coordinates are rounded to float, or lower than a few steps of a float. Points near
/// them move by a few steps, and no others; the report's finishMoved counts them, and where there are any the
/// distortion is measured again. Seams stay isometric, and nothing is made to overlap. A triangle that cannot
/// be mended so is cut off as a chart of its own, as high as floats need, and all are packed again; so are charts
/// that have left their boxes.
/// \param map after packCharts()
/// \throw NotConverged PiecesLost where that would be too many pieces of a refinement
void finishInFloats(const FloatFinish& finish, Parametrization& map);

} // namespace ricci

#endif
