// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SEAMLESS_CONES_H
#define RICCI_SEAMLESS_CONES_H

#include "../curvature/cone_placement.h"
#include "seamless_metric.h"

#include <optional>

namespace ricci {

/// What a metric with placed cones costs whose holonomies are to be multiples of pi / 2.
struct SeamlessCost
{
	double angles = 0.0; ///< mean square of the Beltrami coefficient that the holonomies cost
	double areas = 0.0;  ///< mean square of the logarithm of the scale factor
	int cones = 0;

	double total() const;
};

/// That of \p flow.
SeamlessCost
seamlessCost(const EmbeddedSurface& surface, const FlowResult& flow, const Holonomy& holonomy);

/// Cones near those of \p flow with holonomies nearer to multiples of pi / 2. Curvature that moves from p
/// to q changes a holonomy by (y(q) - y(p)) times as much, where y is its derivative by curvature
/// (Holonomy::byCurvature), and areas as the linear problem at the metric of \p flow says. Greedy:
/// one cone or quarter turn, or two, move to where SeamlessCost::total() falls most, again and again.
/// \param flow on \p surface, with intrinsic flips, the boundary of \p request, and cones with
/// curvatures that are multiples of pi / 2
/// \param radius how far a cone may move at once, as a share of the square root of the area
/// \return none where nothing is better
/// \throw SolverFailed
std::optional<PlacedCones> seamlessCones(
	const EmbeddedSurface& surface,
	const FlowResult& flow,
	const Holonomy& holonomy,
	const ConeRequest& request,
	double radius);

} // namespace ricci

#endif
