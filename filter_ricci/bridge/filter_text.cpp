// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge.h"

#include <stdexcept>

namespace filter_ricci {

FilterText filterText(int filter)
{
	const QString reference = "<br>See: Yang, Guo, Luo, Hu, Gu, <i>Generalized Discrete Ricci "
							  "Flow</i>, Computer Graphics Forum 28(7), 2009.";
	switch (filter) {
	case Euclidean:
		return {
			"Generalized Ricci Flow (Euclidean)",
			"compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge",
			"<b>UV unwrap</b>: flattens any triangle mesh, with its angles kept, into few charts "
			"that do not overlap. A conformal parametrization per wedge, by the generalized "
			"discrete Ricci flow; the vertex quality becomes the distortion (1 = angles kept)." +
				reference};
	case Hyperbolic:
		return {
			"Generalized Ricci Flow (Hyperbolic)",
			"compute_texcoord_parametrization_ricci_flow_hyperbolic_per_wedge",
			"<b>Hyperbolic uniformization</b>: flattens a mesh with handles or holes into the "
			"Poincaré disk, with its angles kept. The parametrization is by the conformal metric "
			"of curvature -1, for meshes of negative Euler characteristic (two handles, a handle "
			"and a boundary, or three boundaries), or any with cones that make up for it. Texture "
			"coordinates are stored per wedge, and the distortion (1 = angles kept) as the "
			"vertex quality." +
				reference};
	default:
		throw std::logic_error("This plugin has no filter with that id.");
	}
}

} // namespace filter_ricci
