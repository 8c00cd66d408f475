// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CIRCLE_PACKING_H
#define RICCI_CIRCLE_PACKING_H

#include "../surface/triangulation.h"

#include <vector>

namespace ricci {

/// Discrete conformal class and one member of it (Definition 3.5): a triangulation, an inversive
/// distance on each edge, and a circle at each vertex.
struct CirclePacking
{
	Triangulation triangulation;
	std::vector<double> delta; ///< [edge] I - 1; at least 0 where circles are tangent or disjoint
	std::vector<double> u;     ///< [vertex] ln radius (Eq. 6, Euclidean)
};

/// Straight-line length of each edge of \p triangulation between \p positions.
std::vector<double>
edgeLengths(const Triangulation& triangulation, const std::vector<Point3>& positions);

/// Initial radii of paper 4.1: the least of (l_ij + l_ki - l_jk) / 2 over the triangles at i. They
/// give gamma_i + gamma_j <= l_ij, hence I >= 1 on every edge. Positive if every triangle satisfies
/// the strict triangle inequality.
std::vector<double>
initialRadii(const Triangulation& triangulation, const std::vector<double>& lengths);

/// Inversive distances (Eq. 3, Euclidean) that make the packing metric equal \p lengths exactly.
/// \p radii as of initialRadii(): values of delta that rounding puts below 0 become 0.
CirclePacking inversiveDistancePacking(
	Triangulation triangulation,
	const std::vector<double>& lengths,
	const std::vector<double>& radii);

/// Conventional flow of paper 5.1: the same radii, each inversive distance forced into [0, 1], so
/// that the packing metric no longer is the mesh's own.
CirclePacking thurstonPacking(
	Triangulation triangulation,
	const std::vector<double>& lengths,
	const std::vector<double>& radii);

} // namespace ricci

#endif
