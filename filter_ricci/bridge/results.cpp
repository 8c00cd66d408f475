// SPDX-License-Identifier: GPL-3.0-or-later
#include "results.h"

#include <ricci/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

namespace filter_ricci {

namespace {

/// Beyond these a picture on the surface is distorted in a way that is seen at once, or is mostly empty.
constexpr double kDoubtfulAngles = 2.0, kDoubtfulAreas = 4.0, kDoubtfulOccupancy = 0.1;

/// Of texture_scale.
constexpr double kCoarser = 0.9;

/// Rows without blanks, so that a line of pairs stays easy to take apart.
std::string keyValueLine(Results::const_iterator begin, Results::const_iterator end)
{
	std::string line;
	for (auto result = begin; result != end; ++result) {
		const std::string text = valueText(result->value, ",");
		const bool isRow = std::holds_alternative<std::vector<double>>(result->value);
		line +=
			(result == begin ? "" : " ") + result->key + "=" + (isRow ? "[" + text + "]" : text);
	}
	return line;
}

template<class T>
T resultOf(const Results& results, const char* key)
{
	for (const auto& [name, value, label] : results)
		if (name == key)
			return std::get<T>(value);
	throw std::logic_error(std::string("There is no result ") + key + ".");
}

} // namespace

Results toResults(const ricci::Report& report)
{
	Results results = {
		{"converged", report.converged, "Converged"},
		{"iterations", report.iterations, "Newton steps"},
		{"max_curvature_error", report.maxCurvatureError, "Largest error of the curvature (rad)"},
		{"residual_floor", report.residualFloor, "Least error that rounding allows (rad)"},
		{"lengthened", report.lengthened, "Largest share added to an edge of faces without area"},
		{"qc_mean", report.qcMean, "Angle distortion, mean over faces (1: none)"},
		{"qc_vertex_mean", report.qcVertexMean, "Angle distortion, mean over vertices"},
		{"qc_area_mean", report.qcAreaMean, "Angle distortion, mean by area"},
		{"qc_p99", report.qcP99, "Angle distortion, 99th percentile"},
		{"qc_max", report.qcMax, "Angle distortion, largest"},
		{"area_distortion_mean",
		 report.areaDistortionMean,
		 "Area distortion, mean factor (1: none)"},
		{"area_distortion_spread",
		 report.areaDistortionSpread,
		 "Area distortion, spread of the logarithm"},
		{"flipped_faces", report.flippedFaces, "Faces flipped or without area"},
		{"flipped_by_rounding", report.flippedByRounding, "Further faces flipped as floats"},
		{"finish_moved", report.finishMoved, "Points moved by the repair"},
		{"ended_early", report.endedEarly, "Searches stopped at their work limit"},
		{"flips", report.flips, "Edge flips"},
		{"refinement_points", report.refinementPoints, "Points added by the refinement"},
		{"edge_swaps", report.edgeSwaps, "Edges swapped"},
		{"boundary_splits", report.boundarySplits, "Boundary edges split"},
		{"euler_characteristic", report.eulerCharacteristic, "Euler characteristic"},
		{"genus", report.genus, "Genus"},
		{"boundary_loops", report.boundaryLoops, "Boundary loops"},
		{"components", report.components, "Components"},
		{"joined_edges", report.joinedEdges, "Edges of split vertices, joined"},
		{"pieces_apart", report.piecesApart, "Pieces that could be joined so"},
		{"cut_nonmanifold_edges", report.cutNonmanifoldEdges, "Non-manifold edges, cut open"},
		{"split_vertices", report.splitVertices, "Vertices with several places in the map"},
		{"duplicate_faces", report.duplicateFaces, "Faces that duplicate another"},
		{"one_sided_components", report.oneSidedComponents, "One-sided components, cut open"},
		{"degenerate_faces", report.degenerateFaces, "Faces drawn as a segment or a point"},
		{"cones", report.cones, "Cones"},
		{"chosen_seam_edges", report.chosenSeamEdges, "Edges of the chosen seams"},
		{"chosen_seam_length", report.chosenSeamLength, "Length of the chosen seams"},
		{"seam_edges", report.seamEdges, "Edges of the other seams"},
		{"seam_length", report.seamLength, "Length of the other seams"},
		{"seam_length_relative", report.seamLengthRelative, "The same over the root of the area"},
		{"charts", report.charts, "Charts"},
		{"tiles", report.tiles, "Tiles, the squares that hold the charts"},
		{"occupancy", report.occupancy, "Packing efficiency (share of the square covered)"},
		{"capped_holes", report.cappedHoles, "Holes capped"},
		{"overlapping_charts", report.overlappingCharts, "Charts that overlap"},
		{"overlapping_faces", report.overlappingFaces, "Faces that overlap"},
		{"unequal_seams", report.unequalSeams, "Seam edges whose two sides differ in length"},
		{"overlap_cuts", report.overlapCuts, "Edges cut to separate charts"}};
	const auto add = [&](const char* key, const std::optional<double>& value, const char* label) {
		if (value)
			results.push_back({key, *value, label});
	};
	add("stretch", report.stretch, "Stretch, mean by area (4: none)");
	add("objective", report.objective, "Stretch plus the cost of the seams");
	if (report.targetUsed)
		results.push_back(
			{"target_used", static_cast<int>(*report.targetUsed), "Target used, by its number"});
	add("expected_spread", report.expectedSpread, "Expected spread of areas");
	add("boundary_ratio_min", report.boundaryRatioMin, "Boundary edges: least change of length");
	add("boundary_ratio_max", report.boundaryRatioMax, "Boundary edges: largest change of length");
	add("torus_tau_re", report.torusTauRe, "Modulus of the torus, real part");
	add("torus_tau_im", report.torusTauIm, "Modulus of the torus, imaginary part");
	add("annulus_modulus", report.annulusModulus, "Modulus of the annulus");
	add("rectangle_aspect", report.rectangleAspect, "Longer over shorter side of the rectangle");
	add("holonomy_error", report.holonomyError, "Largest error of a quarter turn (rad)");
	if (!report.periodMatrix.empty()) {
		std::vector<double> numbers;
		for (const std::complex<double>& entry : report.periodMatrix)
			numbers.insert(numbers.end(), {entry.real(), entry.imag()});
		results.push_back({"period_matrix", std::move(numbers), "Period matrix"});
	}
	add("period_error", report.periodError, "Bound of its error");
	add("hyperbolic_area", report.hyperbolicArea, "Hyperbolic area");
	if (report.hyperbolicArea)
		results.push_back(
			{"left_out_components",
			 report.leftOutComponents,
			 "Components without a hyperbolic metric, beside the disk"});
	add("relation_error", report.relationError, "Largest gap where the layout should close up");
	return results;
}

void addPlacedCones(const ricci::Parametrization& map, Results& results)
{
	if (map.placedCones.empty())
		return;
	std::vector<double> vertices, curvatures;
	for (const int v : map.placedCones) {
		vertices.push_back(v);
		curvatures.push_back(map.targetCurvature[static_cast<std::size_t>(v)]);
	}
	results.push_back({"cone_vertices", std::move(vertices), "Vertices of the placed cones"});
	results.push_back(
		{"cone_curvatures", std::move(curvatures), "Curvatures of the placed cones (rad)"});
}

void addSphereResults(const ricci::SphereMap& sphere, Results& results)
{
	results.insert(
		results.end(),
		{{"sphere_qc_area_mean", sphere.qcAreaMean, "Sphere: angle distortion, mean by area"},
		 {"sphere_area_distortion_mean",
		  sphere.areaDistortionMean,
		  "Sphere: area distortion, mean factor"},
		 {"sphere_flipped_faces", sphere.flippedFaces, "Sphere: faces flipped"}});
}

void addGenerators(const ricci::FuchsianGroup& group, Results& results)
{
	std::vector<double> high, low;
	for (const ricci::ExtendedIsometry& g : group.generators())
		for (const ricci::DoubleDouble& x : {g.a.real(), g.a.imag(), g.b.real(), g.b.imag()}) {
			high.push_back(x.high);
			low.push_back(x.low);
		}
	results.push_back({"generators", std::move(high), "Generators of the Fuchsian group"});
	results.push_back(
		{"generators_low", std::move(low), "The same, their digits beyond those of a double"});
	results.push_back({"generators_error", group.relationError, "Error of their relation"});
}

std::string toSentence(int filter, const Results& results)
{
	const auto count = [](int n, const std::string& of) {
		return (n == 0 ? "no" : std::to_string(n)) + " " + of + (n == 1 ? "" : "s");
	};
	const int charts = resultOf<int>(results, "charts");
	const int overlapping = resultOf<int>(results, "overlapping_faces");
	const int tiles = resultOf<int>(results, "tiles");
	std::string text =
		filter == Hyperbolic
			? count(charts, "chart") + " in the unit disk"
			: count(charts, "chart") + " (UV islands) " + (charts == 1 ? "fills " : "fill ") +
				  std::to_string(std::lround(100.0 * resultOf<double>(results, "occupancy"))) +
				  " % of " + (tiles > 1 ? std::to_string(tiles) + " tiles" : "the square");
	text +=
		", with " + count(resultOf<int>(results, "cones"), "cone") +
		(overlapping > 0 ? ", " + count(overlapping, "overlapping face") : "") + " and " +
		count(
			resultOf<int>(results, "flipped_faces") + resultOf<int>(results, "flipped_by_rounding"),
			"flipped face") +
		".";
	return text + " The mean angle distortion is " +
		   ricci::numberText(resultOf<double>(results, "qc_area_mean"), 4) +
		   " (1: none), the mean area distortion " +
		   ricci::numberText(resultOf<double>(results, "area_distortion_mean"), 4) + ".";
}

std::string toReason(const Results& results, const std::string& choice)
{
	return (choice.empty() ? "" : "Automatic chose " + choice + ". ") + "The curvature is within " +
		   ricci::numberText(resultOf<double>(results, "max_curvature_error"), 2) +
		   " rad of its target after " +
		   ricci::counted(
			   static_cast<std::size_t>(resultOf<int>(results, "iterations")),
			   "Newton step",
			   "Newton steps") +
		   ".";
}

std::vector<std::string> doubts(int filter, const Results& results, const Parameters& par)
{
	const auto is = [&](const char* id, auto choice) {
		return valueOf<int>(par, id) == static_cast<int>(choice);
	};
	const double qc = resultOf<double>(results, "qc_area_mean");
	const bool areGiven = filter == Euclidean && is("charts", ricci::Charts::AsGiven);
	const std::string given = "Charts are kept as they were: choose other {charts} for new ones.";
	std::vector<std::string> lines;
	if (qc > kDoubtfulAngles)
		lines.push_back(
			"This map is probably not usable: angles are distorted by " + ricci::numberText(qc, 3) +
			" on average. " +
			(areGiven ? given
			 : !is("method", ricci::Method::IntrinsicFlips)
				 ? "The method 'Intrinsic flips' avoids this."
			 : is("output_triangulation", ricci::OutputTriangulation::CommonRefinement)
				 ? "Seams that you choose may avoid this."
				 : "The output 'Common refinement' mostly avoids this, and so does remeshing that "
				   "removes sliver triangles ('Remeshing: Isotropic Explicit Remeshing')."));
	for (const auto& [key, value, label] : results)
		if (key == "texture_scale" && std::get<double>(value) < kCoarser)
			lines.push_back(
				"The new texture is coarser than the old ones: it has " +
				ricci::numberText(std::get<double>(value), 2) +
				" of their texels per unit of length. " +
				(valueOf<int>(par, "texture_size") == 0
					 ? "It already has the largest size."
					 : "{texture_size} 0 keeps their resolution."));
	if (filter == Hyperbolic)
		return lines; // a hyperbolic metric has areas of its own
	const double padding = resultOf<double>(results, "padding_pixels");
	if (padding < 0.999 * valueOf<int>(par, "padding"))
		lines.push_back(
			"The charts are " + ricci::numberText(padding, 3) + " pixels apart, not {padding} " +
			std::to_string(valueOf<int>(par, "padding")) +
			": there are too many, or it is more than a quarter of the texture. Raise "
			"{texture_size}.");
	const bool isAutomatic = is("target_curvature", 0);
	const double areas = resultOf<double>(results, "area_distortion_mean");
	const double occupancy = resultOf<double>(results, "occupancy");
	const int overlapping = resultOf<int>(results, "overlapping_faces");
	if (overlapping > 0 && (areGiven || is("target_curvature", ricci::TargetCurvature::Disk) ||
							is("target_curvature", ricci::TargetCurvature::Rectangle)))
		lines.push_back(
			"This map is probably not usable: " + std::to_string(overlapping) + " faces overlap. " +
			(areGiven ? given
					  : "'Disk' and 'Rectangle' give one chart, which is never cut: "
						"'Automatic' cuts charts that overlap."));
	if (areas > kDoubtfulAreas)
		lines.push_back(
			"This map is probably not usable: areas change by a factor of " +
			ricci::numberText(areas, 3) + " on average. " +
			(areGiven ? given
			 : isAutomatic || is("target_curvature", 6)
				 ? "{cone_distortion} 0.25 adds cones, which reduce this."
				 : "The target 'Automatic' places cones, which reduce this."));
	if (occupancy < kDoubtfulOccupancy && valueOf<double>(par, "texel_density") == 0.0)
		lines.push_back(
			"This map is probably not usable: its charts cover " +
			ricci::numberText(100.0 * occupancy, 2) + " % of the square. " +
			(areGiven ? given
			 : isAutomatic && is("charts", ricci::Charts::CutForPacking)
				 ? "Chosen seams ({seams}) divide it into charts that pack better."
				 : "The target 'Automatic' with the charts 'Without overlap, cut for packing' "
				   "divides "
				   "it into charts that pack better."));
	return lines;
}

std::vector<std::string> ignored(int filter, const Results& results, const Parameters& par)
{
	const auto isSet = [&](const std::string& id) {
		return findParameter(par, id)->value != findParameter(filterParameters(filter), id)->value;
	};
	const auto is = [&](const char* id, auto choice) {
		return valueOf<int>(par, id) == static_cast<int>(choice);
	};
	const int loops = resultOf<int>(results, "boundary_loops");
	std::vector<std::string> lines;
	std::set<std::string> told;
	const auto tell = [&](const std::string& id, bool hasNoEffect, const std::string& why) {
		if (hasNoEffect && isSet(id) && told.insert(id).second)
			lines.push_back("{" + id + "} has no effect: " + why);
	};
	if (valueOf<std::string>(par, "carry_texture").empty()) {
		const bool isPadded = filter == Euclidean && (valueOf<int>(par, "padding") > 0 ||
													  valueOf<double>(par, "texel_density") > 0.0);
		tell("texture_size", !isPadded, "{carry_texture} is empty.");
		tell("texture_size", isPadded && is("texture_size", 0), "{padding} is of 2048 pixels.");
	}
	const bool areGiven = filter == Euclidean && is("charts", ricci::Charts::AsGiven);
	const bool cutsSharp = !areGiven && is("seams", Seams::Sharp);
	tell("sharp_angle", !cutsSharp, "only the seams 'Sharp edges' read it.");
	tell(
		"seams",
		cutsSharp && resultOf<int>(results, "chosen_seam_edges") == 0,
		"no edge is sharper than {sharp_angle}.");
	tell(
		"finish",
		!is("method", ricci::Method::IntrinsicFlips),
		"it needs the method 'Intrinsic flips'.");
	tell("free_boundary", !areGiven && loops == 0, "the surface is closed.");
	if (filter == Hyperbolic) {
		tell(
			"cone_angle",
			!is("target_curvature", ricci::HyperbolicTarget::SelectedCones),
			"only 'Cones at selected vertices' reads it.");
		return lines;
	}
	if (areGiven) {
		const std::string ofFlow =
			" target_curvature cone_distortion cone_count cone_rounding seam_hiding holes "
			"output_triangulation finish method epsilon free_boundary ";
		const std::string why = "the charts stay as they are.";
		for (const Parameter& p : par)
			tell(p.name, ofFlow.find(" " + p.name + " ") != std::string::npos, why);
		tell("seams", !is("seams", Seams::Texture), why);
		return lines;
	}
	const bool placesCones = is("target_curvature", ricci::TargetCurvature::Automatic) ||
							 is("target_curvature", ricci::TargetCurvature::PlacedCones);
	const bool hasCones = resultOf<int>(results, "cones") > 0;
	const bool isWeighed = std::any_of(results.begin(), results.end(), [](const Result& result) {
		return result.key == "expected_spread";
	});
	for (const char* id : {"cone_count", "cone_distortion", "cone_rounding"})
		tell(id, !placesCones, "only 'Automatic' and 'Placed cones' place cones.");
	tell(
		"cone_distortion",
		valueOf<int>(par, "cone_count") > 0,
		"{cone_count} says how many cones are placed.");
	tell("cone_distortion", !hasCones && !isWeighed, "no cones are placed.");
	for (const char* id : {"cone_count", "cone_rounding"})
		tell(id, !hasCones, "no cones are placed.");
	tell(
		"chart_rotation",
		is("target_curvature", ricci::TargetCurvature::Rectangle),
		"a rectangle stays upright.");
	tell("holes", loops < 2, "there is no hole besides the outer boundary.");
	return lines;
}

double colourRampTop(const Results& results)
{
	return std::max(resultOf<double>(results, "qc_p99"), 1.0 + 1e-6);
}

std::string colourRamp(const Results& results)
{
	return "blue (1: no angle distortion) through cyan, green and yellow to red (" +
		   ricci::numberText(colourRampTop(results), 3) +
		   " or more: the 99th percentile of the faces)";
}

std::string valueText(const Value& value, const char* separator)
{
	if (const bool* const is = std::get_if<bool>(&value))
		return *is ? "true" : "false";
	if (const int* const whole = std::get_if<int>(&value))
		return std::to_string(*whole);
	if (const double* const number = std::get_if<double>(&value))
		return ricci::numberText(*number, 10);
	std::string text;
	for (const double x : std::get<std::vector<double>>(value))
		text += (text.empty() ? "" : separator) +
				ricci::numberText(x, std::numeric_limits<double>::max_digits10);
	return text;
}

std::vector<std::string> toLogLines(const Results& results)
{
	const auto split = std::find_if(results.begin(), results.end(), [](const auto& result) {
		return result.key == "euler_characteristic";
	});
	return {
		"Result: " + keyValueLine(results.begin(), split),
		"Surface: " + keyValueLine(split, results.end())};
}

} // namespace filter_ricci
