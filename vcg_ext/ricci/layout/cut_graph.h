// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CUT_GRAPH_H
#define RICCI_CUT_GRAPH_H

#include "../surface/triangulation.h"

#include <functional>
#include <vector>

namespace ricci {

/// Edges along which a surface is cut open into one topological disk.
struct CutGraph
{
	std::vector<char> isCut;     ///< [edge] 1 on the cut; boundary edges are never on it
	std::vector<int> generators; ///< 2 genus edges of the cut: the loops of the surface that cross
								 ///< one of them once, and no other, generate its homology with
								 ///< every boundary loop filled
	int edgeCount = 0;
	double length = 0.0;
};

/// Short cut graph by a tree and a cotree (Erickson and Whittlesey 2005, greedy homotopy
/// generators, paper's [EW05]): a shortest-path tree of the edges, a spanning tree of the dual with
/// the longest loops first, and the 2 genus edges in neither. Every boundary loop counts as one
/// point and is reached by the cut, as is every vertex with \p marked (cones). The shortest of the
/// graphs from a few well-spread roots is shortened further (shortenCut()). Deterministic.
/// \param lengths [edge] positive; or whatever else is to be short in sum
/// \param forbidden [edge] 1 where the cut must not run; may be empty
/// \param tick see shortenCut()
/// \throw Error if the forbidden edges leave no cut
CutGraph cutToDisk(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<char>& marked,
	const std::vector<char>& forbidden,
	const std::function<void()>& tick = [] {});

} // namespace ricci

#endif
