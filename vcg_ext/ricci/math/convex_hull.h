// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONVEX_HULL_H
#define RICCI_CONVEX_HULL_H

#include "points.h"

#include <cstddef>
#include <vector>

namespace ricci {

/// Corners of the convex hull, counter-clockwise and no three of them on a line (monotone chain
/// [Andrew 1979]).
std::vector<Point2> convexHull(std::vector<Point2> points);

/// A convex polygon round a convex \p polygon, both counter-clockwise: as long as it has more than
/// \p maxCorners, at least 4, its neighbours are prolonged past the side that adds the least area.
/// Rounding may leave a corner more, or outside by few steps of a double of its largest coordinate.
std::vector<Point2> enclosingPolygon(std::vector<Point2> polygon, std::size_t maxCorners);

} // namespace ricci

#endif
