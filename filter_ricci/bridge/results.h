// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_RICCI_RESULTS_H
#define FILTER_RICCI_RESULTS_H

#include "parameters.h"

#include <ricci/layout/parametrization.h>
#include <ricci/sphere_map.h>

#include <string>
#include <variant>
#include <vector>

namespace filter_ricci {

using Value = std::variant<bool, int, double, std::vector<double>>;
struct Result
{
	std::string key; ///< by which scripts know it
	Value value;
	const char* label; ///< what a person calls it
};
using Results = std::vector<Result>;

/// The report under the names that scripts read; an invariant that does not exist is left out.
Results toResults(const ricci::Report& report);

/// Adds the cones that were placed, if any.
void addPlacedCones(const ricci::Parametrization& map, Results& results);

/// Adds what the map to the sphere measured.
void addSphereResults(const ricci::SphereMap& sphere, Results& results);

/// Adds the canonical generators of a group.
/// \pre group.isCanonical()
void addGenerators(const ricci::FuchsianGroup& group, Results& results);

/// What came out, in two sentences.
std::string toSentence(int filter, const Results& results);

/// Why it is this map, and how exact it is.
/// \param choice see ricci::Report
std::string toReason(const Results& results, const std::string& choice);

/// What makes the use of the map doubtful, and what helps.
std::vector<std::string> doubts(int filter, const Results& results, const Parameters& par);

/// What was asked for and has no effect, a sentence each.
std::vector<std::string> ignored(int filter, const Results& results, const Parameters& par);

/// The distortion from which on "Colour by distortion" paints red: the 99th percentile over the faces,
/// and above 1 also where nothing is distorted, for a ramp needs two ends.
double colourRampTop(const Results& results);

/// The colours of that ramp and the distortions at its ends, as part of a sentence.
std::string colourRamp(const Results& results);

/// In no locale; the numbers of a row with all digits, because they are to compute with, and the separator between.
std::string valueText(const Value& value, const char* separator);

/// The same pairs as "key=value key=value ...", for hosts that show only the log: one line with
/// what the flow reached, one with what the surface is.
std::vector<std::string> toLogLines(const Results& results);

} // namespace filter_ricci

#endif
