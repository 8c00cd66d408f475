// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FACTORED_HESSIAN_H
#define RICCI_FACTORED_HESSIAN_H

#include "../math/sparse_cholesky.h"
#include "hessian.h"

namespace ricci {

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

	/// Keeps pattern and factor for \p to, a map with the triangulation that \p from has at
	/// present: the same equations in other precision.
	void continueOn(const CurvatureMap& from, const CurvatureMap& to);

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
