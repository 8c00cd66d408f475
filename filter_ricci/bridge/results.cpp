// SPDX-License-Identifier: GPL-3.0-or-later
#include "results.h"

#include <ricci/base/text.h>

#include <algorithm>
#include <complex>
#include <iomanip>
#include <ios>
#include <limits>
#include <locale>
#include <optional>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace filter_ricci {

namespace {

void addIfPresent(Results& results, const char* key, const std::optional<double>& value)
{
	if (value)
		results.emplace_back(key, *value);
}

template<class Number>
void print(std::ostream& line, Number value)
{
	line << value;
}

/// "[x,y,...]", without blanks so that a line of pairs stays easy to take apart. With all digits: they
/// are to compute with.
void print(std::ostream& line, const std::vector<double>& values)
{
	const std::streamsize before = line.precision(std::numeric_limits<double>::max_digits10);
	for (std::size_t i = 0; i < values.size(); ++i)
		line << (i == 0 ? '[' : ',') << values[i];
	line << (values.empty() ? "[]" : "]");
	line.precision(before);
}

std::string keyValueLine(Results::const_iterator begin, Results::const_iterator end)
{
	std::ostringstream line;
	line.imbue(std::locale::classic());
	line.precision(10);
	line << std::boolalpha;
	for (auto result = begin; result != end; ++result) {
		line << (result == begin ? "" : " ") << result->first << "=";
		std::visit([&line](const auto& value) { print(line, value); }, result->second);
	}
	return line.str();
}

template<class Value>
Value valueOf(const Results& results, const char* key)
{
	for (const auto& [name, value] : results)
		if (name == key)
			return std::get<Value>(value);
	throw std::logic_error(std::string("There is no result ") + key + ".");
}

} // namespace

Results toResults(const ricci::Report& report)
{
	Results results = {
		{"converged", report.converged},
		{"iterations", report.iterations},
		{"max_curvature_error", report.maxCurvatureError},
		{"residual_floor", report.residualFloor},
		{"lengthened", report.lengthened},
		{"qc_mean", report.qcMean},
		{"qc_vertex_mean", report.qcVertexMean},
		{"qc_area_mean", report.qcAreaMean},
		{"qc_p99", report.qcP99},
		{"qc_max", report.qcMax},
		{"area_distortion_mean", report.areaDistortionMean},
		{"area_distortion_spread", report.areaDistortionSpread},
		{"flipped_faces", report.flippedFaces},
		{"flipped_by_rounding", report.flippedByRounding},
		{"finish_moved", report.finishMoved},
		{"ended_early", report.endedEarly},
		{"flips", report.flips},
		{"refinement_points", report.refinementPoints},
		{"edge_swaps", report.edgeSwaps},
		{"boundary_splits", report.boundarySplits},
		{"euler_characteristic", report.eulerCharacteristic},
		{"genus", report.genus},
		{"boundary_loops", report.boundaryLoops},
		{"components", report.components},
		{"cut_nonmanifold_edges", report.cutNonmanifoldEdges},
		{"split_vertices", report.splitVertices},
		{"duplicate_faces", report.duplicateFaces},
		{"one_sided_components", report.oneSidedComponents},
		{"degenerate_faces", report.degenerateFaces},
		{"cones", report.cones},
		{"chosen_seam_edges", report.chosenSeamEdges},
		{"chosen_seam_length", report.chosenSeamLength},
		{"seam_edges", report.seamEdges},
		{"seam_length", report.seamLength},
		{"seam_length_relative", report.seamLengthRelative},
		{"charts", report.charts},
		{"occupancy", report.occupancy},
		{"capped_holes", report.cappedHoles},
		{"overlapping_charts", report.overlappingCharts},
		{"overlapping_faces", report.overlappingFaces},
		{"overlap_cuts", report.overlapCuts}};
	addIfPresent(results, "stretch", report.stretch);
	addIfPresent(results, "objective", report.objective);
	addIfPresent(results, "torus_tau_re", report.torusTauRe);
	addIfPresent(results, "torus_tau_im", report.torusTauIm);
	addIfPresent(results, "annulus_modulus", report.annulusModulus);
	addIfPresent(results, "rectangle_aspect", report.rectangleAspect);
	addIfPresent(results, "holonomy_error", report.holonomyError);
	if (!report.periodMatrix.empty()) {
		std::vector<double> numbers;
		for (const std::complex<double>& entry : report.periodMatrix)
			numbers.insert(numbers.end(), {entry.real(), entry.imag()});
		results.emplace_back("period_matrix", std::move(numbers));
	}
	addIfPresent(results, "period_error", report.periodError);
	addIfPresent(results, "hyperbolic_area", report.hyperbolicArea);
	addIfPresent(results, "relation_error", report.relationError);
	return results;
}

void addSphereResults(const ricci::SphereMap& sphere, Results& results)
{
	results.emplace_back("sphere_qc_area_mean", sphere.qcAreaMean);
	results.emplace_back("sphere_area_distortion_mean", sphere.areaDistortionMean);
	results.emplace_back("sphere_flipped_faces", sphere.flippedFaces);
}

void addGenerators(const ricci::FuchsianGroup& group, Results& results)
{
	std::vector<double> high, low;
	for (const ricci::ExtendedIsometry& g : group.generators())
		for (const ricci::DoubleDouble& x : {g.a.real(), g.a.imag(), g.b.real(), g.b.imag()}) {
			high.push_back(x.high);
			low.push_back(x.low);
		}
	results.emplace_back("generators", std::move(high));
	results.emplace_back("generators_low", std::move(low));
	results.emplace_back("generators_error", group.relationError);
}

std::string toSentence(const Results& results)
{
	const int charts = valueOf<int>(results, "charts");
	const int flipped = valueOf<int>(results, "flipped_faces");
	std::ostringstream line;
	line.imbue(std::locale::classic());
	line.precision(2);
	line << "Curvature within " << valueOf<double>(results, "max_curvature_error")
		 << " rad of the target after " << valueOf<int>(results, "iterations")
		 << " Newton steps. Distortion " << std::fixed << std::setprecision(3)
		 << valueOf<double>(results, "qc_area_mean") << " on average (1 keeps all angles), areas "
		 << "by a factor of " << valueOf<double>(results, "area_distortion_mean") << ", " << flipped
		 << (flipped == 1 ? " flipped face, " : " flipped faces, ") << charts
		 << (charts == 1 ? " chart." : " charts.");
	return line.str();
}

double colourRampTop(const Results& results)
{
	return std::max(valueOf<double>(results, "qc_p99"), 1.0 + 1e-6);
}

std::string colourRamp(const Results& results)
{
	return "blue (1: angles kept) over cyan, green and yellow to red (" +
		   ricci::numberText(colourRampTop(results), 3) +
		   " and more: the 99th percentile over the faces)";
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
