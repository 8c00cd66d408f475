// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FINISH_IN_FLOATS_H
#define RICCI_FINISH_IN_FLOATS_H

#include "../layout/parametrization.h"

namespace ricci {

/// What repairInFloats() may do.
struct FloatRules
{
	/// The triangles are the mesh's own, not pieces of a refinement: those of a map that fills the unit square which
	/// six decimals would flip are mended, too, and all that are lost are cut off, however many.
	bool keepsMesh = true;
	bool mayCut = true;                                  ///< else no triangle is cut off
	bool keepsBoundary = false, slidesOnCircles = false; ///< see RepairRules
	bool mayGrow = true; ///< whether charts may leave their boxes, and be packed again
};

struct FloatRepair
{
	int moved = 0;             ///< points
	bool needsPacking = false; ///< charts have left their boxes, or triangles have become charts
};

/// The last look at a packed map, at the coordinates as they will be stored: mends the triangles that are
/// flipped or flat once the coordinates are rounded to float, or lower than a few steps of a float. Points near
/// them move by a few steps, and no others. Seams stay isometric, and nothing is made to overlap. A triangle that
/// cannot be mended so is cut off as a chart of its own, as high as floats need.
/// \param map after packCharts()
/// \throw NotConverged PiecesLost where that would be too many pieces of a refinement
FloatRepair repairInFloats(const FloatRules& rules, Parametrization& map);

} // namespace ricci

#endif
