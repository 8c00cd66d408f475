// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_check.h"

#include "../base/text.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "metric_check.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace ricci {

void requireMetric(const FlowResult& flow, const VertexArray<char>& boundary)
{
	const CurvatureMap& metric = *flow.metric;
	VertexVector target = VertexVector::Constant(
		metric.triangulation().vertexCount(), std::numeric_limits<double>::quiet_NaN());
	for (const Vertex v : flow.target.curvature.indices())
		if (!flow.target.fixed[v])
			target[v] = flow.target.curvature[v] * (flow.doubled && boundary[v] ? 2.0 : 1.0);
	const MetricCheck check = checkMetric(
		flow.target.background,
		metric.triangulation(),
		metric.delta(),
		flow.u,
		metric.lengths(),
		target);
	// On the boundary of a double the residual counts twice.
	const bool exact = check.lengthError <= kCheckedLength &&
					   check.curvatureError <= 2.0 * flow.residual + kCheckedCurvature;
	if (exact && check.broken > 0)
		throw NotConverged(NotConverged::FlatTriangles, static_cast<std::size_t>(check.broken));
	if (!exact)
		failCheck(
			"curvature " + numberText(check.curvatureError, 3) + " off at one vertex, lengths " +
			numberText(check.lengthError, 3) + ", " + std::to_string(check.broken) +
			" broken triangles");
}

double openCurvature(const FlowResult& flow)
{
	double sum = 0.0;
	for (const Vertex v : flow.target.curvature.indices())
		if (!flow.target.fixed[v])
			sum += std::abs(flow.curvature[v] - flow.target.curvature[v]);
	return sum;
}

void failCheck(const std::string& finding)
{
	throw NotConverged(finding);
}

} // namespace ricci
