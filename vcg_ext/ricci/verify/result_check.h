// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of what is given back, by other formulas than those that found it. All throw NotConverged,
// with what they found, where the result fails.
#ifndef RICCI_RESULT_CHECK_H
#define RICCI_RESULT_CHECK_H

#include "../flow/ricci_flow.h"
#include "../layout/flat_mesh.h"

namespace ricci {

/// Checks a chart in the plane (map_check.h): its seams fit, and no triangle is flipped. The curvature
/// that the flow leaves open is allowed for.
/// \param chart of one component
/// \param bent whether flips or splits may bend the triangles of the chart in the metric found, so that
/// their straight images may be flipped
/// \param seamsFit whether the two sides of seams are to fit
/// \throw NotConverged
void requireMap(const FlatMesh& chart, const FlowResult& flow, bool bent, bool seamsFit = true);

/// The same for a chart in the Poincaré disk (disk_check.h), whose points must lie inside it.
/// \throw NotConverged
void requireDisk(const FlatMesh& chart, const FlowResult& flow, bool bent);

} // namespace ricci

#endif
