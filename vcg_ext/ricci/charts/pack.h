// SPDX-License-Identifier: GPL-3.0-or-later
// The folder charts: from a map that may cover itself to a packed one, and the last look in floats. The caller's
// numbers come after it. This file: from charts with places of their own each to texture coordinates of all of them.
#ifndef RICCI_PACK_H
#define RICCI_PACK_H

#include "../layout/parametrization.h"
#include "../optimize/repair.h"
#include "../options.h"

#include <cstddef>
#include <utility>

namespace ricci {

/// False if so many charts of any extent cannot keep \p margin, by the area of the margins alone.
bool marginsMayFit(std::size_t charts, double margin);

/// Packs the charts into the unit square: places their bounding boxes beside each other, and scales the smallest square
/// round all boxes with their margins. A chart with a side that may be too short for triangles that have to be given a
/// height (repairInFloats()) gets a wider box. Where so many charts do not fit with the margin, it is halved until they
/// do. Fills Chart::box, and occupancy and margin of the report.
///
/// Charts may be turned as both \p turns and the options allow: those with an uprightTurn() lie along the axes, others
/// in any way. They are placed by their outlines, with the boxes of those that are thin or smaller than a few cells of
/// packOutlines() as one more chart, where the square gets smaller by kWorthTurning. One chart that is not upright is
/// turned as the smallest square round it lies.
///
/// With \p mayCut charts are cut by findCutForPacking() as long as that is worth it (kPackingPrice) and each cut brings
/// kMinRoom besides, and while a square covered by kEnoughCovered would be worth it. After cuts that brought nothing, as many are made before the
/// charts are packed again: packings grow with the logarithm of the cuts. Without turns nothing is cut.
///
/// With PackOptions::tileSide charts are packed into tiles by their outlines, each into the first one in which there is
/// room. With \p mayCut a chart that is too long for a tile is cut by findCutToFit(), and only such a chart.
///
/// Without PackOptions::normalizeUV all this is scaled back to the size that the charts had. A single chart then is not
/// turned.
/// \throw InvalidOption ChartMargin, TileSide for a chart that is too long and cannot be cut, more than
/// kMaxTiles tiles, or tiles too large for floats; InvalidMesh BeyondFloats if coordinates that keep their scale are too
/// large or too small for float, in which they will be stored
void packCharts(
	Parametrization& map, const PackOptions& options, ChartTurns turns, bool mayCut = false);

/// A cut that brings less than kMinRoom is not worth a chart more. Of a square that is covered by kEnoughCovered
/// little is left to win: cuts end where that much would not be worth them. Cuts in a row that bring nothing and whose
/// prices together are kMaxLoss are not made up for by further ones.
///
/// At kPackingPrice charts cover 0.61 of the square in the mean of 79 meshes. Beside a price of 2.3 (0.596), at which a
/// scan in one or two charts was never cut, this cost 0.15 % of the objective and four charts in a thousand.
constexpr double kMinRoom = 0.015, kEnoughCovered = 0.75, kMaxLoss = 0.03;

/// Places the unit disks of the charts, as the hyperbolic layout leaves them, in equal squares, row by
/// row from the origin, which together lie in [0, 1]^2, and moves the charts there. Fills Chart::box.
void placeDisks(Parametrization& map);

/// What repairInFloats() may do.
struct FloatRules
{
	/// The triangles are the mesh's own, not pieces of a refinement: those of a map that fills the unit square which
	/// six decimals would flip are mended, too, and all that are lost are cut off, however many.
	bool keepsMesh = true;
	bool mayCut = true; ///< else no triangle is cut off
	BoundaryRepair boundary = BoundaryRepair::Free;
	bool mayGrow = true; ///< whether charts may leave their boxes, and be packed again
};

/// The last look at a packed map, at the coordinates as they will be stored: mends the triangles that are
/// flipped or flat once the coordinates are rounded to float, or lower than a few steps of a float. Points near
/// them move by a few steps, and no others. Seams stay isometric, and nothing is made to overlap. A triangle that
/// cannot be mended so is cut off as a chart of its own, as high as floats need.
/// \param map after packCharts()
/// \return how many points have moved, and whether charts have left their boxes, or triangles have become charts, so
/// that all have to be packed again
/// \throw NotConverged PiecesLost where that would be too many pieces of a refinement
std::pair<int, bool> repairInFloats(const FloatRules& rules, Parametrization& map);

} // namespace ricci

#endif
