// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MAKE_SEAMLESS_H
#define RICCI_MAKE_SEAMLESS_H

#include "../flow/ricci_flow.h"
#include "seamless_metric.h"
#include "target_curvature.h"

namespace ricci {

/// Makes the rotations across all seams of \p flow multiples of pi / 2, if its cones were placed with
/// such curvatures: runs the flow again to cones that bring the holonomies nearer to multiples of pi / 2,
/// as long as that helps, and then rounds those of the best metric, see roundHolonomy(). Does nothing
/// to another flow, nor on the double of a surface.
/// \param flow on \p surface, with intrinsic flips, to a target that was chosen for \p request
/// \param epsilon of the flow, radians
/// \param flowTo runs it again
/// \return steps of Newton's method that roundHolonomy() took
int makeSeamless(
	const EmbeddedSurface& surface,
	const TargetRequest& request,
	double epsilon,
	const FlowTo& flowTo,
	FlowResult& flow);

} // namespace ricci

#endif
