// SPDX-License-Identifier: GPL-3.0-or-later
#include "../parametrize.h"

#include "../charts/measure_result.h"
#include "../charts/separate_charts.h"
#include "../charts/turn_over.h"
#include "../measure/distortion.h"
#include "../measure/hyperbolic_distortion.h"
#include "../verify/result_check.h"
#include "assemble.h"
#include "flatten_component.h"

#include "../base/task.h"

#include <cmath>

namespace ricci {

namespace {

void checkFlowOptions(const FlowOptions& options)
{
	if (!(options.epsilon > 0.0 && std::isfinite(options.epsilon)))
		throw InvalidOption(InvalidOption::Epsilon, options.epsilon);
	if (options.output == OutputTriangulation::CommonRefinement &&
		options.method != Method::IntrinsicFlips)
		throw InvalidOption(InvalidOption::WithoutFlips);
}

/// Gives copies of vertices the values of their vertices, where there are any.
template<class T>
void extendToCopies(const OpenedMesh& opened, std::vector<T>& values)
{
	for (std::size_t v = values.size(); !values.empty() && v < opened.vertex.size(); ++v)
		values.push_back(values[positionOf(opened.vertex[v])]);
}

/// Maps every component.
template<class AnyOptions>
Parametrization mapComponents(
	const SurfaceMesh& mesh,
	const VertexInput& input,
	const AnyOptions& options)
{
	advance(0.0, "Checking the mesh");
	Parametrization result;
	const std::vector<Component> components =
		startResult(mesh, options, options.output, result);
	VertexInput ofCopies = input;
	extendToCopies(result.opened, ofCopies.selected);
	extendToCopies(result.opened, ofCopies.targetCurvature);
	runComponents(
		result.opened, components, [&](const Component& component) {
			append(
				component,
				flattenComponent(component, ofCopies, options),
				options.output,
				result);
		});
	result.report.converged = true;
	advance(kComponentsDone, "Measuring the distortion");
	return result;
}

} // namespace

void checkOptions(const Options& options)
{
	checkFlowOptions(options);
	if (options.holes == Holes::Capped && options.method != Method::IntrinsicFlips)
		throw InvalidOption(InvalidOption::WithoutFlips);
	if (options.cones.count < 0)
		throw InvalidOption(InvalidOption::ConeCount, options.cones.count);
	if (!(options.cones.distortion > 0.0 && std::isfinite(options.cones.distortion)))
		throw InvalidOption(InvalidOption::ConeDistortion, options.cones.distortion);
	if (!(options.seamHiding >= 0.0 && options.seamHiding <= 1.0))
		throw InvalidOption(InvalidOption::SeamHiding, options.seamHiding);
}

void checkOptions(const HyperbolicOptions& options)
{
	if (options.method == Method::EdgeSwaps || options.method == Method::Thurston)
		throw InvalidOption(InvalidOption::HyperbolicMethod);
	checkFlowOptions(options);
}

Parametrization parametrizeEuclidean(
	const SurfaceMesh& given, const VertexInput& input, const Options& options)
{
	checkOptions(options);
	Parametrization result = mapComponents(given, input, options);
	const SurfaceMesh& mesh = result.opened.mesh;
	const bool separates = options.charts != Charts::OfTheFlow;
	if (isFinished(options) && separates && !result.isRefined())
		turnOver(mesh, result);
	measureResult(mesh, measureDistortion, result);
	advance(kMeasured, "Looking for charts that overlap");
	checkpoint();
	const bool turns = options.cones.rounding != ConeRounding::QuarterTurns;
	separateCharts(mesh, separates, turns, result);
	result.report.seamLengthRelative =
		result.report.seamLength / std::sqrt(surfaceArea(mesh.positions, mesh.triangles));
	if (separates)
		requireSeparateCharts(mesh, result);
	advance(1.0, "Layout done");
	return result;
}

Parametrization parametrizeHyperbolic(
	const SurfaceMesh& given,
	const VertexInput& input,
	const HyperbolicOptions& options)
{
	checkOptions(options);
	Parametrization result = mapComponents(given, input, options);
	const SurfaceMesh& mesh = result.opened.mesh;
	result.report.charts = static_cast<int>(result.charts.size());
	result.report.seamLengthRelative =
		result.report.seamLength / std::sqrt(surfaceArea(mesh.positions, mesh.triangles));
	measureResult(mesh, measureHyperbolicDistortion, result);
	advance(1.0, "Layout done");
	return result;
}

} // namespace ricci
