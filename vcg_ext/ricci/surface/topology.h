// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TOPOLOGY_H
#define RICCI_TOPOLOGY_H

#include "../base/surface_type.h"
#include "triangulation.h"

#include <vector>

namespace ricci {

/// Topology of one connected surface.
struct Topology
{
	SurfaceType type;
	VertexArray<char> boundary;             ///< 1 on the boundary
	std::vector<std::vector<Vertex>> loops; ///< of each boundary loop, surface on the left
};

/// \pre \p t is connected
Topology topologyOf(const Triangulation& t);

} // namespace ricci

#endif
