// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FLOW_CHECK_H
#define RICCI_FLOW_CHECK_H

#include "../flow/ricci_flow.h"

#include <string>
#include <vector>

namespace ricci {

/// Checks the metric that the flow found (metric_check.h) against the target it says it has reached.
/// \param boundary [vertex of the surface] 1 on its boundary
/// \throw NotConverged
void requireMetric(
	Background background, const FlowResult& flow, const std::vector<char>& boundary);

/// Sum of |target - K| over the surface, in radians: what the residual leaves open altogether.
double openCurvature(const FlowResult& flow);

/// \throw NotConverged "The finished map failed its check (\p what) ..."
[[noreturn]] void failCheck(const std::string& what);

} // namespace ricci

#endif
