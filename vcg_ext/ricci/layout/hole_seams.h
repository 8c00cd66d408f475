// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HOLE_SEAMS_H
#define RICCI_HOLE_SEAMS_H

#include "../cut/cut_graph.h"
#include "planar_layout.h"

namespace ricci {

/// Finds the boundary loops round which the metric closes by rotation and translation, so that it
/// needs no seam at them: every edge of the cut at such a loop has both of its sides in one place
/// of the layout.
/// \param layout of \p t, cut open along \p isCut
/// \return 1 at the vertices of these loops
VertexArray<char>
loopsThatClose(const Triangulation& t, const PlanarLayout& layout, const EdgeArray<char>& isCut);

/// Takes back the parts of \p cut that end at holes round which the metric closes: the chart goes
/// round them in one piece. Where the cut runs on through such a hole to another place that it has
/// to reach, it stays.
/// \param cost what CutGraph::length adds up
/// \param closes 1 on boundary loops whose holonomy is trivial, in rotation and in translation
/// \param marked 1 at cones, which the cut must reach
void dropSeamsToHoles(
	const Triangulation& t,
	const EdgeArray<double>& cost,
	const VertexArray<char>& closes,
	const VertexArray<char>& marked,
	CutGraph& cut);

} // namespace ricci

#endif
