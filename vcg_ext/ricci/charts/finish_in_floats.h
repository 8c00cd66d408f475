// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FINISH_IN_FLOATS_H
#define RICCI_FINISH_IN_FLOATS_H

#include "../surface/surface_mesh.h"
#include "parametrization.h"

#include <functional>
#include <vector>

namespace ricci {

/// The last look at a packed map, at the coordinates as they will be stored: mends the triangles of
/// the output that are turned round or flat once the coordinates are rounded to float, or lower than a
/// few steps of a float; and in a map of the mesh's own triangles that fills the unit square, those that
/// six decimals would turn. Points move by a few steps near these triangles, to floats, and no others;
/// the report's finishMoved counts them, and where there are any the distortion is measured again. No
/// border is made to cross another. Seams stay isometric up to the rounding, but where a triangle can
/// be mended in no other way.
/// \param mesh that \p map is the map of
/// \param packAgain packs the charts of \p map once more: triangles that cannot be mended in the box of
/// their chart are mended as if the chart were alone, a few times at most. Without it all stay in their boxes.
/// \param mayCut with \p packAgain, too: triangles that cannot be mended so are cut off, as charts of their own
/// \param map after packCharts()
void finishInFloats(
	const SurfaceMesh& mesh,
	const std::function<void()>& packAgain,
	bool mayCut,
	Parametrization& map);

/// The same for charts in disks, whose seams move by steps of floats like points inside.
/// \param disks [chart] the square that its disk fills, from placeDisks()
void finishInFloats(
	const SurfaceMesh& mesh,
	const std::vector<Box2>& disks,
	Parametrization& map);

} // namespace ricci

#endif
