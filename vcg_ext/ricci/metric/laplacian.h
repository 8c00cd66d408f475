// SPDX-License-Identifier: GPL-3.0-or-later
// The Laplacian of piecewise linear functions on flat triangles.
#ifndef RICCI_LAPLACIAN_H
#define RICCI_LAPLACIAN_H

#include "../mesh/elements.h"
#include "../mesh/triangulation.h"

#include <Eigen/SparseCore>

#include <limits>

namespace ricci {

/// Half the sum of the cotangents of the angles opposite to each edge [Pinkall Polthier 1993].
/// \param lengths of the edges
/// \param maxCotangent bound of each cotangent, of either sign; finite where triangles may be degenerate
EdgeArray<double> cotangentWeights(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	double maxCotangent = std::numeric_limits<double>::infinity());

/// [vertex] A third of the area of its triangles.
VertexVector vertexAreas(const Triangulation& t, const EdgeArray<double>& lengths);

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
