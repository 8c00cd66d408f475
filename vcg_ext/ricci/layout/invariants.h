// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_INVARIANTS_H
#define RICCI_INVARIANTS_H

#include "cut_graph.h"
#include "planar_layout.h"

#include <array>
#include <complex>

namespace ricci {

/// Translation (in the plane of the layout) between the two sides of cut edge \p e: from the side
/// of halfedge 2 e to that of its twin. Meaningful where the metric's holonomy is a translation.
std::complex<double> period(const Triangulation& t, const PlanarLayout& layout, int e);

/// Moves a quotient of two periods into the fundamental domain of the modular group:
/// Im > 0, |Re| <= 1/2, |tau| >= 1, with Re >= 0 where both signs are possible on its border.
std::complex<double> reduceToFundamentalDomain(std::complex<double> tau);

/// Conformal modulus of a flat torus, reduced. \p cut must have two generators.
std::complex<double>
torusModulus(const Triangulation& t, const PlanarLayout& layout, const CutGraph& cut);

/// Conformal modulus ln(r2/r1) / 2 pi of a flat annulus with straight boundaries, a cylinder: its
/// height over its circumference, from its \p area and the translation across the cut.
double annulusModulus(
	const Triangulation& t, const PlanarLayout& layout, const CutGraph& cut, double area);

} // namespace ricci

#endif
