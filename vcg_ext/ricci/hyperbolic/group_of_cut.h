// SPDX-License-Identifier: GPL-3.0-or-later
// The folder hyperbolic: what a map to the Poincaré disk alone needs, its target, group, polygon, and disks in
// floats. The geometry of its triangles is in metric, their layout in layout.
#ifndef RICCI_GROUP_OF_CUT_H
#define RICCI_GROUP_OF_CUT_H

#include "../cut/cut_graph.h"
#include "../layout/hyperbolic_layout.h"
#include "../layout/parametrization.h"
#include "../mesh/triangulation.h"

namespace ricci {

/// Gives all edges of an arc of the cut the most exact side pairing among them: except for rounding an
/// arc has one. Arcs end where the cut branches, at cones and at the boundary.
/// \param pairing [edge] of the layout, for the edges of the cut
EdgeArray<SidePairing>
pairingOfArcs(const Triangulation& t, const CutGraph& cut, const EdgeArray<SidePairing>& pairing);

/// Computes the group from the side pairings of a layout. With each boundary loop drawn together to
/// a point the cut is a graph, and all its edges but CutGraph::generators form a spanning tree. On
/// the way round this tree, the crossings of the 4 g sides of the generators spell the relation of
/// a polygon whose corners are one point; canonicalBases() makes it canonical in many ways, and
/// bestConditioned() takes one.
///
/// \param pairing [edge] pairingOfArcs()
/// \param canonical find handles, relation and relationError, too
/// \throw InternalError if the word of the polygon is none
FuchsianGroup fuchsianGroup(
	const Triangulation& t,
	const CutGraph& cut,
	const EdgeArray<SidePairing>& pairing,
	bool canonical = false);

} // namespace ricci

#endif
