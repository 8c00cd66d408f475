// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FINISH_DISKS_H
#define RICCI_FINISH_DISKS_H

#include "../layout/parametrization.h"
#include "../optimize/patches.h"

namespace ricci {

/// Divides the charts in the Poincaré disk that reach too far out for floats: a triangle at the distance r from
/// 0 is drawn e^r times smaller than at 0. The parts are the Voronoi cells of some triangles, the first of which
/// lies in the middle, by the distance in the chart; a new one is added where floats cannot hold a triangle,
/// though they would near 0. The part in the middle keeps the place and the number of the chart. Each other one
/// is a chart in a disk of its own with its middle at 0, see Chart::place. The report counts the charts, and the
/// cuts between them as separateCharts() does.
/// \param map before placeDisks()
/// \return whether charts were divided
bool divideDisks(Parametrization& map);

/// Where a mesh has so many disks, none is divided further: their squares get too small.
constexpr int kMaxDisks = 256;

/// What repairInFloats() does in the plane, for charts in the Poincaré disk before placeDisks(): mends the triangles that are flipped, or that
/// floats cannot hold. Copies of a seam vertex move together, by the isometries that pair the sides
/// (repairInCover()). Disks that overlap themselves as straight triangles are divided (separateDisks()); where
/// triangles are left all the same, they are divided first (divideDisks()), if that leaves fewer. A map that
/// would not have fewer faults stays as it was.
/// \param shapes that triangles keep; OfDrawing for those of a refinement
/// \param freeBoundary whether points of the boundary may move wherever others do not do
/// \return whether points were moved or disks divided
bool finishDisks(RestShapes shapes, bool freeBoundary, Parametrization& map);

} // namespace ricci

#endif
