// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TURN_SEARCH_H
#define RICCI_TURN_SEARCH_H

#include "../flow/quarter_turns.h"
#include "cone_placement.h"

#include <optional>

namespace ricci {

/// What a metric with placed cones costs that is to turn by quarter turns round all loops.
struct TurnCost
{
	double angles = 0.0; ///< mean square of the Beltrami coefficient that the turns cost
	double areas = 0.0;  ///< mean square of the logarithm of the scale factor
	int cones = 0;

	double total() const;
};

/// That of \p flow.
TurnCost turnCost(const EmbeddedSurface& surface, const FlowResult& flow, const LoopTurns& turns);

/// Cones near those of \p flow with turns nearer to multiples of pi / 2. Curvature that moves from p
/// to q changes a turn by (y(q) - y(p)) times as much, where y is its derivative by curvature
/// (LoopTurns::byCurvature), and areas as the linear problem at the metric of \p flow says. Greedy:
/// one cone or quarter turn, or two, move to where TurnCost::total() falls most, again and again.
/// \param flow on \p surface, with intrinsic flips, the boundary of \p request, and cones with
/// curvatures that are multiples of pi / 2
/// \param radius how far a cone may move at once, as a share of the square root of the area
/// \return none where nothing is better
/// \throw SolverFailed
std::optional<PlacedCones> conesToRoundTurns(
	const EmbeddedSurface& surface,
	const FlowResult& flow,
	const LoopTurns& turns,
	const ConeRequest& request,
	double radius);

} // namespace ricci

#endif
