// SPDX-License-Identifier: GPL-3.0-or-later
#include "parameters.h"

#include "error_sentences.h"

#include <ricci/base/numbers.h>
#include <ricci/charts/pack.h>
#include <ricci/parametrize.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace filter_ricci {

namespace {

using Choices = std::vector<std::string>;

std::string trimmed(const std::string& text)
{
	const char* const blanks = " \t\r\n\f\v";
	const std::size_t from = text.find_first_not_of(blanks);
	return from == std::string::npos ? std::string()
									 : text.substr(from, text.find_last_not_of(blanks) + 1 - from);
}

Choices firstTwo(Choices choices)
{
	choices.resize(2);
	return choices;
}

// The order of each list is that of the enum of the same name in ricci/options.h.
Choices targetCurvatureChoices()
{
	return {
		"Automatic",
		"Flat everywhere",
		"Disk",
		"Rectangle",
		"Cones at selected vertices",
		"From vertex quality",
		"Placed cones"};
}

Choices coneRoundingChoices()
{
	return {"Free", "Multiples of pi/2"};
}

Choices methodChoices()
{
	return {"Intrinsic flips", "Fixed triangles", "Edge swaps", "Thurston"};
}

// The hyperbolic flow has no edge swaps and no Thurston packing.
Choices hyperbolicMethodChoices()
{
	return firstTwo(methodChoices());
}

Choices outputTriangulationChoices()
{
	return {"Keep the mesh", "Common refinement"};
}

Choices finishChoices()
{
	return {"None", "Repair", "Least distortion", "Least stretch"};
}

// The hyperbolic flow has no map of least distortion or stretch.
Choices hyperbolicFinishChoices()
{
	return firstTwo(finishChoices());
}

Choices holesChoices()
{
	return {"Boundaries", "Capped", "Short ones capped"};
}

Choices seamsChoices()
{
	return {"Shortest", "Existing texture seams", "Selected edges", "Border of selected faces"};
}

Choices hyperbolicTargetChoices()
{
	return {"Hyperbolic metric", "Cones at selected vertices", "From vertex quality"};
}

Choices chartsChoices()
{
	return {"As the flow has them", "Without overlap", "Without overlap, cut for room"};
}

template<class Enum>
void readChoice(const Parameters& par, const char* id, Enum& value)
{
	const Choices& choices = findParameter(par, id)->choices;
	const int chosen = valueOf<int>(par, id), count = static_cast<int>(choices.size());
	if (chosen >= 0 && chosen < count) {
		value = static_cast<Enum>(chosen);
		return;
	}
	std::string uses;
	for (int i = 0; i < count; ++i) {
		if (i > 0)
			uses += i + 1 == count ? " or " : ", ";
		uses += std::to_string(i) + " (" + choices[static_cast<std::size_t>(i)] + ")";
	}
	throw Refusal(
		"The value " + std::to_string(chosen) + " of {" + id + "} is not one of its choices. Use " +
		uses + ".");
}

double checkedTimeLimit(const Parameters& par)
{
	const double seconds = valueOf<double>(par, "time_limit");
	if (std::isfinite(seconds) && seconds >= 0.0)
		return seconds;
	throw Refusal(
		"The value " + ricci::numberText(seconds, 6) +
		" of {time_limit} cannot be used. Use a number of seconds, or 0 for no limit.");
}

TextureSettings checkedTexture(const Parameters& par)
{
	TextureSettings texture;
	texture.file = trimmed(valueOf<std::string>(par, "carry_texture"));
	texture.size = valueOf<int>(par, "texture_size");
	if (texture.size != 0 && (texture.size < kMinTextureSize || texture.size > kMaxTextureSize))
		throw Refusal(
			"The value " + std::to_string(texture.size) +
			" of {texture_size} cannot be used. Use " + std::to_string(kMinTextureSize) + " to " +
			std::to_string(kMaxTextureSize) + " texels, or 0 for as many as keep the old ones.");
	return texture;
}

RunSettings readRunSettings(const Parameters& par)
{
	RunSettings settings;
	readChoice(par, "seams", settings.seams);
	settings.colorize = valueOf<bool>(par, "colorize");
	settings.flatLayer = valueOf<bool>(par, "flat_layer");
	settings.timeLimit = checkedTimeLimit(par);
	settings.report = trimmed(valueOf<std::string>(par, "report"));
	settings.texture = checkedTexture(par);
	return settings;
}

void readFlowOptions(const Parameters& par, ricci::FlowOptions& flow)
{
	flow.epsilon = valueOf<double>(par, "epsilon");
	readChoice(par, "method", flow.method);
	readChoice(par, "output_triangulation", flow.output);
	readChoice(par, "finish", flow.finish);
}

constexpr double kDegree = ricci::kPi / 180.0;

/// The disk cannot show more rings than this.
constexpr int kMaxRings = 20;

Parameter
choice(const char* name, int chosen, Choices choices, const char* label, const std::string& tooltip)
{
	return {name, chosen, std::move(choices), label, tooltip, "", false};
}

/// A truth value or a number.
template<class T>
Parameter simple(const char* name, T value, const char* label, const char* tooltip)
{
	return {name, value, {}, label, tooltip, "", false};
}

Parameter file(const char* name, const char* files, const char* label, const char* tooltip)
{
	return {name, std::string(), {}, label, tooltip, files, false};
}

Parameter advanced(Parameter parameter)
{
	parameter.isAdvanced = true;
	return parameter;
}

Parameter outputTriangulationParameter(ricci::OutputTriangulation chosen)
{
	return choice(
		"output_triangulation",
		static_cast<int>(chosen),
		outputTriangulationChoices(),
		"Output triangulation",
		"<b>Common refinement</b>: faces are divided where the flow's edges cross them, so that "
		"the map is exact on every piece.");
}

const char* const kSeamsName = "Seams";
const char* const kSeamsTip = "<b>Shortest</b>, or first where you choose: at texture seams, along "
							  "selected edges ('Select Crease Edges'), or round selected faces.";

std::string finishTip(const std::string& more)
{
	return "Repairs faces that would come out flipped" + more +
		   ". Only for the method 'Intrinsic flips'.";
}

Parameter colorizeParameter()
{
	return simple(
		"colorize",
		false,
		"Colour by distortion",
		"Colour the vertices from blue (angles kept) over cyan, green and yellow to red (the 99th "
		"percentile over the faces, and more).");
}

/// The last parameters of both filters: files to write, and how accurate and how long a run may be.
void addFilesAndLimits(Parameters& list, double epsilon)
{
	list.push_back(advanced(file(
		"carry_texture",
		"PNG image (*.png)",
		"Carry the texture over to",
		"A PNG file that gets what the mesh shows now, its textures or else its colours, drawn "
		"for the new texture coordinates. Empty: no texture.")));
	list.push_back(advanced(simple(
		"texture_size",
		TextureSettings().size,
		"Size of that texture",
		"Width and height of the new texture, 16 to 16384 texels. 0: as fine as the old ones.")));
	list.push_back(advanced(file(
		"report",
		"Page and its data (*.html);;Data alone (*.csv)",
		"Report file",
		"A report of the run: a page with diagrams and its data beside it (.html), or the data "
		"alone (.csv). Empty: no report.")));
	list.push_back(advanced(simple(
		"epsilon",
		epsilon,
		"Epsilon (rad)",
		"The flow stops when the curvature of every vertex is this close to its target, in "
		"radians, or at the floor that rounding sets.")));
	list.push_back(advanced(simple(
		"time_limit",
		0.0,
		"Time limit (seconds)",
		"A run that takes longer ends with an error and leaves the mesh as it was. 0: no limit.")));
}

// What a first run needs comes first, and what few runs need after it.
Parameters euclideanParameters()
{
	const ricci::Options defaults;
	Parameters list;
	list.push_back(choice(
		"target_curvature",
		static_cast<int>(defaults.target),
		targetCurvatureChoices(),
		"Target curvature",
		"What the flow is asked to reach. <b>Automatic</b> suits most meshes: it places cones "
		"where areas would change much."));
	list.push_back(simple(
		"free_boundary",
		defaults.freeBoundary,
		"Free boundary",
		"The boundary keeps its lengths, but for what the finish changes. Not read for Disk, "
		"Rectangle and the flat annulus."));
	list.push_back(simple(
		"cone_distortion",
		defaults.cones.distortion,
		"Cones: area distortion",
		"0: the cones that are worth their seams. Above 0: so many that areas change by less than "
		"this (0.25: by a quarter)."));
	list.push_back(choice("seams", 0, seamsChoices(), kSeamsName, kSeamsTip));
	list.push_back(outputTriangulationParameter(defaults.output));
	list.push_back(simple(
		"chart_margin",
		ricci::PackOptions().chartMargin,
		"Margin of the charts",
		"Room round each chart, as a share of the side of the square, for baking. 0.004: 4 pixels "
		"of 1024, 8 of 2048."));
	list.push_back(colorizeParameter());
	list.push_back(simple(
		"flat_layer",
		false,
		"Flat mesh as new layer",
		"Add a layer with the mesh laid out in the plane, cut along its seams."));
	list.push_back(advanced(choice(
		"holes",
		static_cast<int>(defaults.holes),
		holesChoices(),
		"Holes",
		"Boundary loops other than the longest: boundaries too, or <b>Capped</b> for the flow, so "
		"that the chart goes round them without seams. <b>Short ones capped</b>: those within a "
		"tenth of the root of the area, even if all are.")));
	list.push_back(advanced(simple(
		"seam_hiding",
		defaults.seamHiding,
		"Seams: hide in hollows",
		"0: the seams are as short as can be. Up to 1: an edge on a ridge counts up to ten "
		"times its length, so that seams run through hollows.")));
	list.push_back(advanced(simple(
		"cone_count",
		defaults.cones.count,
		"Cones: number",
		"The number of placed cones. 0: as many as 'Cones: area distortion' asks for.")));
	list.push_back(advanced(choice(
		"cone_rounding",
		static_cast<int>(defaults.cones.rounding),
		coneRoundingChoices(),
		"Cones: curvatures",
		"<b>Free</b>: those that change areas least. <b>Multiples of pi/2</b>: as "
		"quadrangulations need them; all seams then differ by quarter turns.")));
	list.push_back(advanced(choice(
		"method",
		static_cast<int>(defaults.method),
		methodChoices(),
		"Method",
		"If a triangle breaks, <b>intrinsic flips</b> or the paper's <b>edge swaps</b> give the "
		"flow others, and <b>fixed triangles</b> end with an error; the mesh is never changed. "
		"<b>Thurston</b>: the conventional flow on the mesh's triangles, to compare with.")));
	list.push_back(advanced(choice(
		"finish",
		static_cast<int>(defaults.finish),
		finishChoices(),
		"Finish",
		finishTip(
			", and on 'Keep the mesh' gives the mesh the least mean conformal distortion, or "
			"the <b>least stretch</b>, of lengths too: best on chosen seams, whose sides then "
			"differ"))));
	list.push_back(advanced(choice(
		"charts",
		static_cast<int>(defaults.charts),
		chartsChoices(),
		"Charts",
		"<b>Without overlap</b>: charts that cover a part of the plane twice are cut apart along "
		"the shortest lines. <b>Cut for room</b>: with <b>Automatic</b>, also a chart that fills "
		"little of the square, where the room is worth the seam.")));
	list.push_back(advanced(simple(
		"normalize_uv",
		ricci::PackOptions().normalizeUV,
		"Fit into the unit square",
		"Scale the texture coordinates uniformly into [0,1] x [0,1]. Off: they keep the scale "
		"of the metric.")));
	list.push_back(advanced(simple(
		"sphere_layer",
		false,
		"Sphere as new layer",
		"Add a layer with the mesh mapped conformally to the unit sphere. Only for one closed "
		"surface of genus 0.")));
	addFilesAndLimits(list, defaults.epsilon);
	return list;
}

Parameters hyperbolicParameters()
{
	const ricci::HyperbolicOptions defaults;
	Parameters list;
	list.push_back(choice(
		"target_curvature",
		static_cast<int>(defaults.target),
		hyperbolicTargetChoices(),
		"Target curvature",
		"The curvature at the vertices, beyond the constant -1 of the triangles. <b>Hyperbolic "
		"metric</b>: none, for surfaces of negative Euler characteristic."));
	list.push_back(simple(
		"cone_angle",
		defaults.coneAngle / kDegree,
		"Cone angle (degrees)",
		"The sum of the angles at each selected vertex, for 'Cones at selected vertices'. 360 "
		"is no cone."));
	list.push_back(outputTriangulationParameter(defaults.output));
	list.push_back(colorizeParameter());
	list.push_back(simple(
		"flat_layer",
		false,
		"Disk as new layer",
		"Add a layer with the mesh laid out in the Poincaré disk, cut along its seams."));
	list.push_back(simple(
		"universal_cover",
		0,
		"Universal cover (rings)",
		"Add a layer with the mesh in the Poincaré disk and this many rings of copies round it, "
		"which tile the disk. 0: no layer."));
	list.push_back(simple(
		"generator_axes",
		false,
		"Axes of the generators",
		"Add a layer with the axes of the canonical generators of the Fuchsian group, as edges. "
		"On the surface they are closed geodesics."));
	list.push_back(simple(
		"canonical_polygon",
		false,
		"Canonical polygon",
		"Add a layer with a fundamental polygon of 4 sides for each handle, as edges. Its sides "
		"are geodesics that the canonical generators pair."));
	list.push_back(advanced(choice("seams", 0, seamsChoices(), kSeamsName, kSeamsTip)));
	list.push_back(advanced(simple(
		"free_boundary",
		defaults.freeBoundary,
		"Free boundary",
		"The circles of the boundary's vertices keep their radii, and the target holds inside "
		"only. Off: the target holds on the boundary too.")));
	list.push_back(advanced(choice(
		"method",
		static_cast<int>(defaults.method),
		hyperbolicMethodChoices(),
		"Method",
		"If a triangle breaks, <b>intrinsic flips</b> give the flow others, and <b>fixed "
		"triangles</b> end with an error; the mesh is never changed.")));
	list.push_back(advanced(choice(
		"finish",
		static_cast<int>(ricci::Finish::Repair),
		hyperbolicFinishChoices(),
		"Finish",
		finishTip(""))));
	addFilesAndLimits(list, defaults.epsilon);
	return list;
}

} // namespace

Parameters filterParameters(int filter)
{
	return filter == Hyperbolic ? hyperbolicParameters() : euclideanParameters();
}

const Parameter* findParameter(const Parameters& parameters, const std::string& name)
{
	const auto found = std::find_if(
		parameters.begin(), parameters.end(), [&](const Parameter& p) { return p.name == name; });
	return found == parameters.end() ? nullptr : &*found;
}

Settings readSettings(const Parameters& par)
{
	Settings settings;
	static_cast<RunSettings&>(settings) = readRunSettings(par);
	readFlowOptions(par, settings.flow);
	readChoice(par, "target_curvature", settings.flow.target);
	settings.flow.cones.count = valueOf<int>(par, "cone_count");
	settings.flow.cones.distortion = valueOf<double>(par, "cone_distortion");
	readChoice(par, "cone_rounding", settings.flow.cones.rounding);
	settings.flow.freeBoundary = valueOf<bool>(par, "free_boundary");
	settings.flow.seamHiding = valueOf<double>(par, "seam_hiding");
	settings.flow.normalizeUV = valueOf<bool>(par, "normalize_uv");
	settings.flow.chartMargin = valueOf<double>(par, "chart_margin");
	readChoice(par, "holes", settings.flow.holes);
	readChoice(par, "charts", settings.flow.charts);
	settings.sphereLayer = valueOf<bool>(par, "sphere_layer");
	if (!settings.texture.file.empty() && !settings.flow.normalizeUV)
		throw Refusal("{carry_texture} draws on the unit square: choose {normalize_uv}, or leave "
					  "{carry_texture} empty.");
	ricci::checkOptions(settings.flow);
	ricci::checkChartMargin(settings.flow.chartMargin);
	return settings;
}

HyperbolicSettings readHyperbolicSettings(const Parameters& par)
{
	HyperbolicSettings settings;
	static_cast<RunSettings&>(settings) = readRunSettings(par);
	readFlowOptions(par, settings.flow);
	readChoice(par, "target_curvature", settings.flow.target);
	settings.flow.coneAngle = valueOf<double>(par, "cone_angle") * kDegree;
	settings.flow.freeBoundary = valueOf<bool>(par, "free_boundary");
	settings.coverRings = valueOf<int>(par, "universal_cover");
	if (settings.coverRings < 0 || settings.coverRings > kMaxRings)
		throw Refusal(
			"The value " + std::to_string(settings.coverRings) +
			" of {universal_cover} cannot be used. Use 0 to " + std::to_string(kMaxRings) +
			" rings.");
	settings.axes = valueOf<bool>(par, "generator_axes");
	settings.canonicalPolygon = valueOf<bool>(par, "canonical_polygon");
	settings.flow.canonicalGenerators = settings.axes || settings.canonicalPolygon;
	ricci::checkOptions(settings.flow);
	return settings;
}

} // namespace filter_ricci
