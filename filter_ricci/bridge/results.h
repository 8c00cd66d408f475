// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_RICCI_RESULTS_H
#define FILTER_RICCI_RESULTS_H

#include "bridge.h"

#include <ricci/fuchsian/fuchsian_group.h>
#include <ricci/report.h>
#include <ricci/sphere_map.h>

#include <string>
#include <vector>

namespace filter_ricci {

/// The report under the names that scripts read; an invariant that does not exist is left out.
Results toResults(const ricci::Report& report);

/// Adds what the map to the sphere measured.
void addSphereResults(const ricci::SphereMap& sphere, Results& results);

/// Adds the canonical generators of a group.
/// \pre group.isCanonical()
void addGenerators(const ricci::FuchsianGroup& group, Results& results);

/// What a person wants to know of a run.
std::string toSentence(const Results& results);

/// The distortion from which on "Colour by distortion" paints red: the 99th percentile over the faces,
/// and above 1 also where nothing is distorted, for a ramp needs two ends.
double colourRampTop(const Results& results);

/// The colours of that ramp and the distortions at its ends, as part of a sentence.
std::string colourRamp(const Results& results);

/// The same pairs as "key=value key=value ...", for hosts that show only the log: one line with
/// what the flow reached, one with what the surface is.
std::vector<std::string> toLogLines(const Results& results);

} // namespace filter_ricci

#endif
