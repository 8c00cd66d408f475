// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline_check.h"

#include "refinement_check.h"
#include "shapes.h"

#include <ricci/error.h>
#include <ricci/pipeline/whole_map.h>
#include <ricci/surface/component.h>
#include <ricci/surface/triangulation.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace ricci::testing {

namespace {

constexpr double kPi = 3.14159265358979323846;

/// Cones of a closed component for each 2 pi of its curvature, and at least: few and strong ones
/// shrink the rest of the surface below what one chart of doubles can hold.
constexpr int kConesPerTurn = 16, kMinCones = 4;

/// Curvature that every component admits, its boundary being free.
std::vector<double> admissibleCurvature(const SurfaceMesh& mesh)
{
	std::vector<double> curvature(mesh.positions.size(), 0.0);
	std::vector<std::string> notes;
	for (const Component& c : splitIntoComponents(openMesh(mesh, notes))) {
		const Triangulation t(c.positions.size(), c.triangles);
		if (!t.boundaryLoops().empty())
			continue;
		const int count = c.vertex.size();
		const int chi = t.eulerCharacteristic();
		const int cones = std::min(chi > 0 ? kMinCones : kConesPerTurn * std::max(1, -chi), count);
		for (int i = 0; i < cones; ++i)
			curvature[at(c.vertex[Vertex(at(i) * at(count) / at(cones))])] = 2 * kPi * chi / cones;
	}
	return curvature;
}

/// The opened mesh with every face turned as the algorithm turned it.
SurfaceMesh coherent(const OpenedMesh& opened)
{
	SurfaceMesh mesh = opened.mesh;
	for (const Face f : opened.reversed.indices())
		if (opened.reversed[f])
			std::swap(mesh.triangles[at(f)][1], mesh.triangles[at(f)][2]);
	return mesh;
}

std::string defectOf(const OpenedMesh& opened, const Parametrization& flat, int& belowResolution)
{
	const Report& report = flat.report;
	const SurfaceMesh input = coherent(opened);
	const FlatMesh& mesh = flat.mesh;
	const std::vector<Triangle2> plane = mesh.corners().values();
	const RefinementCheck check(
		input,
		{mesh.source.values(), mesh.vertices.values(), mesh.face.values(), plane},
		flat.targetCurvature);
	std::vector<char> covered(input.triangles.size(), 0);
	for (int f : mesh.face)
		covered[at(f)] = 1;
	std::string defects;
	const auto require = [&](bool good, const char* name, double value) {
		if (good)
			return;
		char text[80];
		std::snprintf(text, sizeof text, "%s%s %.3g", defects.empty() ? "" : ", ", name, value);
		defects += text;
	};
	require(report.converged, "converged", report.converged);
	require(
		report.maxCurvatureError <= std::max(1e-9, report.residualFloor),
		"residual",
		report.maxCurvatureError);
	require(report.residualFloor <= 1e-8, "floor", report.residualFloor);
	require(report.brokenTriangles == 0, "broken", report.brokenTriangles);
	belowResolution = check.notPositiveByRounding;
	const int flipped = check.notPositive - check.notPositiveByRounding;
	require(flipped == 0, "flipped", flipped);
	require(report.flippedFaces == check.notPositive, "flipped by the report", report.flippedFaces);
	require(check.seamMismatch < 1e-9, "seam mismatch", check.seamMismatch);
	require(check.seamsInside == 0, "seams inside faces", check.seamsInside);
	require(check.minWeight >= -1e-12, "weight", check.minWeight);
	require(check.weightError < 1e-14, "sum of weights", check.weightError);
	require(
		check.eulerCharacteristic == report.eulerCharacteristic,
		"characteristic",
		check.eulerCharacteristic);
	require(check.boundaryLoops == report.boundaryLoops, "boundary loops", check.boundaryLoops);
	const auto lost = std::count(covered.begin(), covered.end(), 0);
	require(lost == 0, "faces lost", static_cast<double>(lost));
	bool finite = true;
	for (const Point2& p : mesh.place)
		finite &= std::isfinite(p[0]) && std::isfinite(p[1]);
	for (double u : flat.u)
		finite &= std::isfinite(u);
	require(finite, "finite", finite);
	return defects;
}

} // namespace

PipelineCheck::PipelineCheck(const SurfaceMesh& mesh)
{
	Options options;
	options.target = TargetCurvature::Prescribed;
	options.freeBoundary = true;
	options.epsilon = 1e-10;
	options.output = OutputTriangulation::CommonRefinement;
	options.charts = Charts::OfTheFlow; // such cuts may cross faces, the flow's own seams may not
	try {
		VertexInput input;
		input.targetCurvature = admissibleCurvature(mesh);
		OpenedMesh opened;
		const Parametrization flat = chartsInPlane(mesh, input, options, opened);
		report = flat.report;
		defect = defectOf(opened, flat, belowResolution);
	}
	catch (const Error& error) {
		refusal = error.what();
	}
}

} // namespace ricci::testing
