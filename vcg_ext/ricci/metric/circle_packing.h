// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CIRCLE_PACKING_H
#define RICCI_CIRCLE_PACKING_H

#include "../surface/triangulation.h"

namespace ricci {

/// Discrete conformal class (Definition 3.5): a triangulation and an inversive distance on each edge. With
/// a circle at each vertex it is a metric.
struct CirclePacking
{
	Triangulation triangulation;
	EdgeArray<double> delta; ///< I - 1; at least 0 where circles are tangent or disjoint
};

/// Initial radii of paper 4.1: the minimum of (l_ij + l_ki - l_jk) / 2 over the triangles at i,
/// infinite where there is none. They give gamma_i + gamma_j <= l_ij, hence I >= 1 on every edge.
/// Positive if every triangle satisfies the strict triangle inequality.
VertexArray<double> initialRadii(const Triangulation& t, const EdgeArray<double>& lengths);

/// Inversive distances less one (Eq. 3, Euclidean) of circles of these \p radii at this distance, with
/// which the packing metric equals \p lengths. Values below 0, which only rounding makes of radii as
/// of initialRadii(), become 0.
EdgeArray<double> inversiveDistancesLessOne(
	const Triangulation& t, const EdgeArray<double>& lengths, const VertexArray<double>& radii);

/// The same clamped to [-1, 0], for the conventional flow of paper 5.1: the packing metric no longer is
/// that of \p lengths.
EdgeArray<double> thurstonDistancesLessOne(
	const Triangulation& t, const EdgeArray<double>& lengths, const VertexArray<double>& radii);

} // namespace ricci

#endif
