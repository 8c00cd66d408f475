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

#include <cmath>

namespace ricci {

namespace {

void checkFlowOptions(const FlowOptions& options)
{
	if (!(options.epsilon > 0.0 && std::isfinite(options.epsilon)))
		throw InvalidOption(InvalidOption::Epsilon, options.epsilon);
	if (options.maxIterations < 1)
		throw InvalidOption(InvalidOption::MaxIterations, options.maxIterations);
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
	const AnyOptions& options,
	std::vector<std::string> notes,
	Progress& progress)
{
	progress.step(0.0, "Checking the mesh");
	Parametrization result;
	result.notes = std::move(notes);
	const std::vector<Component> components =
		startResult(mesh, options, options.output, progress, result);
	VertexInput ofCopies = input;
	extendToCopies(result.opened, ofCopies.selected);
	extendToCopies(result.opened, ofCopies.targetCurvature);
	runComponents(
		result.opened, components, progress, [&](const Component& component, ProgressRange range) {
			append(
				component,
				flattenComponent(component, ofCopies, options, range),
				options.output,
				result);
		});
	result.report.converged = true;
	progress.step(kComponentsDone, "Measuring the distortion");
	return result;
}

} // namespace

void checkOptions(const Options& options)
{
	const bool exact = options.surgery == Surgery::IntrinsicFlips &&
					   options.packing == PackingScheme::InversiveDistance;
	if (options.output == OutputTriangulation::CommonRefinement && !exact)
		throw InvalidOption(InvalidOption::RefinementOfThurston);
	if (options.holes == Holes::Capped && !exact)
		throw InvalidOption(InvalidOption::CapsWithoutFlips);
	checkFlowOptions(options);
	if (options.coneCount < 0)
		throw InvalidOption(InvalidOption::ConeCount, options.coneCount);
	if (!(options.coneDistortion > 0.0 && std::isfinite(options.coneDistortion)))
		throw InvalidOption(InvalidOption::ConeDistortion, options.coneDistortion);
	if (!(options.seamHiding >= 0.0 && options.seamHiding <= 1.0))
		throw InvalidOption(InvalidOption::SeamHiding, options.seamHiding);
}

void checkOptions(const HyperbolicOptions& options)
{
	if (options.surgery == Surgery::EdgeSwap || options.packing == PackingScheme::Thurston)
		throw InvalidOption(InvalidOption::HyperbolicSurgery);
	if (options.output == OutputTriangulation::CommonRefinement &&
		options.surgery != Surgery::IntrinsicFlips)
		throw InvalidOption(InvalidOption::RefinementWithoutFlips);
	checkFlowOptions(options);
}

Parametrization parametrizeEuclidean(
	const SurfaceMesh& given, const VertexInput& input, const Options& asked, Progress& progress)
{
	checkOptions(asked);
	Options options = asked;
	std::vector<std::string> notes;
	if (options.packing == PackingScheme::Thurston && options.surgery == Surgery::IntrinsicFlips) {
		// Flips need circles that do not overlap.
		options.surgery = Surgery::None;
		notes.push_back("The Thurston packing runs on the mesh's own triangles, without flips.");
	}
	Parametrization result = mapComponents(given, input, options, std::move(notes), progress);
	const SurfaceMesh& mesh = result.opened.mesh;
	if (isFinished(options) && options.resolveOverlap && !result.isRefined())
		turnOver(mesh, result);
	measureResult(mesh, measureDistortion, result);
	const Tick tick = [&] { progress.step(kMeasured, "Looking for charts that overlap"); };
	tick();
	const bool turns = options.coneRounding != ConeRounding::QuarterTurns;
	separateCharts(mesh, options.resolveOverlap, turns, tick, result);
	result.report.seamLengthRelative =
		result.report.seamLength / std::sqrt(surfaceArea(mesh.positions, mesh.triangles));
	if (options.resolveOverlap)
		requireSeparateCharts(mesh, result, tick);
	progress.step(1.0, "Layout done");
	return result;
}

Parametrization parametrizeHyperbolic(
	const SurfaceMesh& given,
	const VertexInput& input,
	const HyperbolicOptions& options,
	Progress& progress)
{
	checkOptions(options);
	Parametrization result = mapComponents(given, input, options, {}, progress);
	const SurfaceMesh& mesh = result.opened.mesh;
	result.report.charts = static_cast<int>(result.charts.size());
	result.report.seamLengthRelative =
		result.report.seamLength / std::sqrt(surfaceArea(mesh.positions, mesh.triangles));
	measureResult(mesh, measureHyperbolicDistortion, result);
	progress.step(1.0, "Layout done");
	return result;
}

} // namespace ricci
