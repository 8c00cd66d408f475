// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MEASURE_RESULT_H
#define RICCI_MEASURE_RESULT_H

#include "../measure/distortion.h"
#include "../surface/surface_mesh.h"
#include "parametrization.h"

#include <functional>
#include <vector>

namespace ricci {

/// Takes what measureDistortion() does.
using Measure = std::function<DistortionField(
	const SurfaceMesh&, const std::vector<Triangle2>&, const std::vector<char>&, Report&)>;

/// Distortion of the map and of its refinement if it has one, whose figures then are those of the
/// report. Its charts may have been packed if \p measure does not depend on places and scale.
void measureResult(const SurfaceMesh& mesh, const Measure& measure, Parametrization& result);

} // namespace ricci

#endif
