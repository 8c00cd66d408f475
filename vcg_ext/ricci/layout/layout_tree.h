// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_LAYOUT_TREE_H
#define RICCI_LAYOUT_TREE_H

#include "../surface/triangulation.h"

#include <vector>

namespace ricci {

/// The order in which triangles are laid out one after another across the edges with isCut 0: for
/// every triangle but \p root the halfedge across which it is entered, its neighbour always coming
/// before it. Across a side that is short in its triangle directions are lost by as many units of
/// rounding as the longest side is longer: triangles are reached by the way that loses least
/// (Dijkstra), which also is a way through few triangles.
/// \param lengths [edge]
/// \return halfedges of the entered triangles
std::vector<int> layoutTree(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<char>& isCut,
	int root);

} // namespace ricci

#endif
