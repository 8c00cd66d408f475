// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HESSIAN_H
#define RICCI_HESSIAN_H

#include "../numerics/sparse_cholesky.h"
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

/// The Hessian of the Ricci energy on the unknown vertices, with a Cholesky factor.
class FactoredHessian
{
public:
	/// \p fixed: 1 where u is no unknown. Where nothing is fixed and \p scaleInvariant, one row is
	/// redundant: the first vertex is no unknown either.
	/// \param mirror images of the vertices of a symmetric surface, or empty. A vertex and its image
	/// share an unknown: where u is symmetric, so is Newton's step, and half the equations give it.
	FactoredHessian(
		const VertexArray<char>& fixed,
		bool scaleInvariant,
		const VertexArray<Vertex>& mirror = {});

	int unknowns() const { return m_unknowns; }

	/// Row of the vertex's unknown, or -1.
	const VertexArray<int>& row() const { return m_row; }

	const Hessian& hessian() const { return m_hessian; }
	SparseCholesky& cholesky() { return m_cholesky; }
	const SparseCholesky& cholesky() const { return m_cholesky; }

	/// Fills the matrix at the state of \p map with \p shift on its diagonal, for a new pattern
	/// where the connectivity has another revision than at the last call. The factor stays.
	void fill(const CurvatureMap& map, double shift);

	/// Factorises the matrix at the state of \p map. Where it is not positive definite, and where
	/// triangles are broken (their derivatives are 0), a shift is added to the diagonal.
	/// \return whether the factor is that of the matrix without a shift
	/// \throw SolverFailed where no shift makes it positive definite
	bool factorize(const CurvatureMap& map);

	bool isFactored() const { return m_isFactored; }

	/// Whether the last factor has a shift on the diagonal of its matrix.
	bool isShifted() const { return m_isShifted; }

	/// Entries of \p values by unknown, those of images added up, and back (0 elsewhere).
	Eigen::VectorXd gather(const VertexVector& values) const;
	VertexVector scatter(const Eigen::VectorXd& rows) const;

private:
	VertexArray<int> m_row;
	int m_unknowns = 0;
	int m_revision = -1; // of the map, when the pattern was laid out
	bool m_isFactored = false;
	bool m_isShifted = false;
	Hessian m_hessian;
	SparseCholesky m_cholesky;
};

} // namespace ricci

#endif
