// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_KEEP_AREAS_H
#define RICCI_KEEP_AREAS_H

#include "../curvature/target_curvature.h"
#include "flatten.h"

namespace ricci {

/// The promise of Target::maxSpread: while the metric of map.flow changes areas more than its target
/// was chosen for, runs the flow again, to targetToKeepAreas(), in a bounded number of rounds. The
/// metric that keeps areas best stays in map.flow.
/// \param surface on which map.flow has run
/// \throw Stopped
void keepAreas(
	const EmbeddedSurface& surface,
	const TargetRequest& request,
	const Options& options,
	ComponentMap& map);

} // namespace ricci

#endif
