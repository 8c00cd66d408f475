// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FLOW_CHECK_H
#define RICCI_FLOW_CHECK_H

#include "../flow/ricci_flow.h"

#include <string>

namespace ricci {

/// Checks the metric that the flow found (metric_check.h) against the target that it says it has
/// reached.
/// \param boundary [vertex of the surface on which the flow ran] 1 on its boundary
/// \throw NotConverged
void requireMetric(const FlowResult& flow, const VertexArray<char>& boundary);

/// Sum of |target - K| over the surface, in radians: all of the curvature by which the result
/// misses its target.
double openCurvature(const FlowResult& flow);

/// \param finding what a check of the result found, as in "2 points lie outside the disk"
/// \throw NotConverged always
[[noreturn]] void failCheck(const std::string& finding);

} // namespace ricci

#endif
