// SPDX-License-Identifier: GPL-3.0-or-later
#include "assemble.h"

#include "../base/memory_estimate.h"
#include "../base/task.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace ricci {

namespace {

std::size_t largestComponent(const std::vector<Component>& components)
{
	std::size_t largest = 0;
	for (const Component& component : components)
		largest = std::max(largest, component.triangles.size());
	return largest;
}

/// Appends the refinement of one component, in the numbers and the orientation of the opened mesh.
void appendRefinement(
	const CommonRefinement& refinement,
	const Component& component,
	RefinedMesh& refined,
	Chart& chart)
{
	const auto vertexCount = static_cast<std::size_t>(component.vertex.size());
	std::vector<int> number(refinement.points.size());
	for (std::size_t i = 0; i < refinement.points.size(); ++i) {
		if (i < vertexCount) {
			number[i] = component.vertex[Vertex(i)];
			continue;
		}
		SurfacePoint p = refinement.points[i];
		for (int& v : p.vertex)
			v = component.vertex[Vertex(v)];
		number[i] = static_cast<int>(refined.points.size());
		refined.points.push_back(p);
	}
	for (std::size_t f = 0; f < refinement.triangles.size(); ++f) {
		const Face face = refinement.inputFace[f];
		Triangle t = refinement.triangles[f];
		Triangle2 uv = refinement.uv[f];
		for (int& v : t)
			v = number[positionOf(v)];
		if (component.reversed[face]) {
			std::swap(t[1], t[2]);
			std::swap(uv[1], uv[2]);
		}
		chart.refined.push_back(static_cast<int>(refined.triangles.size()));
		refined.triangles.push_back(t);
		refined.uv.push_back(uv);
		refined.inputFace.push_back(component.face[face]);
	}
}

} // namespace

std::vector<Component> startResult(
	const SurfaceMesh& mesh,
	const FlowOptions& options,
	OutputTriangulation output,
	Parametrization& result)
{
	result.opened = openMesh(mesh, result.notes);
	const SurfaceMesh& opened = result.opened.mesh;
	std::vector<Component> components = splitIntoComponents(result.opened);
	if (options.method != Method::IntrinsicFlips)
		requireAreaEverywhere(components);
	const bool refined = output == OutputTriangulation::CommonRefinement;
	requireMemory(
		largestComponent(components), opened.triangles.size(), refined);
	for (const std::string& note : result.notes)
		logLine(note);
	result.uv.resize(opened.triangles.size());
	result.reversed.assign(opened.triangles.size(), 0);
	result.u.assign(opened.positions.size(), 0.0);
	result.targetCurvature.assign(opened.positions.size(), 0.0);
	result.report.cutNonmanifoldEdges = result.opened.cutEdges;
	result.report.splitVertices = result.opened.splitVertices;
	result.report.duplicateFaces = result.opened.duplicateFaces;
	result.report.oneSidedComponents = result.opened.oneSidedComponents;
	result.report.degenerateFaces = static_cast<int>(result.opened.degenerate.size());
	result.report.chosenSeamEdges = result.opened.seamEdges;
	result.report.chosenSeamLength = result.opened.seamLength;
	result.report.seamEdges = result.opened.seamEdgesAdded;
	result.report.seamLength = result.opened.seamLengthAdded;
	result.report.components = static_cast<int>(components.size());
	for (std::size_t v = 0; refined && v < opened.positions.size(); ++v) {
		SurfacePoint p;
		p.vertex[0] = static_cast<int>(v);
		result.refined.points.push_back(p);
	}
	return components;
}

std::vector<char> silentComponents(const std::vector<Component>& components)
{
	std::vector<std::size_t> order(components.size());
	std::iota(order.begin(), order.end(), std::size_t(0));
	const std::size_t described = std::min(kDescribedComponents, order.size());
	std::partial_sort(
		order.begin(),
		order.begin() + static_cast<std::ptrdiff_t>(described),
		order.end(),
		[&](std::size_t a, std::size_t b) {
			const std::size_t m = components[a].triangles.size(),
							  n = components[b].triangles.size();
			return m != n ? m > n : a < b;
		});
	std::vector<char> isSilent(components.size(), 1);
	for (std::size_t i = 0; i < described; ++i)
		isSilent[order[i]] = 0;
	return isSilent;
}

OutputTriangles
outputTriangles(const Component& component, const ComponentMap& map, OutputTriangulation output)
{
	OutputTriangles result;
	const auto add = [&](Triangle t, Triangle2 uv, bool reversed) {
		if (reversed) {
			std::swap(t[1], t[2]);
			std::swap(uv[1], uv[2]);
		}
		result.triangles.push_back(t);
		result.plane.push_back(uv);
		result.reversed.push_back(reversed);
	};
	if (output == OutputTriangulation::CommonRefinement)
		for (std::size_t i = 0; i < map.refinement.triangles.size(); ++i)
			add(map.refinement.triangles[i],
				map.refinement.uv[i],
				component.reversed[map.refinement.inputFace[i]]);
	else
		for (const Face f : map.uv.indices())
			add(component.triangles[positionOf(f)], map.uv[f], component.reversed[f]);
	return result;
}

void append(
	const Component& component,
	const ComponentMap& map,
	OutputTriangulation output,
	Parametrization& result)
{
	Chart chart;
	chart.faces = component.face.values();
	chart.group = map.group;
	if (output == OutputTriangulation::CommonRefinement) {
		appendRefinement(map.refinement, component, result.refined, chart);
		result.report.refinementPoints += static_cast<int>(map.refinement.crossings);
	}
	for (const Face f : map.uv.indices()) {
		const std::size_t face = positionOf(component.face[f]);
		result.reversed[face] = component.reversed[f];
		for (std::size_t k = 0; k < 3; ++k)
			result.uv[face][component.inputCorner(f, k)] = map.uv[f][k];
	}
	const Target& target = map.flow.target;
	const double shift = std::log(map.scale);
	for (const Vertex v : component.vertex.indices()) {
		const std::size_t vertex = positionOf(component.vertex[v]);
		result.u[vertex] = map.flow.u[v] + shift;
		result.targetCurvature[vertex] =
			target.fixed[v] ? map.flow.curvature[v] : target.curvature[v];
	}

	Report& report = result.report;
	for (FlowState state : map.flowStates) {
		state.component = static_cast<int>(result.charts.size());
		report.flowStates.push_back(state);
	}
	result.charts.push_back(std::move(chart));
	report.iterations += map.flow.iterations;
	report.maxCurvatureError = std::max(report.maxCurvatureError, map.flow.residual);
	report.residualFloor = std::max(report.residualFloor, map.flow.floor);
	report.brokenTriangles += map.flow.metric->brokenTriangles();
	report.flips += map.flow.flipCount();
	report.finishMoved += map.finishMoved;
	report.edgeSwaps += map.edgeSwaps;
	report.boundarySplits += map.boundarySplits;
	report.eulerCharacteristic += map.type.eulerCharacteristic();
	report.genus += map.type.genus;
	report.boundaryLoops += map.type.boundaryLoops;
	report.cappedHoles += map.cappedHoles;
	report.cones += static_cast<int>(std::count(map.cones.begin(), map.cones.end(), 1));
	report.seamEdges += map.cut.edgeCount;
	report.seamLength += map.seamLength;
	if (report.components == 1) {
		if (map.torusModulus) {
			report.torusTauRe = map.torusModulus->real();
			report.torusTauIm = map.torusModulus->imag();
		}
		report.annulusModulus = map.annulusModulus;
		report.rectangleAspect = map.rectangleAspect;
		const Eigen::MatrixXcd& omega = map.periods.omega;
		for (Eigen::Index i = 0; i < omega.rows(); ++i)
			for (Eigen::Index j = 0; j < omega.cols(); ++j)
				report.periodMatrix.push_back(omega(i, j));
		if (omega.size() > 0)
			report.periodError = map.periods.error;
	}
	if (map.hyperbolicArea)
		report.hyperbolicArea = report.hyperbolicArea.value_or(0.0) + *map.hyperbolicArea;
	if (map.holonomyError)
		report.holonomyError = std::max(report.holonomyError.value_or(0.0), *map.holonomyError);
	if (map.relationError)
		report.relationError = std::max(report.relationError.value_or(0.0), *map.relationError);
}

} // namespace ricci
