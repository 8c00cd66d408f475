// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge.h"

#include <stdexcept>

namespace filter_ricci {

FilterText filterText(int filter)
{
	const QString reference = "<br>See: Yang, Guo, Luo, Hu, Gu, <i>Generalized Discrete Ricci "
							  "Flow</i>, Computer Graphics "
							  "Forum 28(7), 2009.";
	switch (filter) {
	case Euclidean:
		return {
			"Generalized Ricci Flow (Euclidean)",
			"compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge",
			"<b>Conformal texture coordinates</b> per wedge for any triangle mesh, unrolled from "
			"the "
			"metric with the curvature asked for, which the discrete Ricci flow finds. The vertex "
			"quality becomes the distortion (1 = angles kept)." +
				reference};
	case Hyperbolic:
		return {
			"Generalized Ricci Flow (Hyperbolic)",
			"compute_texcoord_parametrization_ricci_flow_hyperbolic_per_wedge",
			"<b>Hyperbolic uniformization</b>: the metric of curvature -1 that is conformal to the "
			"mesh's own, unrolled into the Poincaré disk. For meshes of negative Euler "
			"characteristic (two handles, a handle and a boundary, or three boundaries), or any "
			"with cones that make up for it. The vertex quality becomes the distortion (1 = angles "
			"kept)." +
				reference};
	default:
		throw std::logic_error("This plugin has no filter with that id.");
	}
}

} // namespace filter_ricci
