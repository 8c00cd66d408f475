// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SHORTEN_CUT_H
#define RICCI_SHORTEN_CUT_H

#include "../mesh/triangulation.h"

namespace ricci {

/// Shortens a cut graph, whose complement is a disk. The complement stays a disk, and the cut still reaches every
/// marked vertex and every boundary loop.
///
/// Segments, the longest first, are exchanged where that gains: paths of the cut between vertices where it branches
/// or ends, marked vertices and those on the boundary. Without one of them the cut leaves an annulus. Any path
/// between the two boundaries A and B of the annulus makes it a disk again, and the shortest is taken. It may
/// start and end anywhere, so the move straightens seams, moves branches, and changes the homotopy class of
/// loops.
///
///        +---------------+        +---------------+
///        | A +---+       |        | A +---+       |
///        |   | B |       |   ->   |---| B |       |
///        |   +---+--. .--|        |   +---+       |
///        |           '   |        |               |
///        +---------------+        +---------------+
///
/// Deterministic: of equally short paths always the same is taken. Between two moves the complement
/// of the cut is a disk.
/// \param cost of the edges, positive; infinite where no path may run
/// \param marked 1 at vertices that the cut reaches, inside
/// \param isCut changed in place
/// \pre the surface opened along the cut is a disk, or nothing is cut; the cut has no dead ends but at
/// marked vertices
void shortenCut(
	const Triangulation& t,
	const EdgeArray<double>& cost,
	const VertexArray<char>& marked,
	EdgeArray<char>& isCut);

} // namespace ricci

#endif
