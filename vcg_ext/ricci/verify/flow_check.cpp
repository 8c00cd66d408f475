// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_check.h"

#include "../error.h"
#include "../numbers.h"
#include "../text.h"
#include "metric_check.h"

#include <cmath>
#include <limits>

namespace ricci {

namespace {

/// What the check allows beside the residual and what rounding explains: radians, and relative.
constexpr double kCurvature = 1e-8, kLength = 1e-9;

} // namespace

void requireMetric(Background background, const FlowResult& flow, const std::vector<char>& boundary)
{
	const CurvatureMap& metric = *flow.metric;
	Eigen::VectorXd target = Eigen::VectorXd::Constant(
		metric.triangulation().vertexCount(), std::numeric_limits<double>::quiet_NaN());
	for (Eigen::Index v = 0; v < flow.target.curvature.size(); ++v)
		if (!flow.target.fixed[at(v)])
			target[v] = flow.target.curvature[v] * (flow.doubled && boundary[at(v)] ? 2.0 : 1.0);
	const MetricCheck check = checkMetric(
		background, metric.triangulation(), metric.delta(), flow.u, metric.lengths(), target);
	// On the boundary of a double the residual counts twice.
	const bool exact =
		check.lengthError <= kLength && check.curvatureError <= 2.0 * flow.residual + kCurvature;
	if (exact && check.broken > 0)
		throw NotConverged(
			std::to_string(check.broken) + (check.broken == 1 ? " triangle is" : " triangles are") +
			" flat at the end of the flow: the curvature asked for is the limit of what these "
			"triangles reach. Choose the surgery 'Intrinsic flips', or another target_curvature.");
	if (!exact)
		failCheck(
			"curvature " + numberText(check.curvatureError, 3) + " off at one vertex, lengths " +
			numberText(check.lengthError, 3) + ", " + std::to_string(check.broken) +
			" broken triangles");
}

double openCurvature(const FlowResult& flow)
{
	double sum = 0.0;
	for (Eigen::Index v = 0; v < flow.target.curvature.size(); ++v)
		if (!flow.target.fixed[at(v)])
			sum += std::abs(flow.curvature[v] - flow.target.curvature[v]);
	return sum;
}

void failCheck(const std::string& what)
{
	throw NotConverged(
		"The finished map failed its check (" + what +
		"): remesh the worst triangles, and report the mesh.");
}

} // namespace ricci
