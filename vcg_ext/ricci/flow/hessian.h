// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HESSIAN_H
#define RICCI_HESSIAN_H

#include "curvature_map.h"

#include <Eigen/SparseCore>

namespace ricci {

/// The derivative of the curvature by u (Eq. 11), the Hessian of the Ricci energy, restricted to
/// the unknown vertices: -w_ij off the diagonal, the sum of w_ij cosh l_ij on it (in the Euclidean
/// plane of w_ij). Symmetric, positive semi-definite wherever all triangles exist; only the lower
/// triangle is stored.
class Hessian
{
public:
	using Matrix = Eigen::SparseMatrix<double>;

	/// Lays out the sparsity pattern for the connectivity of \p map. \p row gives each vertex the
	/// row of its unknown, 0 to \p unknowns - 1, or -1 where u is fixed. Vertices with one row have
	/// the same u: their rows of the whole matrix are added up, and their columns.
	void layOut(const CurvatureMap& map, const VertexArray<int>& row, int unknowns);

	/// Fills the values at the state of \p map and adds \p shift to the diagonal.
	/// \pre the connectivity is that of the last layOut()
	void fill(const CurvatureMap& map, double shift);

	const Matrix& matrix() const { return m_matrix; }
	double largestDiagonal() const;

private:
	Matrix m_matrix;
	Array<int> m_diagonal;                       // [row] slot in the value array
	EdgeArray<int> m_offDiagonal;                // slot, or -1
	EdgeArray<int> m_rowOfOrigin, m_rowOfTarget; // or -1
};

} // namespace ricci

#endif
