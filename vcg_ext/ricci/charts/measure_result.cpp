// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure_result.h"

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
	for (const int f : result.refined.inputFace)
		reversed.push_back(result.reversed[positionOf(f)]);
	return surface;
}

} // namespace

void measureResult(const SurfaceMesh& mesh, const Measure& measure, Parametrization& result)
{
	Report keptReport = result.report;
	DistortionField distortion = measure(mesh, result.uv, result.reversed, keptReport);
	result.faceQC = std::move(distortion.face);
	result.vertexQC = std::move(distortion.vertex);
	if (!result.isRefined()) {
		result.report = keptReport;
		return;
	}
	std::vector<char> reversed;
	const SurfaceMesh surface = refinedSurface(mesh, result, reversed);
	distortion = measure(surface, result.refined.uv, reversed, result.report);
	result.refined.faceQC = std::move(distortion.face);
	result.refined.vertexQC = std::move(distortion.vertex);
}

} // namespace ricci
