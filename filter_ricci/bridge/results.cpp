// SPDX-License-Identifier: GPL-3.0-or-later
#include "results.h"

#include <algorithm>
#include <ios>
#include <optional>
#include <sstream>

namespace filter_ricci {

namespace {

void addIfPresent(Results& results, const char* key, const std::optional<double>& value)
{
	if (value)
		results.emplace_back(key, *value);
}

std::string keyValueLine(Results::const_iterator begin, Results::const_iterator end)
{
	std::ostringstream line;
	line.precision(10);
	line << std::boolalpha;
	for (auto result = begin; result != end; ++result) {
		line << (result == begin ? "" : " ") << result->first << "=";
		std::visit([&line](auto value) { line << value; }, result->second);
	}
	return line.str();
}

} // namespace

Results toResults(const ricci::Report& report)
{
	Results results = {
		{"converged", report.converged},
		{"iterations", report.iterations},
		{"max_curvature_error", report.maxCurvatureError},
		{"residual_floor", report.residualFloor},
		{"qc_mean", report.qcMean},
		{"qc_vertex_mean", report.qcVertexMean},
		{"qc_area_mean", report.qcAreaMean},
		{"qc_p99", report.qcP99},
		{"qc_max", report.qcMax},
		{"area_distortion_mean", report.areaDistortionMean},
		{"area_distortion_spread", report.areaDistortionSpread},
		{"flipped_faces", report.flippedFaces},
		{"flipped_by_rounding", report.flippedByRounding},
		{"flips", report.flips},
		{"refinement_points", report.refinementPoints},
		{"edge_swaps", report.edgeSwaps},
		{"boundary_splits", report.boundarySplits},
		{"euler_characteristic", report.eulerCharacteristic},
		{"genus", report.genus},
		{"boundary_loops", report.boundaryLoops},
		{"components", report.components},
		{"seam_edges", report.seamEdges},
		{"charts", report.charts},
		{"capped_holes", report.cappedHoles},
		{"overlapping_charts", report.overlappingCharts},
		{"overlapping_faces", report.overlappingFaces},
		{"overlap_cuts", report.overlapCuts}};
	addIfPresent(results, "torus_tau_re", report.torusTauRe);
	addIfPresent(results, "torus_tau_im", report.torusTauIm);
	addIfPresent(results, "annulus_modulus", report.annulusModulus);
	addIfPresent(results, "rectangle_aspect", report.rectangleAspect);
	return results;
}

void addSphereResults(const ricci::SphereMap& sphere, Results& results)
{
	results.emplace_back("sphere_qc_area_mean", sphere.qcAreaMean);
	results.emplace_back("sphere_area_distortion_mean", sphere.areaDistortionMean);
	results.emplace_back("sphere_flipped_faces", sphere.flippedFaces);
}

std::vector<std::string> toLogLines(const Results& results)
{
	const auto split = std::find_if(results.begin(), results.end(), [](const auto& result) {
		return result.first == "euler_characteristic";
	});
	return {
		"Result: " + keyValueLine(results.begin(), split),
		"Surface: " + keyValueLine(split, results.end())};
}

} // namespace filter_ricci
