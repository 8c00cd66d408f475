// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FINISH_IN_FLOATS_H
#define RICCI_FINISH_IN_FLOATS_H

#include "parametrization.h"

#include <functional>

namespace ricci {

/// What finishInFloats() may do, and what it calls for.
struct FloatFinish
{
	/// Also mend the triangles of a map that fills the unit square which six decimals would flip.
	bool forText = true;
	/// Measures the distortion of the map again.
	std::function<void()> measure;
	/// Packs the charts of the map once more: triangles that cannot be mended in the box of their chart
	/// are mended as if the chart were alone, a few times at most. Without it all stay in their boxes.
	std::function<void()> packAgain;
	/// With \p packAgain, too: triangles that cannot be mended so are cut off, as charts of their own.
	bool mayCut = false;
};

/// The last look at a packed map, at the coordinates as they will be stored: mends the triangles that are
/// flipped or flat once the coordinates are rounded to float, or lower than a few steps of a float.
/// Points move by a few steps near these triangles, to floats, and no others; the report's finishMoved
/// counts them, and where there are any the distortion is measured again. No border is made to cross
/// another. Seams stay isometric up to the rounding, but where a triangle can be mended in no other way.
/// \param map after packCharts()
void finishInFloats(const FloatFinish& finish, Parametrization& map);

/// placeDisks(), and the same for the disks, whose seams move by steps of floats like points inside. Where
/// triangles cannot be mended, the disks are divided before they are placed (divideDisks()), if that leaves
/// fewer of them.
/// \return whether points were moved or disks divided
bool placeDisksInFloats(Parametrization& map);

} // namespace ricci

#endif
