// SPDX-License-Identifier: GPL-3.0-or-later
// The folder hyperbolic: what a map to the Poincaré disk alone needs, its group, polygon, and disks in floats. The
// geometry of its triangles is in metric, their targets in cones, their layout in layout.
#ifndef RICCI_GROUP_OF_CUT_H
#define RICCI_GROUP_OF_CUT_H

#include "../cut/cut_graph.h"
#include "../flow/target.h"
#include "../layout/corner_layout.h"
#include "../layout/hyperbolic_layout.h"
#include "../layout/parametrization.h"
#include "../mesh/triangulation.h"
#include "../numerics/disk_isometry.h"

#include <complex>
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

// ---- What is drawn of the group

/// Copies of a fundamental domain in the disk.
struct Tiling
{
	std::vector<DiskIsometry> deck; ///< the domain to its copies, the identity first
	std::vector<int> ring;          ///< of each copy: how many sides lie between it and the domain
	bool complete = true; ///< false if the largest number, or the resolution of the disk, ended it
};

/// The copies of the fundamental domain in \p rings rings round it: ring 1 has the copies that
/// share a side with it, ring 2 those that share one with ring 1, and so on.
/// \param sides side pairings of the domain (FuchsianGroup::sides)
/// \param maxCount no more copies than this, the domain itself included
Tiling tiling(const std::vector<DiskIsometry>& sides, int rings, int maxCount);

/// A fundamental polygon with geodesic sides whose corners are all one point of the surface. Side k
/// runs from corner k to corner k + 1 and is a copy of the closed curve of letter k of the
/// canonical relation a1 b1 a1^-1 b1^-1 ... e1 ... en. A closed surface of genus g has 4 g sides,
/// which are paired like the letters; the sides of the peripheral generators e_i have no partner.
struct CanonicalPolygon
{
	std::vector<std::complex<double>>
		corners;           ///< in the Poincaré disk, in the order of the relation
	bool isSimple = false; ///< no side crosses another
	double gap = 0.0;      ///< hyperbolic distance by which the last side misses the first corner
};

/// Computes the polygon for the base point p that minimizes the sum of cosh d(p, g p) over the
/// canonical generators g. On the hyperboloid this sum is the quadratic form -<p, g p>, and p is
/// its timelike eigenvector. The middle corner of the polygon is p itself, so that no corner is a
/// product of more than half of the letters.
///
/// Where the group has no canonical basis, or generators move points so far that rounding leaves a gap
/// above kMaxPolygonGap or takes corners out of the disk, the polygon has no corners.
CanonicalPolygon canonicalPolygon(const FuchsianGroup& group);

} // namespace ricci

#endif
