// SPDX-License-Identifier: GPL-3.0-or-later
#include "calls.h"

#include "bytes.h"

#include <ostream>

namespace ricci::testing {

namespace {

void addMesh(const FlatMesh& mesh, Bytes& bytes)
{
	bytes.addAll(mesh.vertices);
	bytes.addAll(mesh.points);
	bytes.addAll(mesh.place);
	bytes.addAll(mesh.chart);
	bytes.addAll(mesh.face);
	for (const SurfacePoint& p : mesh.source) {
		bytes.addAll(p.vertex);
		bytes.addAll(p.weight);
	}
}

} // namespace

std::ostream& operator<<(std::ostream& out, const Call& call)
{
	return out << call.name;
}

Outcome outcomeOf(const Call& call)
{
	if (const auto* options = std::get_if<SphereOptions>(&call.options))
		return {{}, mapToSphere(call.mesh, *options)};
	if (const auto* options = std::get_if<HyperbolicOptions>(&call.options))
		return {parametrizeHyperbolic(call.mesh, call.input, *options), {}};
	return {parametrizeEuclidean(call.mesh, call.input, std::get<Options>(call.options)), {}};
}

std::vector<Figure> figuresOf(const Report& r)
{
	const auto known = [](const auto& value) { return double(value.value_or(-1)); };
	std::vector<Figure> figures{
		{"converged", double(r.converged), Figure::Count},
		{"target_used", r.targetUsed ? double(*r.targetUsed) : -1.0, Figure::Count},
		{"flipped_faces", double(r.flippedFaces), Figure::Count},
		{"flipped_by_rounding", double(r.flippedByRounding), Figure::Count},
		{"broken_triangles", double(r.brokenTriangles), Figure::Count},
		{"euler_characteristic", double(r.eulerCharacteristic), Figure::Count},
		{"genus", double(r.genus), Figure::Count},
		{"boundary_loops", double(r.boundaryLoops), Figure::Count},
		{"components", double(r.components), Figure::Count},
		{"cones", double(r.cones), Figure::Count},
		{"seam_edges", double(r.seamEdges), Figure::Cut},
		{"chosen_seam_edges", double(r.chosenSeamEdges), Figure::Count},
		{"charts", double(r.charts), Figure::Cut},
		{"cut_nonmanifold_edges", double(r.cutNonmanifoldEdges), Figure::Count},
		{"split_vertices", double(r.splitVertices), Figure::Count},
		{"duplicate_faces", double(r.duplicateFaces), Figure::Count},
		{"one_sided_components", double(r.oneSidedComponents), Figure::Count},
		{"degenerate_faces", double(r.degenerateFaces), Figure::Count},
		{"capped_holes", double(r.cappedHoles), Figure::Count},
		{"overlapping_faces", double(r.overlappingFaces), Figure::Count},
		{"overlapping_charts", double(r.overlappingCharts), Figure::Count},
		{"unequal_seams", double(r.unequalSeams), Figure::Count},
		{"overlap_cuts", double(r.overlapCuts), Figure::Cut},
		{"refinement_points", double(r.refinementPoints), Figure::Count},
		{"edge_swaps", double(r.edgeSwaps), Figure::Count},
		{"boundary_splits", double(r.boundarySplits), Figure::Count},
		{"lengthened", r.lengthened, Figure::Measure},
		{"expected_spread", known(r.expectedSpread), Figure::Measure},
		{"boundary_ratio_min", known(r.boundaryRatioMin), Figure::Measure},
		{"boundary_ratio_max", known(r.boundaryRatioMax), Figure::Measure},
		{"qc_mean", r.qcMean, Figure::Measure},
		{"qc_vertex_mean", r.qcVertexMean, Figure::Measure},
		{"qc_area_mean", r.qcAreaMean, Figure::Measure},
		{"qc_p99", r.qcP99, Figure::Measure},
		{"qc_max", r.qcMax, Figure::Measure},
		{"area_distortion_mean", r.areaDistortionMean, Figure::Measure},
		{"area_distortion_spread", r.areaDistortionSpread, Figure::Measure},
		{"stretch", known(r.stretch), Figure::Measure},
		{"objective", known(r.objective), Figure::Cut},
		{"seam_length_relative", r.seamLengthRelative, Figure::Cut},
		{"occupancy", r.occupancy, Figure::Cut},
		{"torus_tau_re", known(r.torusTauRe), Figure::Measure},
		{"torus_tau_im", known(r.torusTauIm), Figure::Measure},
		{"annulus_modulus", known(r.annulusModulus), Figure::Measure},
		{"rectangle_aspect", known(r.rectangleAspect), Figure::Measure},
		{"hyperbolic_area", known(r.hyperbolicArea), Figure::Measure},
		{"iterations", double(r.iterations), Figure::Work},
		{"flips", double(r.flips), Figure::Work},
		{"finish_moved", double(r.finishMoved), Figure::Work},
		{"ended_early", double(r.endedEarly), Figure::Work},
		{"seam_length", r.seamLength, Figure::Length},
		{"chosen_seam_length", r.chosenSeamLength, Figure::Length},
		{"max_curvature_error", r.maxCurvatureError, Figure::Error},
		{"residual_floor", r.residualFloor, Figure::Error},
		{"holonomy_error", known(r.holonomyError), Figure::Error},
		{"period_error", known(r.periodError), Figure::Error},
		{"relation_error", known(r.relationError), Figure::Error}};
	return figures;
}

std::vector<Figure> figuresOf(const SphereMap& map)
{
	return {
		{"flipped_faces", double(map.flippedFaces), Figure::Count},
		{"qc_area_mean", map.qcAreaMean, Figure::Measure},
		{"qc_max", map.qcMax, Figure::Measure},
		{"area_distortion_mean", map.areaDistortionMean, Figure::Measure},
		{"area_distortion_spread", map.areaDistortionSpread, Figure::Measure},
		{"iterations", double(map.iterations), Figure::Work},
		{"max_curvature_error", map.maxCurvatureError, Figure::Error},
		{"offset", map.offset, Figure::Error}};
}

std::vector<Figure> figuresOf(const Outcome& outcome)
{
	return outcome.sphere.positions.empty() ? figuresOf(outcome.map.report)
											: figuresOf(outcome.sphere);
}

std::string bitsOf(const Outcome& outcome)
{
	Bytes bytes;
	for (const Figure& figure : figuresOf(outcome))
		if (figure.kind != Figure::Length)
			bytes.add(figure.value);
	const Parametrization& map = outcome.map;
	addMesh(map.mesh, bytes);
	for (const Chart& chart : map.charts) {
		bytes.add(chart.box);
		bytes.addAll(chart.group.sides);
		bytes.addAll(chart.group.peripheral);
		bytes.addAll(chart.group.handles);
		bytes.add(chart.middle);
	}
	bytes.addAll(map.report.periodMatrix);
	for (const FlowState& state : map.report.flowStates) {
		bytes.add(state.component);
		bytes.add(state.step);
		bytes.add(state.residual);
	}
	bytes.addAll(map.report.choice);
	for (const std::string& note : map.notes)
		bytes.addAll(note);
	bytes.addAll(map.vertexQC);
	bytes.addAll(map.targetCurvature);
	bytes.addAll(map.placedCones);
	bytes.addAll(outcome.sphere.positions);
	bytes.addAll(outcome.sphere.vertex);
	bytes.addAll(outcome.sphere.triangles);
	bytes.add(outcome.sphere.pole);
	return bytes.all;
}

} // namespace ricci::testing
