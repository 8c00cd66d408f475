// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of what is given back, by other formulas than those that found it. All throw NotConverged,
// with what they found, where the result fails.
#ifndef RICCI_RESULT_CHECK_H
#define RICCI_RESULT_CHECK_H

#include "../charts/output_triangles.h"
#include "../charts/parametrization.h"
#include "../flow/ricci_flow.h"
#include "../layout/planar_layout.h"

namespace ricci {

/// Checks a chart in the plane (map_check.h): its seams fit, and no triangle is turned round. The
/// curvature that the flow leaves open is allowed for.
/// \param output of one component
/// \param bent whether flips or splits may bend the triangles of the output in the metric found, so
/// that their straight images may be turned
/// \throw NotConverged
void requireMap(const OutputTriangles& output, const FlowResult& flow, bool bent);

/// The same for a chart in the Poincaré disk (disk_check.h), whose points must lie inside it.
/// \param layout of the same component, with points of the disk
/// \throw NotConverged
void requireDisk(
	const OutputTriangles& output,
	const PlanarLayout& layout,
	const FlowResult& flow,
	bool bent);

/// Checks that the charts contain every triangle of the output once, and that no chart overlaps
/// itself (chart_check.h) by more than kCheckedGap of the largest, those with turned triangles
/// excepted.
/// \throw NotConverged
void requireSeparateCharts(
	const SurfaceMesh& mesh, const Parametrization& map);

} // namespace ricci

#endif
