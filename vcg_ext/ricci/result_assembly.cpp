// SPDX-License-Identifier: GPL-3.0-or-later
#include "result_assembly.h"

#include "layout/distortion.h"
#include "numbers.h"

#include <utility>

namespace ricci {

void startResult(
	const SurfaceMesh& mesh,
	OutputTriangulation output,
	const std::vector<Component>& components,
	Parametrization& result)
{
	result.uv.resize(mesh.triangles.size());
	result.reversed.assign(mesh.triangles.size(), 0);
	result.u.assign(mesh.positions.size(), 0.0);
	result.targetCurvature.assign(mesh.positions.size(), 0.0);
	result.report.components = static_cast<int>(components.size());
	if (output != OutputTriangulation::CommonRefinement)
		return;
	for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
		SurfacePoint p;
		p.vertex[0] = static_cast<int>(v);
		result.refined.points.push_back(p);
	}
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

void measureRefinement(const SurfaceMesh& mesh, Parametrization& result)
{
	std::vector<char> reversed;
	const SurfaceMesh surface = refinedSurface(mesh, result, reversed);
	DistortionField distortion =
		measureDistortion(surface, result.refined.uv, reversed, result.report);
	result.refined.faceQC = std::move(distortion.face);
	result.refined.vertexQC = std::move(distortion.vertex);
}

} // namespace ricci
