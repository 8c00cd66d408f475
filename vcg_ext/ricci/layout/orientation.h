// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_ORIENTATION_H
#define RICCI_ORIENTATION_H

#include "planar_layout.h"

namespace ricci {

/// Exact sign of the oriented area of the triangle abc as given: 1 counter-clockwise, -1 clockwise,
/// 0 collinear. Filtered; falls back to exact expansions (Shewchuk 1997).
int orientation(const Point2& a, const Point2& b, const Point2& c);

} // namespace ricci

#endif
