// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of what is given back, by other formulas than those that found it.
#ifndef RICCI_CHART_CHECK_H
#define RICCI_CHART_CHECK_H

#include "../flow/ricci_flow.h"
#include "../layout/flat_mesh.h"

#include <cstddef>

namespace ricci {

/// Errors of a chart, found from its triangles alone.
struct ChartCheck
{
	/// Points of the chart in the plane that are not finite, or corners in the disk that are not inside the open
	/// unit disk. Where there are any, nothing else is measured.
	std::size_t outside = 0;

	/// Largest difference of the lengths of the two sides of a seam, or of any edge that two triangles
	/// share: in the plane relative to the extent of the chart, in the disk hyperbolic.
	double seamGap = 0.0;

	/// Triangles that the map flips or flattens although they are higher than the tolerance.
	int flipped = 0;

	double radius = 0.0; ///< disk: largest distance of a point from 0
};

/// Checks a chart in the plane. Orientation is exact.
/// \param tolerance relative to the extent of the chart
ChartCheck checkMap(const FlatMesh& chart, double tolerance);

/// Checks a chart in the Poincaré disk. Lengths are hyperbolic. Orientation is the sign of det(X, Y, Z)
/// on the hyperboloid, and sinh(height) sinh(side) = |det|. The check allows for the rounding of the points
/// to doubles, which near the circle is a large distance.
/// \param tolerance hyperbolic distance
ChartCheck checkDisk(const FlatMesh& chart, double tolerance);

/// Requires that the seams of a chart in the plane fit, and that no triangle is flipped. The curvature
/// that the flow leaves open is allowed for.
/// \param chart of one component
/// \param bent whether flips or splits may bend the triangles of the chart in the metric found, so that
/// their straight images may be flipped
/// \param seamsFit whether the two sides of seams are to fit
/// \throw NotConverged with what was found
void requireMap(const FlatMesh& chart, const FlowResult& flow, bool bent, bool seamsFit = true);

/// The same for a chart in the Poincaré disk, whose points must lie inside it.
/// \throw NotConverged
void requireDisk(const FlatMesh& chart, const FlowResult& flow, bool bent);

} // namespace ricci

#endif
