// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HESSIAN_H
#define RICCI_HESSIAN_H

#include "curvature_map.h"

#include <Eigen/SparseCore>

#include <vector>

namespace ricci {

/// The derivative of the curvature by u (Eq. 11), restricted to the unknown vertices: symmetric,
/// positive semi-definite wherever all triangles exist; only the lower triangle is stored.
class Hessian
{
public:
	using Matrix = Eigen::SparseMatrix<double>;

	/// Lays out the sparsity pattern for the connectivity of \p map. \p unknown gives each vertex
	/// its row, or -1 for a vertex whose u is fixed.
	void layOut(const CurvatureMap& map, const std::vector<int>& unknown, int unknownCount);

	/// Fills the values at the state of \p map and adds \p shift to the diagonal.
	void fill(const CurvatureMap& map, double shift);

	const Matrix& matrix() const { return m_matrix; }
	double largestDiagonal() const;

private:
	Matrix m_matrix;
	std::vector<int> m_diagonal;                   // [unknown] slot in the value array
	std::vector<int> m_offDiagonal;                // [edge] slot, or -1
	std::vector<int> m_rowOfOrigin, m_rowOfTarget; // [edge] unknown, or -1
};

} // namespace ricci

#endif
