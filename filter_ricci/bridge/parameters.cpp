// SPDX-License-Identifier: GPL-3.0-or-later
#include "parameters.h"

#include "error_sentences.h"

#include <ricci/base/numbers.h>
#include <ricci/parametrize.h>

#include <algorithm>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <utility>

namespace filter_ricci {

namespace {

// A parameter: its name and default, its label, and its choices or its type; then its tooltip, behind tabs. What
// a first run needs comes first; what few runs need is marked by +, what is an option in dialogs by -. The choices have the
// order of the enums of the same name in ricci/options.h. A name alone stands for the parameter of the Euclidean filter.

const char* const kEuclidean = R"(
target_curvature = Automatic | Target curvature | Automatic; Flat everywhere; Disk; Rectangle; Cones at selected vertices; From vertex quality; Placed cones
	Shape of the UV layout: its outline, and its cones, the points where it is not flat. <b>Automatic</b> suits most
	meshes.
free_boundary = true | Free boundary | bool
	Let the outline of an open mesh take its natural shape. Ignored by Disk, Rectangle and flat annuli.
cone_distortion = 0 | Cones: area distortion | float
	Largest area distortion that cones may leave (0.25: 25 %). 0: area distortion and seam length are balanced.
seams = Shortest | Seams | Shortest; Existing texture seams; Selected edges; Border of selected faces; Sharp edges
	Cut along the shortest paths only, or first along UV seams, selected edges, the outline of selected faces, or edges
	sharper than 30 degrees (sharp_angle).
padding = 2 | Padding (px) | int
	Empty pixels between charts (UV islands) and to the border, for baking: of a texture of 'Texture size' that covers the
	whole layout.
texture_size = 2048 | Texture size (px) | int
	Width and height of the texture, 16 to 16384 pixels. 0: the resolution of the old textures is kept; 2048 if none is
	transferred.
carry_texture = | Transfer texture to | PNG image (*.png)
	Bake the present textures, or else the colours, into this PNG file for the new UVs. Empty: no texture.
layers = None | Extra layers | None; Flat mesh; Sphere; Flat mesh and sphere
	Add the mesh laid out in the plane, cut along its seams, or mapped conformally to the unit sphere (closed surfaces of
	genus 0).
+ charts = Without overlap, cut for packing | Charts | As the flow has them; Without overlap; Without overlap, cut for packing; As they are, only packed
	Leave charts whole, split those that overlap, or for <b>Automatic</b> without chosen seams also for better packing.
	<b>Only packed</b>: the old islands keep their shape.
+ normalize_uv = true | Fit into the unit square | bool
	Scale the UVs uniformly into [0,1] x [0,1]. Off: the same charts in the real size of the mesh.
+ holes = Short ones capped | Holes | Boundaries; Capped; Short ones capped
	Fill holes while solving, so that no seam runs to them: all boundary loops but the longest, or only short ones (0.1
	√area).
+ output_triangulation = Keep the mesh | Output triangulation | Keep the mesh; Common refinement
	<b>Common refinement</b> adds vertices where edges of the solver cross those of the mesh, so that the map is exact on
	every piece.
+ finish = Least distortion | Finish | None; Repair; Least distortion; Least stretch
	After the solve, repair flipped faces; then minimise angle distortion, or <b>stretch</b>, where the two sides of a
	seam may differ. Needs 'Intrinsic flips'.
+ method = Intrinsic flips | Method | Intrinsic flips; Fixed triangles; Edge swaps; Thurston
	What happens when a triangle degenerates during the solve: the solver flips edges (recommended) or swaps them, or the
	run fails. <b>Thurston</b>: the conventional flow.
+ epsilon = 1e-8 | Epsilon (rad) | float
	The solve stops when the curvature of every vertex is this close to its target, in radians, or rounding allows no
	better.
- cone_count = 0 | Cones: number | int
	The number of placed cones. 0: 'Cones: area distortion' decides.
- cone_rounding = Free | Cones: curvatures | Free; Multiples of pi/2
	<b>Free</b>: the least area distortion. <b>Multiples of pi/2</b>: a seamless map for quad remeshing, whose seams
	differ by quarter turns.
- seam_hiding = 0 | Seams: prefer concave areas | float
	From 0 (the seams are as short as possible) to 1 (an edge on a ridge counts as ten times longer).
- texel_density = 0 | Texels per unit of length | float
	Lay charts at this density into UDIM tiles of 'Texture size', up to 100; larger charts are cut. 0: one
	square.
- chart_rotation = Any | Chart rotation | None; Right angles; Any
	<b>None</b>: charts do not rotate, and are not cut for packing. <b>Right angles</b>: straight ones upright, others by 90
	degrees.
- sharp_angle = 30 | Sharp angle (degrees) | float
	The seams 'Sharp edges' are those at which the surface bends by more than this.
- join_vertices = Automatic | Join split vertices | Automatic; Never; Always
	Treat vertices that coincide along edges as one, as in formats that split them. <b>Automatic</b>: only if faces share
	almost no vertices.
- colorize = false | Colour by distortion | bool
	Colour the vertices by angle distortion: from blue (none) to red (99th percentile or worse).
- report = | Report file | Page and its data (*.html);;Data alone (*.csv)
	Write a report: a page with diagrams and its data (.html), or the data alone (.csv). Empty: no report.
- time_limit = 0 | Time limit (seconds) | float
	A run that takes longer ends with an error and leaves the mesh unchanged. 0: no limit.
)";

const char* const kHyperbolic = R"(
target_curvature = Hyperbolic metric | Target curvature | Hyperbolic metric; Cones at selected vertices; From vertex quality
	The curvature at the vertices, in addition to the constant -1 of the triangles. <b>Hyperbolic metric</b>: none, for
	surfaces of negative Euler characteristic.
cone_angle = 180 | Cone angle (degrees) | float
	The sum of the angles at each selected vertex, for 'Cones at selected vertices'. 360: not a cone.
seams
output_triangulation
flat_layer = false | Disk as new layer | bool
	Add a layer with the mesh laid out in the Poincaré disk, cut along its seams.
universal_cover = 0 | Universal cover (rings) | int
	Add a layer with the mesh in the Poincaré disk and this many rings of copies around it, which tile the disk. 0: no
	layer.
generator_axes = false | Axes of the generators | bool
	Add a layer with the axes of the canonical generators of the Fuchsian group, as edges. On the surface they are closed
	geodesics.
canonical_polygon = false | Canonical polygon | bool
	Add a layer with a fundamental polygon of 4 sides for each handle, as edges. The canonical generators pair its
	sides, which are geodesics.
+ free_boundary = false | Free boundary | bool
	The circles at boundary vertices keep their radii, and the target holds at interior vertices only. Off: the target
	holds everywhere.
+ method = Intrinsic flips | Method | Intrinsic flips; Fixed triangles
	What happens when a triangle degenerates during the solve: edges flip inside the solver (recommended), or the run
	fails.
+ finish = Repair | Finish | None; Repair
	After the solve, repair flipped faces. Needs the method 'Intrinsic flips'.
+ carry_texture
+ texture_size
+ epsilon
- sharp_angle
- join_vertices
- colorize
- report
- time_limit
)";

/// The parts of a text between separators.
std::vector<std::string> split(const std::string& text, const std::string& separator)
{
	std::vector<std::string> parts;
	std::size_t from = 0;
	for (std::size_t at; (at = text.find(separator, from)) != std::string::npos;
		 from = at + separator.size())
		parts.push_back(text.substr(from, at - from));
	parts.push_back(text.substr(from));
	return parts;
}

std::string trimmed(const std::string& text)
{
	const char* const blanks = " \t\r\n\f\v";
	const std::size_t from = text.find_first_not_of(blanks);
	return from == std::string::npos ? std::string()
									 : text.substr(from, text.find_last_not_of(blanks) + 1 - from);
}

/// The whole text as a number, in no locale.
template<class Number>
bool read(const std::string& text, Number& number)
{
	std::istringstream stream(text);
	stream.imbue(std::locale::classic());
	return stream >> number && (stream >> std::ws).eof();
}

bool readAny(const std::string& text, double& number)
{
	using Limits = std::numeric_limits<double>;
	const std::string word = lower(text);
	for (const auto& [name, value] :
		 {std::pair("nan", Limits::quiet_NaN()),
		  std::pair("inf", Limits::infinity()),
		  std::pair("infinity", Limits::infinity()),
		  std::pair("-inf", -Limits::infinity()),
		  std::pair("-infinity", -Limits::infinity())})
		if (word == name) {
			number = value;
			return true;
		}
	return read(text, number);
}

/// \param others those that a name alone stands for
Parameters parametersOf(const char* table, const Parameters& others)
{
	Parameters list;
	for (const std::string& line : split(table, "\n")) {
		if (line.empty())
			continue;
		if (line[0] == '\t') {
			std::string& tooltip = list.back().tooltip;
			tooltip += (tooltip.empty() ? "" : " ") + line.substr(1);
			continue;
		}
		const Place place = line[0] == '+'   ? Place::Advanced
							: line[0] == '-' ? Place::Options
											 : Place::Shown;
		const std::vector<std::string> fields =
			split(line.substr(place == Place::Shown ? 0 : 2), " | ");
		const std::size_t end = fields[0].find(" =");
		const std::string name = fields[0].substr(0, end);
		if (fields.size() == 1)
			list.push_back(*findParameter(others, name));
		else {
			Parameter p{name, std::string(), {}, fields[1], "", "", place};
			const std::map<std::string, Parameter::Value> types{
				{"bool", false}, {"int", 0}, {"float", 0.0}};
			const std::string& kind = fields[2];
			if (const auto type = types.find(kind); type != types.end())
				p.value = type->second;
			else if (kind.find("(*.") != std::string::npos)
				p.files = kind;
			else {
				p.value = 0;
				p.choices = split(kind, "; ");
			}
			setFromText(p, trimmed(fields[0].substr(end + 2)));
			list.push_back(std::move(p));
		}
		list.back().place = place;
	}
	return list;
}

template<class Enum>
void readChoice(const Parameters& par, const char* id, Enum& value)
{
	const std::vector<std::string>& choices = findParameter(par, id)->choices;
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

/// \throw Refusal unless it is from \p least to \p most, which are \p units
int checked(const Parameters& par, const char* id, int least, int most, const std::string& units)
{
	const int value = valueOf<int>(par, id);
	if (value >= least && value <= most)
		return value;
	throw Refusal(unusable(
		std::to_string(value),
		id,
		std::to_string(least) + " to " + std::to_string(most) + " " + units));
}

RunSettings readRunSettings(const Parameters& par)
{
	RunSettings settings;
	readChoice(par, "seams", settings.seams);
	settings.colorize = valueOf<bool>(par, "colorize");
	settings.timeLimit = valueOf<double>(par, "time_limit");
	settings.report = trimmed(valueOf<std::string>(par, "report"));
	settings.texture.file = trimmed(valueOf<std::string>(par, "carry_texture"));
	settings.texture.size = valueOf<int>(par, "texture_size");
	if (settings.texture.size != 0)
		checked(
			par,
			"texture_size",
			kMinTextureSize,
			kMaxTextureSize,
			"texels, or 0 for as many as keep the old ones");
	return settings;
}

constexpr double kDegree = ricci::kPi / 180.0;

void readFlowOptions(const Parameters& par, Seams seams, ricci::FlowOptions& flow)
{
	if (seams == Seams::Sharp)
		flow.sharpAngle = valueOf<double>(par, "sharp_angle") * kDegree;
	flow.epsilon = valueOf<double>(par, "epsilon");
	readChoice(par, "method", flow.method);
	readChoice(par, "output_triangulation", flow.output);
	readChoice(par, "finish", flow.finish);
	readChoice(par, "join_vertices", flow.join);
}

/// The disk cannot show more rings than this.
constexpr int kMaxRings = 20;

} // namespace

const Parameters& filterParameters(int filter)
{
	static const Parameters euclidean = parametersOf(kEuclidean, {}),
							hyperbolic = parametersOf(kHyperbolic, euclidean);
	return filter == Hyperbolic ? hyperbolic : euclidean;
}

Parameters dialogParameters(int filter)
{
	Parameters list;
	std::string names;
	for (const Parameter& p : filterParameters(filter))
		if (p.place == Place::Options)
			names += (names.empty() ? "" : ", ") + p.name;
		else
			list.push_back(p);
	list.push_back(
		{"options",
		 std::string(),
		 {},
		 "Options",
		 "Rare parameters, such as 'time_limit=60; colorize=true'. There are " + names +
			 ": see the manual.",
		 "",
		 Place::Advanced});
	return list;
}

const std::map<std::string, std::string>& renamedParameters(int filter)
{
	static const std::map<std::string, std::string> none,
		euclidean{
			{"chart_margin",
			 "it is 'padding' now, in pixels of texture_size: 0.004 is 4 at texture_size 1024"},
			{"flat_layer", "it is layers='Flat mesh' now"},
			{"sphere_layer", "it is layers='Sphere' now, or 'Flat mesh and sphere'"}};
	return filter == Hyperbolic ? none : euclidean;
}

std::string noSuchParameter(int filter, const std::string& name)
{
	const auto renamed = renamedParameters(filter).find(name);
	std::string here;
	if (renamed != renamedParameters(filter).end())
		here = renamed->second;
	else
		for (const Parameter& p : filterParameters(filter))
			here += (here.empty() ? "it is one of '" : ", '") + p.name + "'";
	return "The filter has no parameter '" + name + "': " + here + ".";
}

void setOptions(int filter, Parameters& parameters, const std::string& text)
{
	for (const std::string& part : split(text, ";")) {
		const std::string option = trimmed(part);
		if (option.empty())
			continue;
		const std::size_t equals = option.find('=');
		const std::string name = trimmed(option.substr(0, equals));
		Parameter* const p = findParameter(parameters, name);
		if (p == nullptr)
			throw Refusal(noSuchParameter(filter, name));
		if (p->place != Place::Options)
			throw Refusal(
				"{" + name + "} is a parameter of its own: set it there, not as an option.");
		if (equals == std::string::npos)
			throw Refusal("{" + name + "} has no value: options are 'name=value; name=value'.");
		const std::string problem = setFromText(*p, trimmed(option.substr(equals + 1)));
		if (!problem.empty())
			throw Refusal(problem);
	}
}

std::string lower(std::string text)
{
	for (char& c : text)
		c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
	return text;
}

std::string setFromText(Parameter& p, const std::string& text)
{
	const auto wanted = [&](const std::string& what) {
		return "{" + p.name + "} must be " + what + ", not '" + text + "'.";
	};
	int whole = 0;
	double number = 0.0;
	if (!p.choices.empty()) {
		const auto named =
			std::find_if(p.choices.begin(), p.choices.end(), [&](const std::string& c) {
				return lower(c) == lower(text);
			});
		if (named == p.choices.end() && !read(text, whole)) {
			std::string names;
			for (const std::string& choice : p.choices)
				names += (names.empty() ? "'" : ", '") + choice + "'";
			return wanted("one of " + names);
		}
		p.value = named == p.choices.end() ? whole : static_cast<int>(named - p.choices.begin());
	}
	else if (std::holds_alternative<bool>(p.value)) {
		const bool isOn = lower(text) == "true" || text == "1";
		if (!isOn && lower(text) != "false" && text != "0")
			return wanted("true or false");
		p.value = isOn;
	}
	else if (std::holds_alternative<int>(p.value)) {
		if (!read(text, whole))
			return wanted("a whole number");
		p.value = whole;
	}
	else if (std::holds_alternative<double>(p.value)) {
		if (!readAny(text, number))
			return wanted("a number");
		p.value = number;
	}
	else
		p.value = text;
	return "";
}

std::string valueText(const Parameter& p)
{
	if (const double* const number = std::get_if<double>(&p.value))
		return ricci::numberText(*number, 7);
	if (const bool* const isOn = std::get_if<bool>(&p.value))
		return *isOn ? "true" : "false";
	if (const int* const whole = std::get_if<int>(&p.value))
		return p.choices.empty() ? std::to_string(*whole)
								 : p.choices.at(static_cast<std::size_t>(*whole));
	return std::get<std::string>(p.value);
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
	readChoice(par, "charts", settings.flow.charts);
	if (settings.flow.charts == ricci::Charts::AsGiven)
		settings.seams = Seams::Texture;
	readFlowOptions(par, settings.seams, settings.flow);
	readChoice(par, "target_curvature", settings.flow.target);
	settings.flow.cones.count = valueOf<int>(par, "cone_count");
	settings.flow.cones.distortion = valueOf<double>(par, "cone_distortion");
	readChoice(par, "cone_rounding", settings.flow.cones.rounding);
	settings.flow.freeBoundary = valueOf<bool>(par, "free_boundary");
	settings.flow.seamHiding = valueOf<double>(par, "seam_hiding");
	readChoice(par, "chart_rotation", settings.flow.turns);
	settings.flow.normalizeUV = valueOf<bool>(par, "normalize_uv");
	const int texels = settings.texture.size > 0       ? settings.texture.size
					   : settings.texture.file.empty() ? TextureSettings().size
													   : kMaxTextureSize;
	const int most = static_cast<int>(ricci::kMaxChartMargin * texels);
	const auto density = valueOf<double>(par, "texel_density");
	if (!(density >= 0.0 && density <= std::numeric_limits<float>::max()))
		throw Refusal(unusable(
			ricci::numberText(density, 6), "texel_density", "texels per unit of length, or 0"));
	if (density > 0.0) {
		if (!settings.texture.file.empty())
			throw Refusal(
				"{carry_texture} draws a single square: leave it empty, or {texel_density} 0.");
		settings.flow.tileSide =
			(settings.texture.size > 0 ? settings.texture.size : TextureSettings().size) / density;
	}
	settings.padding = checked(par, "padding", 0, most, "pixels, a quarter of {texture_size}");
	readChoice(par, "holes", settings.flow.holes);
	int layers = 0;
	readChoice(par, "layers", layers);
	settings.flatLayer = layers % 2 == 1;
	settings.sphereLayer = layers / 2 == 1;
	if (!settings.texture.file.empty() && !settings.flow.normalizeUV)
		throw Refusal("{carry_texture} draws on the unit square: choose {normalize_uv}, or leave "
					  "{carry_texture} empty.");
	ricci::checkOptions(settings.flow);
	return settings;
}

HyperbolicSettings readHyperbolicSettings(const Parameters& par)
{
	HyperbolicSettings settings;
	static_cast<RunSettings&>(settings) = readRunSettings(par);
	readFlowOptions(par, settings.seams, settings.flow);
	readChoice(par, "target_curvature", settings.flow.target);
	settings.flatLayer = valueOf<bool>(par, "flat_layer");
	settings.flow.coneAngle = valueOf<double>(par, "cone_angle") * kDegree;
	settings.flow.freeBoundary = valueOf<bool>(par, "free_boundary");
	settings.coverRings = checked(par, "universal_cover", 0, kMaxRings, "rings");
	settings.axes = valueOf<bool>(par, "generator_axes");
	settings.canonicalPolygon = valueOf<bool>(par, "canonical_polygon");
	settings.flow.canonicalGenerators = settings.axes || settings.canonicalPolygon;
	ricci::checkOptions(settings.flow);
	return settings;
}

} // namespace filter_ricci
