// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of what is given back, by other formulas than those that found it.
#ifndef RICCI_MAP_CHECK_H
#define RICCI_MAP_CHECK_H

#include "../base/points.h"
#include "../base/tolerances.h"
#include "../flow/ricci_flow.h"
#include "../layout/flat_mesh.h"
#include "../layout/parametrization.h"
#include "../mesh/surface_mesh.h"

#include <cstddef>
#include <vector>

namespace ricci {

/// Errors of a finished metric, found by other formulas than the flow's.
struct MetricCheck
{
	/// Largest relative difference of an edge's length from Eq. 4, beyond what the rounding of u
	/// explains. The flow adds the excess over the sum of the radii; the check takes, with S =
	/// identity or sinh,
	/// S(l/2)^2 = S((gi - gj)/2)^2 + (1 + I) S(gi) S(gj) / 2.
	double lengthError = 0.0;

	/// Largest |K - target| in radians, beyond what the rounding of the lengths explains. The flow
	/// takes half-angle tangents of tau = g + excess; the check takes, of the lengths a, b, c and
	/// s = (a + b + c) / 2,
	/// sin^2(theta/2) = S(s - b) S(s - c) / (S(b) S(c)).
	double curvatureError = 0.0;

	int broken = 0; ///< triangles that break the triangle inequality
};

/// \param metric its triangles and inversive distances
/// \param u Eq. 6 of \p background
/// \param target radians; NaN where nothing is prescribed
MetricCheck checkMetric(
	Background background,
	const CurvatureMap& metric,
	const VertexVector& u,
	const EdgeArray<double>& lengths,
	const VertexVector& target);

/// Checks the metric that the flow found against the target that it says it has
/// reached.
/// \param boundary [vertex of the surface on which the flow ran] 1 on its boundary
/// \throw NotConverged
void requireMetric(const FlowResult& flow, const VertexArray<char>& boundary);

/// Sum of |target - K| over the surface, in radians: all of the curvature by which the result
/// misses its target.
double openCurvature(const FlowResult& flow);

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

/// Triangles that cover a part of the plane together with another one, of their own chart or not, once their
/// coordinates are rounded to float, and the charts that these are in. What is covered no deeper than kTouchingSteps
/// steps of a float is what the rounding may have moved.
/// \return how many triangles, and how many charts
std::array<int, 2> overlapsInFloats(const FlatMesh& mesh);

/// The number of edges of seams whose two sides differ in length by more than
/// kUnequalShare of the longer one, once their coordinates are rounded to float, and by more than
/// kTouchingSteps steps of a float, which the rounding may have changed them by. A texture that should go on
/// across such a seam is torn there.
int unequalSeams(const FlatMesh& mesh);

/// The same in the hyperbolic metric, for charts in the disks that placeDisks() has placed: towards the border of
/// its disk a step of a float is a longer way.
int unequalSeamsInDisk(const Parametrization& map);

constexpr double kTouchingSteps = kMinFloatSteps, kUnequalShare = 1e-3;

/// Errors of a map to the unit sphere, found from its triangles alone.
struct SphereCheck
{
	double radiusError = 0.0; ///< largest | |p| - 1 |; infinite where a point is not finite

	/// How many times the triangles cover the sphere: the sum of their solid angles, with sign,
	/// over 4 pi, with tan(angle / 2) = det(a, b, c) / (1 + ab + bc + ca)
	/// [van Oosterom Strackee 1983]. A whole number for a closed surface, 1 where its map is one to
	/// one.
	double degree = 0.0;

	int turned = 0; ///< triangles of negative solid angle
};

/// \param triangles corners by vertex; counter-clockwise seen from outside
/// \param sphere [vertex] its image
SphereCheck checkSphere(const std::vector<Triangle>& triangles, const std::vector<Point3>& sphere);

} // namespace ricci

#endif
