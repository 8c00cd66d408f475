// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_OVERLAP_CHECK_H
#define RICCI_OVERLAP_CHECK_H

#include "../layout/parametrization.h"

namespace ricci {

/// Sets the report's overlappingFaces and overlappingCharts: the triangles that cover a part of the plane
/// together with another one, of their own chart or not, once their coordinates are rounded to float, and the
/// charts that these are in. What is covered no deeper than kTouchingSteps steps of a float is what the
/// rounding may have moved.
void countOverlaps(Parametrization& map);

/// Sets the report's unequalSeams: the edges of seams whose two sides differ in length by more than
/// kUnequalShare of the longer one, once their coordinates are rounded to float, and by more than
/// kTouchingSteps steps of a float, which the rounding may have changed them by. A texture that should go on
/// across such a seam is torn there.
void countUnequalSeams(Parametrization& map);

/// The same in the hyperbolic metric, for charts in the disks that placeDisks() has placed: towards the border of
/// its disk a step of a float is a longer way.
void countUnequalSeamsInDisk(Parametrization& map);

constexpr double kTouchingSteps = 4.0, kUnequalShare = 1e-3;

} // namespace ricci

#endif
