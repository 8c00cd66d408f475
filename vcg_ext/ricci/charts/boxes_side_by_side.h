// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_BOXES_SIDE_BY_SIDE_H
#define RICCI_BOXES_SIDE_BY_SIDE_H

#include "../base/points.h"

#include <cmath>
#include <vector>

namespace ricci {

/// [box] Translations, never turns or scalings, that bring boxes along the axes close together in about a square and
/// leave at least \p padding >= 0 between any two. One box stays where it is. The boxes are not empty; they may have
/// no width or no height.
std::vector<Point2> sideBySide(std::vector<Box2> boxes, double padding);

/// A length or an area as a share of \p whole, without the digits in which equal ones may differ: for orders that
/// are the same on every machine.
inline double roundedShare(double x, double whole)
{
	return std::round(1e9 * x / whole);
}

} // namespace ricci

#endif
