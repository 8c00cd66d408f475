// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HOLE_SEAMS_H
#define RICCI_HOLE_SEAMS_H

#include "cut_graph.h"
#include "planar_layout.h"

#include <vector>

namespace ricci {

/// [vertex] 1 on the boundary loops at which every edge of the cut has both of its sides in one place
/// of the layout. Where the cut ends at such a loop, the metric closes round it, by rotation and
/// translation, and needs no seam there.
std::vector<char>
loopsThatClose(const Triangulation& t, const PlanarLayout& layout, const std::vector<char>& isCut);

/// Takes back the parts of \p cut that end at holes round which the metric closes: the chart goes
/// round them in one piece. Seams that lead on from such a hole stay, with it as a part of them.
/// \param closes [vertex] 1 on boundary loops whose holonomy is trivial, rotation and translation
/// \param marked [vertex] 1 at cones, which the cut must reach
/// \param lengths [edge]
void dropSeamsToHoles(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<char>& closes,
	const std::vector<char>& marked,
	CutGraph& cut);

} // namespace ricci

#endif
