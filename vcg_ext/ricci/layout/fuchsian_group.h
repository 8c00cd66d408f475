// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FUCHSIAN_GROUP_H
#define RICCI_FUCHSIAN_GROUP_H

#include "cut_graph.h"
#include "hyperbolic_layout.h"

#include <vector>

namespace ricci {

/// The group of motions of the disk that a hyperbolic surface is the quotient by: the deck
/// transformations of its universal cover, as the layout of the surface cut open sees them.
struct FuchsianGroup
{
	/// a1, b1, ..., ag, bg: a canonical basis. With [a,b] = a b a^-1 b^-1,
	/// [a1,b1] ... [ag,bg] e1 ... en = +-1.
	std::vector<DiskIsometry> handles;

	/// One motion for each boundary loop and cone, in the order of the relation. A boundary that is
	/// geodesic, of length L, has |trace| = 2 cosh(L / 2); a cone of angle t is a rotation, |trace| =
	/// 2 |cos(t / 2)|.
	std::vector<DiskIsometry> ends;
	std::vector<int> endVertex; ///< [end] a vertex of the loop, or the cone

	/// The canonical relation letter by letter, a1, b1, a1^-1, b1^-1, ..., e1, ..., en, before they
	/// are rounded.
	std::vector<ExtendedIsometry> relation;

	/// [side of the cut] Motions to the neighbouring copies of the fundamental domain: they pair the
	/// sides of the polygon that the cut surface is, one for each arc of the cut and direction.
	std::vector<DiskIsometry> sides;

	/// What the layout misses when it comes round: largest entry, less +-1, of the product of the
	/// motions met on the way round the corner of the polygon, as measured.
	double polygonError = 0.0;
	/// The same for the closed ways round each single vertex at which the cut branches.
	double closingError = 0.0;

	/// Largest entry of the left-hand side of the canonical relation less +-1. The generators it is
	/// made of have been moved by about polygonError to fit. Canonical generators are long words in
	/// the motions of the polygon's sides, and the relation multiplies large motions: rounding
	/// leaves more of it, the higher the genus.
	double relationError = 0.0;
};

/// Computes the group. The cut is a graph with a spanning tree (every cut edge but
/// CutGraph::generators) once each boundary loop is drawn together to a point. Walking round the
/// tree, crossings of the 4 g sides of the generators spell the relation of a polygon whose
/// corners are one point; cutting and glueing it (each step takes x P y Q x^-1 R y^-1 S to [a,b] P S
/// R Q with a = (RQ)^-1 x, b = P y Q) makes the relation canonical.
///
/// \param transition [edge] on the cut: see Transition
/// \param cones [vertex] 1 at interior vertices that are not regular points of the metric
FuchsianGroup fuchsianGroup(
	const Triangulation& t,
	const CutGraph& cut,
	const std::vector<Transition>& transition,
	const std::vector<char>& cones);

/// Motions to the copies of the fundamental domain in \p rings rings round it, the identity first;
/// ring 1 are the copies that share a side with it, and so on.
/// \param most no more motions than this
struct Tiling
{
	std::vector<DiskIsometry> motions;
	std::vector<int> ring;
	bool complete = true; ///< false if \p most, or the resolution of the disk, ended it
};
Tiling tiling(const std::vector<DiskIsometry>& sides, int rings, int most);

} // namespace ricci

#endif
