// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SEAMS_H
#define RICCI_SEAMS_H

#include "../surface/triangulation.h"

#include <functional>
#include <vector>

namespace ricci {

/// Shortens a cut graph, whose complement is a disk, by local search; the complement stays a disk
/// and every vertex of \p marked and every boundary loop stays on the cut or beside it.
///
/// Two moves are repeated while they gain. Exchange: without one of its segments (a path between
/// two nodes) the cut leaves an annulus, and any path between the two boundaries of the annulus
/// makes it a disk again: the shortest is taken. It may start and end anywhere, so the move
/// straightens, moves branches, and changes the homotopy class of loops. Rebuild: without all
/// segments at a node several boundaries remain, which are joined anew one after another by shortest
/// paths or, where they are three, by paths from the vertex with the least sum of distances
/// (key-vertex elimination in the Steiner tree problem, Uchoa and Werneck 2010).
/// \param cost [edge] positive
/// \param forbidden [edge] 1 where the cut must not run; may be empty
/// \param isCut [edge] changed in place; never a boundary edge
/// \param tick is called now and then, many times a second. What it throws ends the search.
void shortenCut(
	const Triangulation& t,
	const std::vector<double>& cost,
	const std::vector<char>& marked,
	const std::vector<char>& forbidden,
	std::vector<char>& isCut,
	const std::function<void()>& tick = [] {});

} // namespace ricci

#endif
