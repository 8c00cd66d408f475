// SPDX-License-Identifier: GPL-3.0-or-later
// The folder cones: which curvature each vertex is to have, presets, placed cones, quarter turns. It asks for
// flows, and runs none.
#ifndef RICCI_TARGET_CURVATURE_H
#define RICCI_TARGET_CURVATURE_H

#include "../flow/ricci_flow.h"
#include "cone_placement.h"

#include <optional>

namespace ricci {

/// Chooses the target of the Euclidean flow (paper 5.2, 5.3) and checks that a metric with that
/// curvature can exist: K < 2 pi inside and K < pi on the boundary; and sum K = 2 pi chi
/// (Gauss-Bonnet) where all is prescribed, or sum K inside > 2 pi chi - pi (number of boundary
/// vertices) where the boundary is free. For closed surfaces and flips these conditions suffice
/// [Bobenko Lutz 2023].
/// \param surface whose positions choose the corners of a rectangle if none are selected
/// \param start of the flow on \p surface; placed cones belong to it
/// \throw InvalidOption if the mode does not fit the topology or the selection
/// \throw InadmissibleCurvature otherwise, with the numbers that contradict each other
/// \throw SolverFailed where cones are placed, or curvatures prescribed with a free boundary
Target
chooseTarget(const EmbeddedSurface& surface, InitialPacking& start, const TargetRequest& request);

/// Whether \p flow changes areas no more than is asked for, or costs little more than its target was expected to;
/// or its target was chosen by neither (Target::expected).
/// \param flow with intrinsic flips
bool keepsAreas(
	const EmbeddedSurface& surface, const FlowResult& flow, const TargetRequest& request);

/// What \p flow has in excess of one that keeps areas: areaExcess() where a spread is asked for, else what its map
/// costs (MapCost).
/// \pre the target has an expected cost
double
areaCost(const EmbeddedSurface& surface, const FlowResult& flow, const TargetRequest& request);

/// The next target after \p flow: cones as moreCones() finds them; none where the target was chosen to
/// cost least and no other is expected to cost less by what another flow is worth.
/// \param start of another flow on \p surface, as for chooseTarget()
/// \param flow with intrinsic flips
/// \pre !keepsAreas(\p surface, \p flow, \p request)
/// \throw as chooseTarget()
std::optional<Target> targetToKeepAreas(
	const EmbeddedSurface& surface,
	InitialPacking& start,
	const FlowResult& flow,
	const TargetRequest& request);

/// The target with these cones. A boundary is free or, if it is not to be, takes the rest of the
/// curvature in proportion to its length.
/// \throw as chooseTarget()
Target targetWithCones(
	const EmbeddedSurface& surface, const PlacedCones& cones, const TargetRequest& request);

} // namespace ricci

#endif
