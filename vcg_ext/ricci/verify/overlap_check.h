// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_OVERLAP_CHECK_H
#define RICCI_OVERLAP_CHECK_H

#include "../charts/parametrization.h"

namespace ricci {

/// Sets the report's overlappingFaces and overlappingCharts: the triangles that cover a part of the plane
/// together with another one, of their own chart or not, once their coordinates are rounded to float, and the
/// charts that these are in. What is covered no deeper than kTouchingSteps steps of a float is what the
/// rounding may have moved.
void countOverlaps(Parametrization& map);

constexpr double kTouchingSteps = 4.0;

} // namespace ricci

#endif
