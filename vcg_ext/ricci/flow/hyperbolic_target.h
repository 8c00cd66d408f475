// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HYPERBOLIC_TARGET_H
#define RICCI_HYPERBOLIC_TARGET_H

#include "../options.h"
#include "target_curvature.h"

#include <vector>

namespace ricci {

/// What the user chose beyond the mode.
struct HyperbolicRequest
{
	HyperbolicTarget mode = HyperbolicTarget::HyperbolicMetric;
	bool freeBoundary = false;
	double coneAngle = 0.0;           ///< total angle at each selected vertex, radians
	std::vector<char> selected;       ///< [vertex] for SelectedCones
	std::vector<double> prescribed;   ///< [vertex] radians, for Prescribed
	double prescribedPrecision = 0.0; ///< relative rounding error of prescribed values
};

/// Chooses the target of the hyperbolic flow and checks that a metric with that curvature exists:
/// K < 2 pi inside, K < pi on the boundary, and sum K > 2 pi chi, because the area is the difference
/// (Gauss-Bonnet). Where the boundary is free its vertices count as 0 in the sum, which then gives
/// the metric its scale.
/// \throw InvalidOption if the mode does not fit the selection
/// \throw InadmissibleCurvature with both numbers otherwise
Target
chooseHyperbolicTarget(const Topology& topology, int vertexCount, const HyperbolicRequest& request);

} // namespace ricci

#endif
