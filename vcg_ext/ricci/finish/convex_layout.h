// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONVEX_LAYOUT_H
#define RICCI_CONVEX_LAYOUT_H

#include "../math/points.h"
#include "patches.h"

#include <vector>

namespace ricci {

/// A layout of a patch in which no triangle is flipped, whatever their shapes: the longest of its
/// borders lies evenly on the unit circle, and every other point is the mean of its neighbours
/// [Tutte 1963, Floater 2003]. A hole is filled for that by a point that its border is joined to.
/// \return [local point] places; empty for a patch that is no disk with or without holes, or in which
/// two points are joined by more than one edge
std::vector<Point2> convexLayout(const Patch& patch);

} // namespace ricci

#endif
