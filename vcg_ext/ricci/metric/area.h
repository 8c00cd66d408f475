// SPDX-License-Identifier: GPL-3.0-or-later
// The Laplacian of piecewise linear functions on flat triangles.
#ifndef RICCI_AREA_H
#define RICCI_AREA_H

#include "../base/numbers.h"
#include "../base/points.h"
#include "../mesh/elements.h"
#include "../mesh/triangulation.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>

namespace ricci {

/// Lengths of the sides of a face, in the order of its halfedges.
inline std::array<double, 3>
sidesOf(const Triangulation& t, const EdgeArray<double>& lengths, Face f)
{
	const auto h = t.halfedges(f);
	return {lengths[h[0].edge()], lengths[h[1].edge()], lengths[h[2].edge()]};
}

/// Area of a surface of flat triangles with these side lengths.
double euclideanArea(const Triangulation& t, const EdgeArray<double>& lengths);

/// Area of a surface of triangles of curvature -1 with these side lengths: the sum of
/// hyperbolicArea(sides). It does not use the angles that the flow has summed, so that it can check
/// them by Gauss-Bonnet.
double hyperbolicArea(const Triangulation& t, const EdgeArray<double>& lengths);

/// Apex of a plane triangle over its base, which runs from 0 along the x axis, from the lengths of the sides by Heron's
/// formula. Where these break the triangle inequality, it lies on that axis.
/// \param left of the side at 0
/// \pre \p base > 0
inline Point2 triangleApex(double base, double left, double right)
{
	const double heron = (base + left + right) * (base + left - right) * (base + right - left) *
						 (left + right - base);
	return {
		0.5 * ((left - right) * (left + right) / base + base),
		std::sqrt(std::max(0.0, heron)) / (2 * base)};
}

/// Half the sum of the cotangents of the angles opposite to each edge [Pinkall Polthier 1993].
/// \param lengths of the edges
/// \param maxCotangent bound of each cotangent, of either sign; finite where triangles may be degenerate
EdgeArray<double> cotangentWeights(
	const Triangulation& t, const EdgeArray<double>& lengths, double maxCotangent = kInfinity);

/// [vertex] A third of the area of its triangles, as a share of the whole.
VertexVector areaShares(const Triangulation& t, const EdgeArray<double>& lengths);

/// The lower triangle of L + D: for the Laplacian L with the \p weights of the edges, (L f)_i =
/// sum w_ij (f_i - f_j), restricted to the unknown vertices, and the diagonal D.
/// \param row of each vertex's unknown, or -1
/// \param diagonal of D, by row
Eigen::SparseMatrix<double> laplacian(
	const Triangulation& t,
	const EdgeArray<double>& weights,
	const VertexArray<int>& row,
	Eigen::VectorXd diagonal);

} // namespace ricci

#endif
