// SPDX-License-Identifier: GPL-3.0-or-later
// The folder hyperbolic: what a map to the Poincaré disk alone needs, its target, group, polygon, and disks in
// floats. The geometry of its triangles is in metric, their layout in layout.
#ifndef RICCI_GROUP_OF_CUT_H
#define RICCI_GROUP_OF_CUT_H

#include "../cut/cut_graph.h"
#include "../flow/target.h"
#include "../layout/corner_layout.h"
#include "../layout/hyperbolic_layout.h"
#include "../layout/parametrization.h"
#include "../mesh/triangulation.h"

#include <vector>

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

/// How far a layout in the Poincaré disk is from closing up: the largest error of the isometries that
/// remain round the vertices and the boundary loops of its cut. Their conjugates generate all relations
/// of the group of the side pairings.
///
/// - Round a regular vertex nothing remains: the angle in radians by which the isometry turns, or the
///   hyperbolic length by which it moves the vertex.
/// - Round a cone of angle t a rotation remains: the difference of |trace| from 2 |cos(t / 2)|.
/// - Round a geodesic boundary a translation of its length remains: the difference of
///   2 acosh(|trace| / 2) from the hyperbolic length of the loop's edges in the layout
///   [Beardon 1983]. Other boundaries are left out.
///
/// Each isometry is the product of the side pairings that are crossed on the way round, every one as
/// seen from the places of the vertex on its two sides. So all factors are about as large as what
/// remains, and rounding is not multiplied by the way from 0 to the vertex and back.
/// \param layout of \p t in the Poincaré disk, open along the cut; its pairing is that of pairingOfArcs()
/// \param target curvature that the metric has reached
double closingError(
	const Triangulation& t, const CutGraph& cut, const SurfaceLayout& layout, const Target& target);

/// The same of a finished map, by its points alone: the largest difference of the hyperbolic lengths of the two
/// sides of a seam; and at inner vertices on seams, that of the sum of the angles of the triangles from 2 pi less
/// the curvature, up to full turns, as a length: times the shortest side there.
/// \param disks with \ref FlatMesh::across, each chart in the unit disk
/// \param curvature [vertex] of the metric; 0 at points beyond its end
double closingError(const FlatMesh& disks, const std::vector<double>& curvature);

} // namespace ricci

#endif
