// SPDX-License-Identifier: GPL-3.0-or-later
#include "parameters.h"

#include "error_sentences.h"

#include <ricci/base/numbers.h>
#include <ricci/charts/pack.h>
#include <ricci/parametrize.h>

#include <cmath>
#include <string>

namespace filter_ricci {

namespace {

// The order of each list is that of the enum of the same name in ricci/options.h.
QStringList targetCurvatureChoices()
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

QStringList coneRoundingChoices()
{
	return {"Free", "Multiples of pi/2"};
}

QStringList methodChoices()
{
	return {"Intrinsic flips", "Fixed triangles", "Edge swaps", "Thurston"};
}

// The hyperbolic flow has no edge swaps and no Thurston packing.
QStringList hyperbolicMethodChoices()
{
	return methodChoices().mid(0, 2);
}

QStringList outputTriangulationChoices()
{
	return {"Keep the mesh", "Common refinement"};
}

QStringList finishChoices()
{
	return {"None", "Repair", "Least distortion", "Least stretch"};
}

// The hyperbolic flow has no map of least distortion or stretch.
QStringList hyperbolicFinishChoices()
{
	return finishChoices().mid(0, 2);
}

QStringList holesChoices()
{
	return {"Boundaries", "Capped", "Short ones capped"};
}

QStringList seamsChoices()
{
	return {"Shortest", "Existing texture seams", "Selected edges", "Border of selected faces"};
}

QStringList hyperbolicTargetChoices()
{
	return {"Hyperbolic metric", "Cones at selected vertices", "From vertex quality"};
}

QStringList chartsChoices()
{
	return {"As the flow has them", "Without overlap", "Without overlap, cut for room"};
}

template<class Enum>
void readChoice(
	const RichParameterList& par, const char* id, const QStringList& choices, Enum& value)
{
	const int chosen = par.getEnum(id);
	if (chosen >= 0 && chosen < choices.size()) {
		value = static_cast<Enum>(chosen);
		return;
	}
	std::string uses;
	for (int i = 0; i < choices.size(); ++i) {
		if (i > 0)
			uses += i + 1 == choices.size() ? " or " : ", ";
		uses += std::to_string(i) + " (" + choices[i].toStdString() + ")";
	}
	throw Refusal(
		"The value " + std::to_string(chosen) + " of {" + id + "} is not one of its choices. Use " +
		uses + ".");
}

double number(const RichParameterList& par, const char* id)
{
	return static_cast<double>(par.getFloat(id));
}

double checkedTimeLimit(const RichParameterList& par)
{
	const double seconds = number(par, "time_limit");
	if (std::isfinite(seconds) && seconds >= 0.0)
		return seconds;
	throw Refusal(
		"The value " + ricci::numberText(seconds, 6) +
		" of {time_limit} cannot be used. Use a number of seconds, or 0 for no limit.");
}

TextureSettings checkedTexture(const RichParameterList& par)
{
	TextureSettings texture;
	texture.file = host::text(par, "carry_texture");
	texture.size = par.getInt("texture_size");
	if (texture.size != 0 && (texture.size < kMinTextureSize || texture.size > kMaxTextureSize))
		throw Refusal(
			"The value " + std::to_string(texture.size) +
			" of {texture_size} cannot be used. Use " + std::to_string(kMinTextureSize) + " to " +
			std::to_string(kMaxTextureSize) + " texels, or 0 for as many as keep the old ones.");
	return texture;
}

RunSettings readRunSettings(const RichParameterList& par)
{
	RunSettings settings;
	readChoice(par, "seams", seamsChoices(), settings.seams);
	settings.colorize = par.getBool("colorize");
	settings.flatLayer = par.getBool("flat_layer");
	settings.timeLimit = checkedTimeLimit(par);
	settings.report = host::text(par, "report");
	settings.texture = checkedTexture(par);
	return settings;
}

void readFlowOptions(
	const RichParameterList& par,
	const QStringList& methods,
	const QStringList& finishes,
	ricci::FlowOptions& flow)
{
	flow.epsilon = number(par, "epsilon");
	readChoice(par, "method", methods, flow.method);
	readChoice(par, "output_triangulation", outputTriangulationChoices(), flow.output);
	readChoice(par, "finish", finishes, flow.finish);
}

constexpr double kDegree = ricci::kPi / 180.0;

/// The disk cannot show more rings than this.
constexpr int kMaxRings = 20;

RichEnum outputTriangulationParameter(ricci::OutputTriangulation chosen)
{
	return RichEnum(
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

const char* const kFinishTip =
	"Repairs faces that would come out flipped%1. Only for the method 'Intrinsic flips'.";

RichBool colorizeParameter()
{
	return RichBool(
		"colorize",
		false,
		"Colour by distortion",
		"Colour the vertices from blue (angles kept) over cyan, green and yellow to red (the 99th "
		"percentile over the faces, and more).");
}

/// The last parameters of both filters: files to write, and how accurate and how long a run may be.
void addFilesAndLimits(RichParameterList& list, double epsilon)
{
	list.addParam(host::advanced<host::FileToSave>(
		"carry_texture",
		QString(),
		"PNG image (*.png)",
		"Carry the texture over to",
		"A PNG file that gets what the mesh shows now, its textures or else its colours, drawn "
		"for the new texture coordinates. Empty: no texture."));
	list.addParam(host::advanced<RichInt>(
		"texture_size",
		TextureSettings().size,
		"Size of that texture",
		"Width and height of the new texture, 16 to 16384 texels. 0: as fine as the old ones."));
	list.addParam(host::advanced<host::FileToSave>(
		"report",
		QString(),
		"Page and its data (*.html);;Data alone (*.csv)",
		"Report file",
		"A report of the run: a page with diagrams and its data beside it (.html), or the data "
		"alone (.csv). Empty: no report."));
	list.addParam(host::advanced<RichFloat>(
		"epsilon",
		static_cast<Scalarm>(epsilon),
		"Epsilon (rad)",
		"The flow stops when the curvature of every vertex is this close to its target, in "
		"radians, or at the floor that rounding sets."));
	list.addParam(host::advanced<RichFloat>(
		"time_limit",
		static_cast<Scalarm>(0),
		"Time limit (seconds)",
		"A run that takes longer ends with an error and leaves the mesh as it was. 0: no limit."));
}

// What a first run needs comes first, and what few runs need after it.
RichParameterList euclideanParameters()
{
	const ricci::Options defaults;
	RichParameterList list;
	list.addParam(RichEnum(
		"target_curvature",
		static_cast<int>(defaults.target),
		targetCurvatureChoices(),
		"Target curvature",
		"What the flow is asked to reach. <b>Automatic</b> suits most meshes: it places cones "
		"where areas would change much."));
	list.addParam(RichBool(
		"free_boundary",
		defaults.freeBoundary,
		"Free boundary",
		"The boundary keeps its lengths, but for what the finish changes. Not read for Disk, "
		"Rectangle and the flat annulus."));
	list.addParam(RichFloat(
		"cone_distortion",
		static_cast<Scalarm>(defaults.cones.distortion),
		"Cones: area distortion",
		"0: the cones that are worth their seams. Above 0: so many that areas change by less than "
		"this (0.25: by a quarter)."));
	list.addParam(RichEnum("seams", 0, seamsChoices(), kSeamsName, kSeamsTip));
	list.addParam(outputTriangulationParameter(defaults.output));
	list.addParam(RichFloat(
		"chart_margin",
		static_cast<Scalarm>(Flow::Params().chartMargin),
		"Margin of the charts",
		"Room round each chart, as a share of the side of the square, for baking. 0.004: 4 pixels "
		"of 1024, 8 of 2048."));
	list.addParam(colorizeParameter());
	list.addParam(RichBool(
		"flat_layer",
		false,
		"Flat mesh as new layer",
		"Add a layer with the mesh laid out in the plane, cut along its seams."));
	list.addParam(host::advanced<RichEnum>(
		"holes",
		static_cast<int>(defaults.holes),
		holesChoices(),
		"Holes",
		"Boundary loops other than the longest: boundaries too, or <b>Capped</b> for the flow, so "
		"that the chart goes round them without seams. <b>Short ones capped</b>: those within a "
		"tenth of the root of the area, even if all are."));
	list.addParam(host::advanced<RichFloat>(
		"seam_hiding",
		static_cast<Scalarm>(defaults.seamHiding),
		"Seams: hide in hollows",
		"0: the seams are as short as can be. Up to 1: an edge on a ridge counts up to ten "
		"times its length, so that seams run through hollows."));
	list.addParam(host::advanced<RichInt>(
		"cone_count",
		defaults.cones.count,
		"Cones: number",
		"The number of placed cones. 0: as many as 'Cones: area distortion' asks for."));
	list.addParam(host::advanced<RichEnum>(
		"cone_rounding",
		static_cast<int>(defaults.cones.rounding),
		coneRoundingChoices(),
		"Cones: curvatures",
		"<b>Free</b>: those that change areas least. <b>Multiples of pi/2</b>: as "
		"quadrangulations need them; all seams then differ by quarter turns."));
	list.addParam(host::advanced<RichEnum>(
		"method",
		static_cast<int>(defaults.method),
		methodChoices(),
		"Method",
		"If a triangle breaks, <b>intrinsic flips</b> or the paper's <b>edge swaps</b> give the "
		"flow others, and <b>fixed triangles</b> end with an error; the mesh is never changed. "
		"<b>Thurston</b>: the conventional flow on the mesh's triangles, to compare with."));
	list.addParam(host::advanced<RichEnum>(
		"finish",
		static_cast<int>(defaults.finish),
		finishChoices(),
		"Finish",
		QString(kFinishTip)
			.arg(", and on 'Keep the mesh' gives the mesh the least mean conformal distortion, or "
				 "the <b>least stretch</b>, of lengths too: best on chosen seams, whose sides then "
				 "differ")));
	list.addParam(host::advanced<RichEnum>(
		"charts",
		static_cast<int>(defaults.charts),
		chartsChoices(),
		"Charts",
		"<b>Without overlap</b>: charts that cover a part of the plane twice are cut apart along "
		"the shortest lines. <b>Cut for room</b>: with <b>Automatic</b>, also a chart that fills "
		"little of the square, where the room is worth the seam."));
	list.addParam(host::advanced<RichBool>(
		"normalize_uv",
		Flow::Params().normalizeUV,
		"Fit into the unit square",
		"Scale the texture coordinates uniformly into [0,1] x [0,1]. Off: they keep the scale "
		"of the metric."));
	list.addParam(host::advanced<RichBool>(
		"sphere_layer",
		false,
		"Sphere as new layer",
		"Add a layer with the mesh mapped conformally to the unit sphere. Only for one closed "
		"surface of genus 0."));
	addFilesAndLimits(list, defaults.epsilon);
	return list;
}

RichParameterList hyperbolicParameters()
{
	const ricci::HyperbolicOptions defaults;
	RichParameterList list;
	list.addParam(RichEnum(
		"target_curvature",
		static_cast<int>(defaults.target),
		hyperbolicTargetChoices(),
		"Target curvature",
		"The curvature at the vertices, beyond the constant -1 of the triangles. <b>Hyperbolic "
		"metric</b>: none, for surfaces of negative Euler characteristic."));
	list.addParam(RichFloat(
		"cone_angle",
		static_cast<Scalarm>(defaults.coneAngle / kDegree),
		"Cone angle (degrees)",
		"The sum of the angles at each selected vertex, for 'Cones at selected vertices'. 360 "
		"is no cone."));
	list.addParam(outputTriangulationParameter(defaults.output));
	list.addParam(colorizeParameter());
	list.addParam(RichBool(
		"flat_layer",
		false,
		"Disk as new layer",
		"Add a layer with the mesh laid out in the Poincaré disk, cut along its seams."));
	list.addParam(RichInt(
		"universal_cover",
		0,
		"Universal cover (rings)",
		"Add a layer with the mesh in the Poincaré disk and this many rings of copies round it, "
		"which tile the disk. 0: no layer."));
	list.addParam(RichBool(
		"generator_axes",
		false,
		"Axes of the generators",
		"Add a layer with the axes of the canonical generators of the Fuchsian group, as edges. "
		"On the surface they are closed geodesics."));
	list.addParam(RichBool(
		"canonical_polygon",
		false,
		"Canonical polygon",
		"Add a layer with a fundamental polygon of 4 sides for each handle, as edges. Its sides "
		"are geodesics that the canonical generators pair."));
	list.addParam(host::advanced<RichEnum>("seams", 0, seamsChoices(), kSeamsName, kSeamsTip));
	list.addParam(host::advanced<RichBool>(
		"free_boundary",
		defaults.freeBoundary,
		"Free boundary",
		"The circles of the boundary's vertices keep their radii, and the target holds inside "
		"only. Off: the target holds on the boundary too."));
	list.addParam(host::advanced<RichEnum>(
		"method",
		static_cast<int>(defaults.method),
		hyperbolicMethodChoices(),
		"Method",
		"If a triangle breaks, <b>intrinsic flips</b> give the flow others, and <b>fixed "
		"triangles</b> end with an error; the mesh is never changed."));
	list.addParam(host::advanced<RichEnum>(
		"finish",
		static_cast<int>(ricci::Finish::Repair),
		hyperbolicFinishChoices(),
		"Finish",
		QString(kFinishTip).arg("")));
	addFilesAndLimits(list, defaults.epsilon);
	return list;
}

} // namespace

RichParameterList filterParameters(int filter)
{
	return filter == Hyperbolic ? hyperbolicParameters() : euclideanParameters();
}

Settings readSettings(const RichParameterList& par)
{
	Settings settings;
	static_cast<RunSettings&>(settings) = readRunSettings(par);
	readFlowOptions(par, methodChoices(), finishChoices(), settings.flow);
	readChoice(par, "target_curvature", targetCurvatureChoices(), settings.flow.target);
	settings.flow.cones.count = par.getInt("cone_count");
	settings.flow.cones.distortion = number(par, "cone_distortion");
	readChoice(par, "cone_rounding", coneRoundingChoices(), settings.flow.cones.rounding);
	settings.flow.freeBoundary = par.getBool("free_boundary");
	settings.flow.seamHiding = number(par, "seam_hiding");
	settings.flow.normalizeUV = par.getBool("normalize_uv");
	settings.flow.chartMargin = number(par, "chart_margin");
	readChoice(par, "holes", holesChoices(), settings.flow.holes);
	readChoice(par, "charts", chartsChoices(), settings.flow.charts);
	settings.sphereLayer = par.getBool("sphere_layer");
	if (!settings.texture.file.trimmed().isEmpty() && !settings.flow.normalizeUV)
		throw Refusal("{carry_texture} draws on the unit square: choose {normalize_uv}, or leave "
					  "{carry_texture} empty.");
	ricci::checkOptions(settings.flow);
	ricci::checkChartMargin(settings.flow.chartMargin);
	return settings;
}

HyperbolicSettings readHyperbolicSettings(const RichParameterList& par)
{
	HyperbolicSettings settings;
	static_cast<RunSettings&>(settings) = readRunSettings(par);
	readFlowOptions(par, hyperbolicMethodChoices(), hyperbolicFinishChoices(), settings.flow);
	readChoice(par, "target_curvature", hyperbolicTargetChoices(), settings.flow.target);
	settings.flow.coneAngle = number(par, "cone_angle") * kDegree;
	settings.flow.freeBoundary = par.getBool("free_boundary");
	settings.coverRings = par.getInt("universal_cover");
	if (settings.coverRings < 0 || settings.coverRings > kMaxRings)
		throw Refusal(
			"The value " + std::to_string(settings.coverRings) +
			" of {universal_cover} cannot be used. Use 0 to " + std::to_string(kMaxRings) +
			" rings.");
	settings.axes = par.getBool("generator_axes");
	settings.canonicalPolygon = par.getBool("canonical_polygon");
	settings.flow.canonicalGenerators = settings.axes || settings.canonicalPolygon;
	ricci::checkOptions(settings.flow);
	return settings;
}

} // namespace filter_ricci
