// SPDX-License-Identifier: GPL-3.0-or-later
#include "parameters.h"

#include "sentences.h"

#include <ricci/base/numbers.h>
#include <ricci/base/text.h>
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

QStringList circlePackingChoices()
{
	return {"Inversive distance", "Thurston"};
}

QStringList surgeryChoices()
{
	return {"None", "Edge swap", "Intrinsic flips"};
}

QStringList outputTriangulationChoices()
{
	return {"Keep the mesh", "Common refinement"};
}

QStringList finishChoices()
{
	return {"None", "Repair", "Least distortion"};
}

// The hyperbolic flow has no map of least distortion.
QStringList hyperbolicFinishChoices()
{
	return {"None", "Repair"};
}

QStringList holesChoices()
{
	return {"Boundaries", "Capped"};
}

QStringList hyperbolicTargetChoices()
{
	return {"Hyperbolic metric", "Cones at selected vertices", "From vertex quality"};
}

// The hyperbolic flow has no edge swap.
QStringList hyperbolicSurgeryChoices()
{
	return {"None", "Intrinsic flips"};
}

int checkedChoice(const RichParameterList& par, const char* id, const QStringList& choices)
{
	const int chosen = par.getEnum(id);
	if (chosen >= 0 && chosen < choices.size())
		return chosen;
	std::string uses;
	for (int i = 0; i < choices.size(); ++i) {
		if (i > 0)
			uses += i + 1 == choices.size() ? " or " : ", ";
		uses += std::to_string(i) + " (" + choices[i].toStdString() + ")";
	}
	throw Refusal(
		"The value " + std::to_string(chosen) + " of " + id + " is not one of its choices. Use " +
		uses + ".");
}

double checkedTimeLimit(const RichParameterList& par)
{
	const double seconds = static_cast<double>(par.getFloat("time_limit"));
	if (std::isfinite(seconds) && seconds >= 0.0)
		return seconds;
	throw Refusal(
		"The value " + ricci::numberText(seconds, 6) +
		" of time_limit cannot be used. Use a number of seconds, or 0 for no limit.");
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
		"Where the intrinsic flips differ from the mesh, its own faces only approximate the "
		"map.<br>"
		"<b>Keep the mesh</b>: vertices and faces stay as they are; 'Finish' says what is done "
		"about faces that come out flipped.<br>"
		"<b>Common refinement</b>: faces are divided where the intrinsic edges cross them, so "
		"that the map is exact on every piece and none is flipped. Vertices keep their numbers, "
		"new ones are appended.");
}

const char* const kNoFinish =
	"<b>None</b>: the flow's map is drawn as it is; faces that come out flipped are counted.<br>";
const char* const kRepair =
	"<b>Repair</b>: no face is flipped or without area in the texture coordinates that are "
	"stored; points near such faces move.";

RichEnum finishParameter(ricci::Finish chosen)
{
	return RichEnum(
		"finish",
		static_cast<int>(chosen),
		finishChoices(),
		"Finish",
		QString("What is done to the flow's map before it is stored.<br>") + kNoFinish + kRepair +
			"<br>"
			"<b>Least distortion</b>: repair, and on 'Keep the mesh' the map of least mean "
			"conformal distortion of the mesh's own faces; seams, cones and invariants are "
			"kept.<br>"
			"No effect with 'Thurston', and with another surgery than 'Intrinsic flips'.");
}

RichEnum hyperbolicFinishParameter(ricci::Finish chosen)
{
	return RichEnum(
		"finish",
		chosen == ricci::Finish::None ? 0 : 1,
		hyperbolicFinishChoices(),
		"Finish",
		QString("What is done to the flow's map before it is stored.<br>") + kNoFinish + kRepair +
			"<br>"
			"No effect with another surgery than 'Intrinsic flips'.");
}

RichFloat epsilonParameter(double chosen)
{
	return RichFloat(
		"epsilon",
		static_cast<Scalarm>(chosen),
		"Epsilon (rad)",
		"The flow stops when the curvature of every vertex is this close to its target, in "
		"radians. Where rounding does not allow it, the flow stops at the floor that rounding "
		"sets, and reports that as residual_floor.");
}

RichInt iterationsParameter(int chosen)
{
	return RichInt(
		"max_iterations",
		chosen,
		"Max Newton steps",
		"One solve gives up with an error after this many Newton steps. A run takes fewer than "
		"30 as a rule.");
}

RichFloat timeLimitParameter()
{
	return RichFloat(
		"time_limit",
		0,
		"Time limit (seconds)",
		"A run that takes longer ends with an error and leaves the mesh as it was. It is looked at "
		"between stages and at every Newton step, so that large meshes can take somewhat longer. "
		"0: "
		"no limit.");
}

RichBool colorizeParameter()
{
	return RichBool(
		"colorize",
		false,
		"Colour by distortion",
		"Colour the vertices by their quasi-conformal distortion: from 1 (no distortion) to the "
		"99th percentile over the faces.");
}

RichString reportParameter()
{
	return RichString(
		"report",
		QString(),
		"Report file",
		"A file for a report of the run: a page with diagrams and tables if its name ends in "
		".html, with the data beside it as .csv, or the data alone if it ends in .csv. Without a "
		"folder it lies beside the mesh. A file of that name is replaced. Empty: no report.");
}

RichParameterList euclideanParameters()
{
	const ricci::Options defaults;
	RichParameterList list;
	list.addParam(RichEnum(
		"target_curvature",
		static_cast<int>(defaults.target),
		targetCurvatureChoices(),
		"Target curvature",
		"The Gaussian curvature that the flow is asked to reach.<br>"
		"<b>Automatic</b>: an annulus and a torus become flat, any other surface with boundary "
		"keeps the metric of its boundary, unless areas change much without cones: then they get "
		"placed cones. Other closed surfaces always get them.<br>"
		"<b>Flat everywhere</b>: zero at every vertex, boundary included; for an annulus or a "
		"torus.<br>"
		"<b>Disk</b>: the image of a disk-like surface is a round disk.<br>"
		"<b>Rectangle</b>: the image of a disk-like surface is a rectangle; select its four "
		"corners on the boundary, or none to have them chosen.<br>"
		"<b>Cones at selected vertices</b>: the selected vertices share the total curvature "
		"equally, all others are flat.<br>"
		"<b>From vertex quality</b>: each vertex's quality is its curvature in radians.<br>"
		"<b>Placed cones</b>: a few vertices chosen so that areas change little carry the "
		"curvature; the parameters 'Cones: ...' say how many and how strong."));
	list.addParam(RichBool(
		"free_boundary",
		defaults.freeBoundary,
		"Free boundary",
		"The boundary keeps the metric that it has on the mesh, and the target curvature holds "
		"inside only: the least distortion for a surface with boundary. Disk, Rectangle and the "
		"flat annulus prescribe the boundary and ignore this. No effect on closed surfaces."));
	list.addParam(outputTriangulationParameter(defaults.output));
	list.addParam(finishParameter(defaults.finish));
	list.addParam(RichEnum(
		"holes",
		static_cast<int>(defaults.holes),
		holesChoices(),
		"Holes",
		"What the boundary loops other than the longest are.<br>"
		"<b>Boundaries</b>: boundary like the longest one, with seams that join them: less "
		"distortion.<br>"
		"<b>Capped</b>: each is closed by a flat cap that takes part in the flow and is not "
		"written, so that the chart goes round the holes in one piece, without seams to them. "
		"It needs 'Intrinsic flips' and 'Inversive distance'."));
	list.addParam(RichBool(
		"resolve_overlap",
		defaults.resolveOverlap,
		"Cut charts that overlap",
		"A chart can cover a part of the plane twice although none of its triangles is turned "
		"round. Such charts are cut further, along the shortest lines that part what overlaps, "
		"into charts that do not; all others stay as they are. Off: they are counted only."));
	list.addParam(RichInt(
		"cone_count",
		defaults.coneCount,
		"Cones: number",
		"The number of placed cones. 0: as many as it takes to reach 'Cones: area distortion'. "
		"Read by <b>Placed cones</b>, and by <b>Automatic</b> where it places cones."));
	list.addParam(RichFloat(
		"cone_distortion",
		static_cast<Scalarm>(defaults.coneDistortion),
		"Cones: area distortion",
		"Cones are added until the expected area_distortion_spread is below this: the standard "
		"deviation of the logarithm of the change of areas. 0.5 means that areas typically are "
		"50% larger or smaller than on average. With 'Intrinsic flips' areas are measured after "
		"the flow, which runs again with other cones where they change more. Above 1 it also is "
		"the spread up to which <b>Automatic</b> does without cones. Read where the number of "
		"cones is 0."));
	list.addParam(RichEnum(
		"cone_rounding",
		static_cast<int>(defaults.coneRounding),
		coneRoundingChoices(),
		"Cones: curvatures",
		"<b>Free</b>: the curvatures that change areas least.<br>"
		"<b>Multiples of pi/2</b>: as quadrangulations need them. The two sides of every "
		"seam then differ by quarter turns, round handles and free boundaries, too."));
	list.addParam(RichFloat(
		"seam_hiding",
		static_cast<Scalarm>(defaults.seamHiding),
		"Seams: hide in hollows",
		"0: the seams are as short as can be. Up to 1: an edge on a ridge counts up to ten "
		"times its length, so that the seams run through hollows where there are some."));
	list.addParam(RichBool(
		"normalize_uv",
		Flow::Params().normalizeUV,
		"Fit into the unit square",
		"Scale the texture coordinates uniformly into [0,1] x [0,1]. Off: they keep the scale "
		"of the metric, so that distances in the texture plane are those on the mesh where the "
		"scale factor is 1."));
	list.addParam(RichFloat(
		"chart_margin",
		static_cast<Scalarm>(Flow::Params().chartMargin),
		"Margin of the charts",
		"Room between two charts, and between the charts and the border of the unit square, as "
		"a share of the side of the square: 0.004 is 4 pixels of an image 1024 wide. For baking "
		"textures. Where the charts are not fitted into the square: of the side of the square "
		"that holds them all."));
	list.addParam(colorizeParameter());
	list.addParam(RichBool(
		"flat_layer",
		false,
		"Flat mesh as new layer",
		"Add a layer with the mesh laid out in the plane, cut along its seams."));
	list.addParam(RichBool(
		"sphere_layer",
		false,
		"Sphere as new layer",
		"Add a layer with the mesh mapped conformally to the unit sphere, its faces and "
		"vertices in the same order. Only for a mesh that is one closed surface of genus 0."));
	list.addParam(reportParameter());
	list.addParam(RichEnum(
		"circle_packing",
		static_cast<int>(defaults.packing),
		circlePackingChoices(),
		"Circle packing",
		"<b>Inversive distance</b>: the generalized flow; circles may intersect or be disjoint, "
		"and the metric of the mesh is reproduced exactly.<br>"
		"<b>Thurston</b>: the conventional flow; circles have to intersect at acute angles, so "
		"the metric is changed where the mesh does not allow it, and distortion grows. For "
		"comparison."));
	list.addParam(RichEnum(
		"surgery",
		static_cast<int>(defaults.surgery),
		surgeryChoices(),
		"Surgery",
		"What to do where the flow breaks the triangle inequality.<br>"
		"<b>None</b>: the triangulation stays as it is.<br>"
		"<b>Edge swap</b>: the paper's remedy, the longest edge of the broken triangle is "
		"swapped. The mesh itself is not changed.<br>"
		"<b>Intrinsic flips</b>: the flow runs on intrinsic triangles whose edges flip without "
		"leaving the conformal class, so that no triangle ever breaks and every curvature that "
		"Gauss-Bonnet allows is reached."));
	list.addParam(epsilonParameter(defaults.epsilon));
	list.addParam(iterationsParameter(defaults.maxIterations));
	list.addParam(timeLimitParameter());
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
		"The curvature that the hyperbolic metric is asked to have at the vertices, beyond the "
		"constant -1 of its triangles.<br>"
		"<b>Hyperbolic metric</b>: none; the one metric of curvature -1 that is conformal to "
		"the mesh (uniformization). The surface must have a negative Euler characteristic, as "
		"every closed one with two handles or more has; a boundary becomes geodesic.<br>"
		"<b>Cones at selected vertices</b>: each selected vertex becomes a cone of the angle "
		"below.<br>"
		"<b>From vertex quality</b>: each vertex's quality is its curvature in radians, 2 pi "
		"less the angle there."));
	list.addParam(RichFloat(
		"cone_angle",
		static_cast<Scalarm>(defaults.coneAngle / kDegree),
		"Cone angle (degrees)",
		"The sum of the angles at each selected vertex, for 'Cones at selected vertices'. 360 "
		"is no cone."));
	list.addParam(RichBool(
		"free_boundary",
		defaults.freeBoundary,
		"Free boundary",
		"The circles of the boundary's vertices keep their radii, and the target holds inside "
		"only. Off: the target holds on the boundary too. No effect on closed surfaces."));
	list.addParam(outputTriangulationParameter(defaults.output));
	list.addParam(hyperbolicFinishParameter(defaults.finish));
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
		"Add a layer with copies of the laid-out mesh, each in a colour of its own, that tile "
		"the Poincaré disk: the mesh itself and this many rings of copies round it. 0: no layer."));
	list.addParam(RichBool(
		"generator_axes",
		false,
		"Axes of the generators",
		"Add a layer with the axes of the canonical generators of the Fuchsian group in the "
		"Poincaré disk, as edges. On the surface they are closed geodesics. The generators are "
		"among the results then."));
	list.addParam(RichBool(
		"canonical_polygon",
		false,
		"Canonical polygon",
		"Add a layer with a fundamental polygon of 4 sides for each handle in the Poincaré disk, "
		"as "
		"edges. Its sides are geodesics that the canonical generators a1, b1, a1⁻¹, b1⁻¹, ... "
		"pair, and all its corners are one point of the surface. The generators are among the "
		"results then."));
	list.addParam(reportParameter());
	list.addParam(RichEnum(
		"surgery",
		defaults.surgery == ricci::Surgery::IntrinsicFlips ? 1 : 0,
		hyperbolicSurgeryChoices(),
		"Surgery",
		"What to do where the flow breaks the triangle inequality.<br>"
		"<b>None</b>: the triangulation stays as it is.<br>"
		"<b>Intrinsic flips</b>: the flow runs on intrinsic triangles whose edges flip without "
		"leaving the conformal class, so that no triangle ever breaks."));
	list.addParam(epsilonParameter(defaults.epsilon));
	list.addParam(iterationsParameter(defaults.maxIterations));
	list.addParam(timeLimitParameter());
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
	settings.flow.target = static_cast<ricci::TargetCurvature>(
		checkedChoice(par, "target_curvature", targetCurvatureChoices()));
	settings.flow.coneCount = par.getInt("cone_count");
	settings.flow.coneDistortion = static_cast<double>(par.getFloat("cone_distortion"));
	settings.flow.coneRounding = static_cast<ricci::ConeRounding>(
		checkedChoice(par, "cone_rounding", coneRoundingChoices()));
	settings.flow.freeBoundary = par.getBool("free_boundary");
	settings.flow.epsilon = static_cast<double>(par.getFloat("epsilon"));
	settings.flow.packing = static_cast<ricci::PackingScheme>(
		checkedChoice(par, "circle_packing", circlePackingChoices()));
	settings.flow.surgery =
		static_cast<ricci::Surgery>(checkedChoice(par, "surgery", surgeryChoices()));
	settings.flow.output = static_cast<ricci::OutputTriangulation>(
		checkedChoice(par, "output_triangulation", outputTriangulationChoices()));
	settings.flow.finish =
		static_cast<ricci::Finish>(checkedChoice(par, "finish", finishChoices()));
	settings.flow.seamHiding = static_cast<double>(par.getFloat("seam_hiding"));
	settings.flow.maxIterations = par.getInt("max_iterations");
	settings.flow.normalizeUV = par.getBool("normalize_uv");
	settings.flow.chartMargin = static_cast<double>(par.getFloat("chart_margin"));
	settings.colorize = par.getBool("colorize");
	settings.flatLayer = par.getBool("flat_layer");
	settings.flow.holes = static_cast<ricci::Holes>(checkedChoice(par, "holes", holesChoices()));
	settings.flow.resolveOverlap = par.getBool("resolve_overlap");
	settings.sphereLayer = par.getBool("sphere_layer");
	settings.report = par.getString("report");
	settings.timeLimit = checkedTimeLimit(par);
	ricci::checkOptions(settings.flow);
	ricci::checkChartMargin(settings.flow.chartMargin);
	return settings;
}

HyperbolicSettings readHyperbolicSettings(const RichParameterList& par)
{
	HyperbolicSettings settings;
	settings.flow.target = static_cast<ricci::HyperbolicTarget>(
		checkedChoice(par, "target_curvature", hyperbolicTargetChoices()));
	settings.flow.coneAngle = static_cast<double>(par.getFloat("cone_angle")) * kDegree;
	settings.flow.freeBoundary = par.getBool("free_boundary");
	settings.flow.epsilon = static_cast<double>(par.getFloat("epsilon"));
	settings.flow.surgery = checkedChoice(par, "surgery", hyperbolicSurgeryChoices()) == 1
								? ricci::Surgery::IntrinsicFlips
								: ricci::Surgery::None;
	settings.flow.output = static_cast<ricci::OutputTriangulation>(
		checkedChoice(par, "output_triangulation", outputTriangulationChoices()));
	settings.flow.finish = checkedChoice(par, "finish", hyperbolicFinishChoices()) == 1
							   ? ricci::Finish::Repair
							   : ricci::Finish::None;
	settings.flow.maxIterations = par.getInt("max_iterations");
	settings.colorize = par.getBool("colorize");
	settings.flatLayer = par.getBool("flat_layer");
	settings.coverRings = par.getInt("universal_cover");
	if (settings.coverRings < 0 || settings.coverRings > kMaxRings)
		throw Refusal(
			"The value " + std::to_string(settings.coverRings) +
			" of universal_cover cannot be used. Use 0 to " + std::to_string(kMaxRings) +
			" rings.");
	settings.axes = par.getBool("generator_axes");
	settings.canonicalPolygon = par.getBool("canonical_polygon");
	settings.flow.canonicalGenerators = settings.axes || settings.canonicalPolygon;
	settings.report = par.getString("report");
	settings.timeLimit = checkedTimeLimit(par);
	ricci::checkOptions(settings.flow);
	return settings;
}

} // namespace filter_ricci
