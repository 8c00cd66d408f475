// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HOLONOMY_CHECK_H
#define RICCI_HOLONOMY_CHECK_H

#include "../flow/target.h"
#include "../layout/planar_layout.h"
#include "../measure/fuchsian_group.h"
#include "../surface/topology.h"

namespace ricci {

/// Largest difference between the hyperbolic length of a geodesic boundary loop, summed over its
/// edges in the layout, and the length 2 acosh(|trace| / 2) of the closed geodesic that its
/// generator of the group moves along itself [Beardon 1983]: they are one curve. 0 where no
/// boundary is geodesic.
/// \param topology of \p t
/// \param layout of \p t in the Poincaré disk
/// \param target curvature that the metric has reached
double boundaryHolonomyError(
	const FuchsianGroup& group,
	const Triangulation& t,
	const Topology& topology,
	const PlanarLayout& layout,
	const Target& target);

} // namespace ricci

#endif
