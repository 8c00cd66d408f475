// SPDX-License-Identifier: GPL-3.0-or-later
// Conformal invariants, read off a flat metric laid out in the plane.
#ifndef RICCI_INVARIANTS_H
#define RICCI_INVARIANTS_H

#include "../cut/cut_graph.h"
#include "../layout/planar_layout.h"

#include <array>
#include <complex>

namespace ricci {

/// Translation (in the plane of the layout) between the two sides of cut edge \p e: from the side
/// of its halfedge to that of the twin. Meaningful where the metric's holonomy is a translation.
std::complex<double> period(const Triangulation& t, const PlanarLayout& layout, Edge e);

/// Moves a quotient of two periods into the fundamental domain of the modular group [Serre 1973]:
/// Im > 0, |Re| <= 1/2, |tau| >= 1, with Re >= 0 where both signs are possible on its border.
std::complex<double> reduceToFundamentalDomain(std::complex<double> tau);

/// Conformal modulus of a flat torus: the quotient of two periods that span its lattice, reduced.
/// \pre \p cut has two generators
std::complex<double>
torusModulus(const Triangulation& t, const PlanarLayout& layout, const CutGraph& cut);

/// Conformal modulus ln(r2/r1) / 2 pi of a flat annulus with straight boundaries, a cylinder: its
/// height over its circumference, from its \p area in the layout and the translation across the
/// cut.
/// \pre \p cut has an edge
double annulusModulus(
	const Triangulation& t, const PlanarLayout& layout, const CutGraph& cut, double area);

/// Largest distance of the rotation across a seam from a multiple of pi / 2, radians. The rotation is the
/// one that takes the edges of one side, from one end of the seam to the other, nearest to those of the
/// other side [Kabsch 1976].
/// \param cut of the domain's surface
double quarterTurnError(const FlowDomain& domain, const FlatMesh& map, const CutGraph& cut);

/// Longer over shorter side of a surface laid out as a rectangle with these \p corners, in boundary
/// order. Opposite sides are averaged.
double rectangleAspect(
	const Triangulation& t, const PlanarLayout& layout, const std::array<Vertex, 4>& corners);

} // namespace ricci

#endif
