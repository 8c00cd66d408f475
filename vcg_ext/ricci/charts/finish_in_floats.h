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

/// What finishDisks() has to know.
struct DiskFinish
{
	bool freeBoundary = false;
	bool isRefined = false; ///< the triangles keep their shapes
};

/// The same for charts in the Poincaré disk, before placeDisks(): mends the triangles that are flipped, or that
/// floats cannot hold. Copies of a seam vertex move together, by the isometries that pair the sides
/// (repairInCover()). Disks that overlap themselves as straight triangles are divided (separateDisks()); where
/// triangles are left all the same, they are divided first (divideDisks()), if that leaves fewer. A map that
/// would not have fewer faults stays as it was.
/// \return whether points were moved or disks divided
bool finishDisks(const DiskFinish& finish, Parametrization& map);

} // namespace ricci

#endif
