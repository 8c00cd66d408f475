// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_METRIC_CHECK_H
#define RICCI_METRIC_CHECK_H

#include "../flow/ricci_flow.h"

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
	Vertex vertex; ///< where that is

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

} // namespace ricci

#endif
