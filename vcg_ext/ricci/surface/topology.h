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

/// The interior edges outside a spanning tree of the vertices that a spanning tree of the faces does not cross
/// either: 2 genus, and one for each boundary loop but the first, unless the tree has its vertices as one.
/// The faces' tree crosses the edges with the longest loops first, and of equals the one with the lowest
/// number, so that those with the shortest are left (greedy system of loops [Erickson Whittlesey 2005]).
/// \param inTree 1 on the edges of the tree
/// \param loopLength of the loop that an edge closes with the tree, where it is not in it
std::vector<Edge> edgesBesideCotree(
	const Triangulation& t, const EdgeArray<char>& inTree, const EdgeArray<double>& loopLength);

} // namespace ricci

#endif
