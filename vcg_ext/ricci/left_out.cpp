// SPDX-License-Identifier: GPL-3.0-or-later
#include "left_out.h"

#include "base/task.h"
#include "error.h"
#include "flatten_steps.h"
#include "hyperbolic/hyperbolic_target.h"
#include "mesh/triangulation.h"
#include "whole_map.h"

#include <cstddef>
#include <exception>
#include <utility>

namespace ricci {

namespace {

/// Half the side of the square in which they lie in the unit disk: that inscribed in it, less a margin.
constexpr double kHalfSquare = 0.7;

/// Why a component has no metric with the target; null where it has one.
std::exception_ptr whyNot(
	const OpenedMesh& opened,
	const Component& component,
	const VertexInput& input,
	const HyperbolicTargetOptions& options)
{
	const Topology topology =
		topologyOf(Triangulation(component.positions.size(), component.triangles));
	try {
		chooseHyperbolicTarget(
			topology, options, targetInput(component, input, component.vertex.size()));
	}
	catch (InadmissibleCurvature& error) {
		nameComponent(opened, component, error);
		if (error.problem == InadmissibleCurvature::HyperbolicSurface ||
			error.problem == InadmissibleCurvature::HyperbolicSum ||
			error.problem == InadmissibleCurvature::FreeBoundary)
			return std::current_exception();
	}
	catch (InvalidOption& error) {
		nameComponent(opened, component, error);
		if (error.problem == InvalidOption::NothingSelected)
			return std::current_exception();
	}
	return nullptr; // any other error is met again, and thrown, where the component is mapped
}

} // namespace

std::vector<Component> leaveOut(
	const OpenedMesh& opened,
	const VertexInput& input,
	const HyperbolicTargetOptions& options,
	std::vector<Component>& components)
{
	std::vector<Component> kept, leftOut;
	if (components.size() == 1)
		return leftOut;
	std::exception_ptr why;
	int largest = 0; // faces
	for (Component& component : components) {
		checkpoint();
		const std::exception_ptr found = whyNot(opened, component, input, options);
		if (found && component.face.size() > largest) {
			largest = component.face.size();
			why = found;
		}
		(found ? leftOut : kept).push_back(std::move(component));
	}
	if (kept.empty())
		std::rethrow_exception(why);
	components = std::move(kept);
	return leftOut;
}

void addBeside(Parametrization leftOut, Parametrization& map)
{
	FlatMesh &mesh = map.mesh, &own = leftOut.mesh;
	for (Point2& p : own.place)
		for (double& x : p)
			x = kHalfSquare * (2.0 * x - 1.0);
	own.across.assign(own.across.size(), Corner());
	own.chart.assign(own.chart.size(), static_cast<int>(map.charts.size()));
	map.charts.emplace_back();
	mesh.append(std::move(own));
	Report& report = map.report;
	for (int Report::*count : std::initializer_list<int Report::*>{
			 &Report::components,
			 &Report::iterations,
			 &Report::flips,
			 &Report::finishMoved,
			 &Report::endedEarly,
			 &Report::eulerCharacteristic,
			 &Report::genus,
			 &Report::boundaryLoops,
			 &Report::seamEdges,
			 &Report::overlapCuts})
		report.*count += leftOut.report.*count;
	report.seamLength += leftOut.report.seamLength;
	report.leftOutComponents = leftOut.report.components;
}

} // namespace ricci
