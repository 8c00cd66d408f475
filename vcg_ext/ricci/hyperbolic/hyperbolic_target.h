// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HYPERBOLIC_TARGET_H
#define RICCI_HYPERBOLIC_TARGET_H

#include "../cones/prescribed_target.h"
#include "../options.h"

namespace ricci {

/// Chooses the target of the hyperbolic flow and checks that a metric with that curvature can exist:
/// K < 2 pi inside, K < pi on the boundary, and sum K > 2 pi chi, because the difference is the area
/// (Gauss-Bonnet). Smooth metrics with these cones then do exist on closed surfaces
/// [Troyanov 1991]. Where the boundary is free the sum over the vertices inside needs to be above
/// 2 pi chi - pi n only, for n vertices on the boundary: see checkFreeBoundary(). The scale at which
/// its circles keep their radii is freeBoundaryArea().
/// \throw InvalidOption if a cone's angle is not positive, or nothing is selected for cones
/// \throw InadmissibleCurvature otherwise, with the numbers that contradict each other
Target chooseHyperbolicTarget(
	const Topology& topology, const HyperbolicTargetOptions& options, const TargetInput& input);

} // namespace ricci

#endif
