// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_ROUND_TURNS_H
#define RICCI_ROUND_TURNS_H

#include "../curvature/target_curvature.h"
#include "flatten_component.h"

namespace ricci {

/// Where the cones were placed with multiples of pi / 2: runs the flow again to cones that bring the
/// turns of loops nearer to multiples of pi / 2, as long as that helps, and then rounds the turns of
/// the best metric, see roundTurns(). So all seams of the map are rotations by quarter turns.
/// \param surface that the flow of \p map ran on; the request its target was chosen by
void roundLoopTurns(
	const EmbeddedSurface& surface,
	const TargetRequest& request,
	const Options& options,
	ComponentMap& map);

} // namespace ricci

#endif
