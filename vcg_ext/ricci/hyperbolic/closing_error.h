// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CLOSING_ERROR_H
#define RICCI_CLOSING_ERROR_H

#include "../cut/cut_graph.h"
#include "../flow/target.h"
#include "../layout/corner_layout.h"
#include "../layout/flat_mesh.h"

#include <vector>

namespace ricci {

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
