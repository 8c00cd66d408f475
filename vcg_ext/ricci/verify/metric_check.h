// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_METRIC_CHECK_H
#define RICCI_METRIC_CHECK_H

#include "../options.h"
#include "../surface/triangulation.h"

#include <Eigen/Core>

#include <vector>

namespace ricci {

/// What a finished metric is worth, found in extended precision and by other formulas than the
/// flow's.
struct MetricCheck
{
	/// Largest relative difference of an edge's length from Eq. 4, past what rounding of u makes of
	/// it. The flow adds the excess over the radii's sum; here, with S = identity or sinh,
	/// S(l/2)^2 = S((gi - gj)/2)^2 + (1 + I) S(gi) S(gj) / 2.
	double lengthError = 0.0;

	/// Largest |K - target| in radians, past what rounding of the lengths makes of the angles. The
	/// flow takes half-angle tangents of tau = g + excess; here sin^2(theta/2) =
	/// S(s - b) S(s - c) / (S(b) S(c)) of the lengths.
	double curvatureError = 0.0;
	int vertex = -1; ///< where that is

	int broken = 0; ///< triangles that break the triangle inequality
};

/// \param delta [edge] inversive distance less one
/// \param u [vertex] Eq. 6 of \p background
/// \param target [vertex] radians; NaN where nothing is prescribed
MetricCheck checkMetric(
	Background background,
	const Triangulation& t,
	const std::vector<double>& delta,
	const Eigen::VectorXd& u,
	const std::vector<double>& lengths,
	const Eigen::VectorXd& target);

} // namespace ricci

#endif
