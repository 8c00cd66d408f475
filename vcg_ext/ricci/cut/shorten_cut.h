// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SHORTEN_CUT_H
#define RICCI_SHORTEN_CUT_H

#include "coarse_surface.h"
#include "cut_segments.h"

namespace ricci {

/// Shortens a cut graph, whose complement is a disk, by local search. The complement stays a disk,
/// and the cut still reaches every marked vertex and every boundary loop.
///
/// Two moves are repeated while they gain.
///
/// Exchange: without one of its segments (a path between two nodes) the cut leaves an annulus. Any
/// path between the two boundaries A and B of the annulus makes it a disk again, and the shortest
/// is taken. It may start and end anywhere, so the move straightens seams, moves branches, and
/// changes the homotopy class of loops.
///
///        +---------------+        +---------------+
///        | A +---+       |        | A +---+       |
///        |   | B |       |   ->   |---| B |       |
///        |   +---+--. .--|        |   +---+       |
///        |           '   |        |               |
///        +---------------+        +---------------+
///
/// Rebuild: without all segments at a node several boundaries remain. They are joined anew one
/// after another by shortest paths or, where they are three, by paths to the vertex with the least
/// sum of distances (key-vertex elimination in the Steiner tree problem [Uchoa Werneck 2012]).
///
///        A       B        A       B        A ----- B
///        |       |         '.   .'                 |
///        +---o---+   ->      'o'       or          |
///            |                |                    |
///            C                C                C --+
///
/// Then wedges of cones that are too wide (cone_wedges.h) are divided, and the moves are repeated that
/// make none too wide.
///
/// Division: the shortest path from within the wedge to the rest of the cut leaves two disks; without
/// the longest segment between them they are one again. Path and segment are those that lengthen the
/// cut least.
///
///        +-------+-------+        +-------+-------+
///        |       |       |        |       |       |
///        |   o---+       |   ->   |   o   |       |
///        |       |       |        |   |   |       |
///        +-------+-------+        +---+---+    ---+
///
/// Deterministic: of equally short paths always the same is taken. Between two moves the complement
/// of the cut is a disk.
/// \param cut changed in place; its costs are positive
/// \param corners angles at cones, from coneCorners(); empty: wedges may be as wide as they like
/// \param parts a coarse surface, with which every move looks for paths only in the parts (vertices of
/// one centre) at which what it takes out lies, and in those beside them; null: everywhere
/// \return whether a bound on the work has ended it
/// \pre the surface opened along \p cut is a disk, or nothing is cut
bool shortenCut(
	CutSegments& cut,
	const HalfedgeArray<double>& corners = {},
	const CoarseSurface* parts = nullptr);

} // namespace ricci

#endif
