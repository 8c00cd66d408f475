// SPDX-License-Identifier: GPL-3.0-or-later
// The parameters of the filters, once for all hosts: dialogs, the pages of the manual and the signatures in Python
// are made from this table.
#ifndef FILTER_RICCI_PARAMETERS_H
#define FILTER_RICCI_PARAMETERS_H

#include "filter_text.h"

#include <ricci/options.h>

#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace filter_ricci {

/// Where a dialog has a parameter. Python, C and the command line have all by their names.
enum class Place {
	Shown,
	Advanced, ///< few runs need it
	Options   ///< within the text "options"
};

/// A parameter as it is shown, and its value.
struct Parameter
{
	/// Of a choice its number, of a file its path in UTF-8.
	using Value = std::variant<bool, int, double, std::string>;

	std::string name;                 ///< in scripts
	Value value;                      ///< the default, until another one is set
	std::vector<std::string> choices; ///< empty: it is none
	std::string label, tooltip;       ///< the tooltip in HTML
	std::string files;                ///< of a file to be written: the pattern of a dialog
	Place place = Place::Shown;
};

/// In the order of the dialog.
using Parameters = std::vector<Parameter>;

/// Those of a filter, with their defaults.
const Parameters& filterParameters(int filter);

/// The same as dialogs have them: those of Place::Options are one text, "options".
Parameters dialogParameters(int filter);

/// Gives parameters of a filter that are in Place::Options the values in a text "name=value; name=value".
/// \throw Refusal
void setOptions(int filter, Parameters& parameters, const std::string& text);

/// Names that parameters of a filter had before version 3, and what is said of them.
const std::map<std::string, std::string>& renamedParameters(int filter);

/// The sentence that refuses a name which no parameter of a filter has.
std::string noSuchParameter(int filter, const std::string& name);

/// Gives a parameter the value that a text names: a choice by its name, in any case, or its number; true, false, 1 or
/// 0; a number in no locale, also nan and inf; a path.
/// \return the sentence that refuses another text; empty if there is nothing to refuse
std::string setFromText(Parameter& parameter, const std::string& text);

/// The value as setFromText() reads it, a choice by its name; numbers with the digits of floats, which hosts may have.
std::string valueText(const Parameter& parameter);

/// A to Z in lower case.
std::string lower(std::string text);

/// The parameter of that name; null if there is none.
const Parameter* findParameter(const Parameters& parameters, const std::string& name);
inline Parameter* findParameter(Parameters& parameters, const std::string& name)
{
	return const_cast<Parameter*>(findParameter(std::as_const(parameters), name));
}

/// The value of a parameter that is there, of its own type.
template<class T>
const T& valueOf(const Parameters& parameters, const char* name)
{
	return std::get<T>(findParameter(parameters, name)->value);
}

/// Where the surface is opened before the flow.
enum class Seams {
	Shortest,      ///< nowhere: only along what the flow needs
	Texture,       ///< where the texture coordinates that the mesh has jump
	SelectedEdges, ///< sides of faces
	SelectedFaces, ///< around them
	Sharp          ///< edges sharper than an angle
};

/// Texels.
constexpr int kMinTextureSize = 16, kMaxTextureSize = 16384;

struct TextureSettings
{
	std::string file; ///< empty: none
	int size = 2048; ///< texels; 0: as many as the old ones need, which are so as fine as they were
};

/// What both filters have.
struct RunSettings
{
	Seams seams = Seams::Shortest;
	bool colorize = false;
	bool flatLayer = false;
	double timeLimit = 0.0; ///< seconds, 0: none
	std::string report;     ///< file, empty: none
	TextureSettings texture;
};

struct Settings : RunSettings
{
	ricci::Options flow; ///< without its margin: padding
	int padding = 0;     ///< texels
	bool sphereLayer = false;
};

struct HyperbolicSettings : RunSettings
{
	ricci::HyperbolicOptions flow;
	int coverRings = 0;
	bool axes = false;
	bool canonicalPolygon = false;
};

/// Reads the parameters and checks them all. Scripts can hold any number for a choice, and no host
/// checks the range of a number.
/// \throw Refusal for what the algorithm does not know (choices, pixels, rings), and ricci::InvalidOption
Settings readSettings(const Parameters& par);
HyperbolicSettings readHyperbolicSettings(const Parameters& par);

} // namespace filter_ricci

#endif
