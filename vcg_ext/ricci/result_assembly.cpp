// SPDX-License-Identifier: GPL-3.0-or-later
#include "result_assembly.h"

#include "memory.h"
#include "numbers.h"
#include "text.h"

#include <algorithm>
#include <utility>

namespace ricci {

namespace {

/// The refinement as a mesh in space, and which of its faces are reversed.
SurfaceMesh
refinedSurface(const SurfaceMesh& mesh, const Parametrization& result, std::vector<char>& reversed)
{
	SurfaceMesh surface;
	for (const SurfacePoint& p : result.refined.points)
		surface.positions.push_back(placeOnSurface(p, mesh.positions));
	surface.triangles = result.refined.triangles;
	for (int f : result.refined.inputFace)
		reversed.push_back(result.reversed[at(f)]);
	return surface;
}

} // namespace

void checkFlowOptions(const FlowOptions& options)
{
	if (!(options.epsilon > 0.0))
		throw InvalidOption(
			"epsilon must be greater than 0 (radians), not " + numberText(options.epsilon, 6) +
			".");
	if (options.maxIterations < 1)
		throw InvalidOption(
			"max_iterations must be at least 1, not " + std::to_string(options.maxIterations) +
			".");
}

std::vector<Component> startResult(
	const SurfaceMesh& mesh,
	const FlowOptions& options,
	OutputTriangulation output,
	Progress& progress,
	Parametrization& result)
{
	std::vector<Component> components = splitIntoComponents(mesh, result.notes);
	if (options.surgery != Surgery::IntrinsicFlips)
		requireAreaEverywhere(components);
	const bool refined = output == OutputTriangulation::CommonRefinement;
	requireMemory(
		largestComponent(components), mesh.triangles.size(), refined, options.memoryLimit);
	for (const std::string& note : result.notes)
		progress.log(note);
	result.uv.resize(mesh.triangles.size());
	result.reversed.assign(mesh.triangles.size(), 0);
	result.u.assign(mesh.positions.size(), 0.0);
	result.targetCurvature.assign(mesh.positions.size(), 0.0);
	result.report.components = static_cast<int>(components.size());
	for (std::size_t v = 0; refined && v < mesh.positions.size(); ++v) {
		SurfacePoint p;
		p.vertex[0] = static_cast<int>(v);
		result.refined.points.push_back(p);
	}
	return components;
}

void logLengthened(const FlowResult& flow, Interval& interval)
{
	if (flow.history.lengthened > 0.0)
		interval.log(
			"Some faces have no area, or one side a million times shorter than another: the flow "
			"sees every edge longer by " +
			numberText(flow.history.lengthened, 3) + ".");
}

void storeFlow(
	const FlowResult& flow,
	const Component& component,
	const Topology& topology,
	double shift,
	Parametrization& result)
{
	for (std::size_t v = 0; v < component.vertex.size(); ++v) {
		const std::size_t inputVertex = at(component.vertex[v]);
		const auto i = static_cast<Eigen::Index>(v);
		result.u[inputVertex] = flow.u[i] + shift;
		result.targetCurvature[inputVertex] =
			flow.target.fixed[v] ? flow.curvature[i] : flow.target.curvature[i];
	}
	Report& report = result.report;
	report.maxCurvatureError = std::max(report.maxCurvatureError, flow.residual);
	report.residualFloor = std::max(report.residualFloor, flow.floor);
	report.brokenTriangles += flow.metric->brokenTriangles();
	report.flips +=
		static_cast<int>(flow.history.startFlips.size() + flow.history.flowFlips.size());
	report.eulerCharacteristic += topology.eulerCharacteristic;
	report.genus += topology.genus;
	report.boundaryLoops += static_cast<int>(topology.loops.size());
}

void storeCut(const CutGraph& cut, const std::vector<double>& lengths, Report& report)
{
	report.seamEdges += cut.edgeCount;
	for (std::size_t e = 0; e < cut.isCut.size(); ++e)
		report.seamLength += cut.isCut[e] ? lengths[e] : 0.0;
}

CommonRefinement overlayOfFlow(
	const FlowResult& flow,
	Background background,
	const Triangulation& base,
	const std::vector<Point3>& positions,
	std::vector<char> isCut,
	bool endsAtBoundary,
	bool cornersOnly,
	const OverlayListener& listener)
{
	const FlipHistory& history = flow.history;
	FlippedSurface surface;
	surface.input = &history.input;
	surface.startFlips = &history.startFlips;
	surface.start = &history.start.triangulation;
	surface.startLengths = &history.start.lengths;
	surface.startDelta = &history.startDelta;
	surface.startRadii = &history.startRadii;
	surface.flowFlips = &history.flowFlips;
	surface.end = &flow.metric->triangulation();
	surface.endLengths = &flow.metric->lengths();
	surface.endAngles = &flow.metric->angles();
	surface.endU = &flow.u;
	surface.background = background;
	surface.keptFaces = base.faceCount();
	surface.cornersOnly = cornersOnly;
	for (int e = 0; e < base.edgeCount(); ++e)
		if (endsAtBoundary && base.isBoundaryEdge(e))
			isCut[at(e)] = 1;
	isCut.resize(at(history.input.edgeCount()), 0);
	return commonRefinement(surface, positions, isCut, listener);
}

void appendRefinement(
	const CommonRefinement& refinement,
	const Component& component,
	RefinedMesh& refined,
	Chart& chart)
{
	const auto vertexCount = component.vertex.size();
	std::vector<int> pointOfNode(refinement.points.size());
	for (std::size_t i = 0; i < refinement.points.size(); ++i) {
		if (i < vertexCount) {
			pointOfNode[i] = component.vertex[i];
			continue;
		}
		SurfacePoint p = refinement.points[i];
		for (int& v : p.vertex)
			v = component.vertex[at(v)];
		pointOfNode[i] = static_cast<int>(refined.points.size());
		refined.points.push_back(p);
	}
	for (std::size_t f = 0; f < refinement.triangles.size(); ++f) {
		const auto local = at(refinement.inputFace[f]);
		Triangle t = refinement.triangles[f];
		auto uv = refinement.uv[f];
		for (int& v : t)
			v = pointOfNode[at(v)];
		if (component.reversed[local]) {
			std::swap(t[1], t[2]);
			std::swap(uv[1], uv[2]);
		}
		chart.refined.push_back(static_cast<int>(refined.triangles.size()));
		refined.triangles.push_back(t);
		refined.uv.push_back(uv);
		refined.inputFace.push_back(component.face[local]);
	}
}

OutputTriangles
outputOf(const Component& component, const Chart& chart, const Parametrization& result)
{
	OutputTriangles output;
	for (int f : chart.refined) {
		output.triangles.push_back(result.refined.triangles[at(f)]);
		output.plane.push_back(result.refined.uv[at(f)]);
		output.reversed.push_back(result.reversed[at(result.refined.inputFace[at(f)])]);
	}
	if (!chart.refined.empty())
		return output;
	for (std::size_t i = 0; i < component.face.size(); ++i) {
		Triangle t;
		for (std::size_t k = 0; k < 3; ++k)
			t[component.inputCorner(i, k)] = component.triangles[i][k];
		const auto f = at(component.face[i]);
		output.triangles.push_back(t);
		output.plane.push_back(result.uv[f]);
		output.reversed.push_back(result.reversed[f]);
	}
	return output;
}

void measureResult(
	const SurfaceMesh& mesh,
	OutputTriangulation output,
	const Measure& measure,
	Parametrization& result)
{
	Report keptReport = result.report;
	DistortionField distortion = measure(mesh, result.uv, result.reversed, keptReport);
	result.faceQC = std::move(distortion.face);
	result.vertexQC = std::move(distortion.vertex);
	if (output != OutputTriangulation::CommonRefinement) {
		result.report = keptReport;
		return;
	}
	std::vector<char> reversed;
	const SurfaceMesh surface = refinedSurface(mesh, result, reversed);
	distortion = measure(surface, result.refined.uv, reversed, result.report);
	result.refined.faceQC = std::move(distortion.face);
	result.refined.vertexQC = std::move(distortion.vertex);
}

double areaOf(const SurfaceMesh& mesh)
{
	double area = 0.0;
	for (const Triangle& t : mesh.triangles)
		area += triangleArea(
			{mesh.positions[at(t[0])], mesh.positions[at(t[1])], mesh.positions[at(t[2])]});
	return area;
}

} // namespace ricci
