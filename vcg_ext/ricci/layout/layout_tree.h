// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_LAYOUT_TREE_H
#define RICCI_LAYOUT_TREE_H

#include "../surface/triangulation.h"

#include <vector>

namespace ricci {

/// The order in which triangles are laid out one after another across the edges with isCut 0: a
/// spanning tree of the triangles with the root \p root, as the halfedges across which they are
/// entered. A triangle's neighbour in the tree always comes before it.
///
/// Across a side that is short in its triangle, directions lose as many units of rounding as the
/// longest side is times longer. The tree reaches every triangle by the way that loses least
/// [Dijkstra 1959], which also keeps the number of triangles on the way low. The order is
/// deterministic.
/// \param lengths positive
/// \return for each triangle that can be reached, but for the root, the halfedge of it that is
/// entered first
std::vector<Halfedge> layoutTree(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const EdgeArray<char>& isCut,
	Face root);

} // namespace ricci

#endif
