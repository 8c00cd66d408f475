// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_OVERLAP_CHECK_H
#define RICCI_OVERLAP_CHECK_H

#include "../layout/parametrization.h"

namespace ricci {

/// Triangles that cover a part of the plane together with another one, of their own chart or not, once their
/// coordinates are rounded to float, and the charts that these are in. What is covered no deeper than kTouchingSteps
/// steps of a float is what the rounding may have moved.
struct OverlapsInFloats
{
	int faces = 0, charts = 0;
};
OverlapsInFloats overlapsInFloats(const FlatMesh& mesh);

/// The number of edges of seams whose two sides differ in length by more than
/// kUnequalShare of the longer one, once their coordinates are rounded to float, and by more than
/// kTouchingSteps steps of a float, which the rounding may have changed them by. A texture that should go on
/// across such a seam is torn there.
int unequalSeams(const FlatMesh& mesh);

/// The same in the hyperbolic metric, for charts in the disks that placeDisks() has placed: towards the border of
/// its disk a step of a float is a longer way.
int unequalSeamsInDisk(const Parametrization& map);

constexpr double kTouchingSteps = 4.0, kUnequalShare = 1e-3;

} // namespace ricci

#endif
