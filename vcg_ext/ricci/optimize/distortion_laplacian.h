// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DISTORTION_LAPLACIAN_H
#define RICCI_DISTORTION_LAPLACIAN_H

#include "mean_distortion.h"

#include <Eigen/SparseCore>

#include <array>

namespace ricci {

/// What is near to the second derivative of a mean distortion E and easily inverted: with the
/// stiffness s of the triangles held fixed, E changes with the unknowns d like
/// sum s |f_zbar(d)|^2 = d^H N d. The real part of N is a cotangent Laplacian with the weights s of
/// the triangles: real, symmetric and positive definite, so that real and imaginary parts are solved
/// for alike. (The imaginary part vanishes inside where all s are equal.) Where a seam turns,
/// entries across it have the real part of that turn.
///
/// Systems are solved by conjugate gradients, preconditioned by symmetric Gauss-Seidel steps in
/// Eisenstat's form, which takes one pass over the matrix for both [Saad 2003, 9.2.2]. A few
/// iterations spread a step over as many rings of triangles, in time proportional to their number.
class DistortionLaplacian
{
public:
	/// \p energy must outlive it.
	explicit DistortionLaplacian(const MeanDistortion& energy);

	/// Takes the stiffness where the energy was last evaluated.
	/// \return false where a row has no positive diagonal
	bool factorize();

	/// x = matrix^-1 rhs, up to an error that leaves \p residual of what rhs is without x, both after
	/// one Gauss-Seidel step.
	/// \pre factorize() has returned true
	void solve(const Eigen::VectorXcd& rhs, Eigen::VectorXcd& x, double residual);

private:
	void solveForward(Eigen::VectorXcd& x) const;
	void solveBackward(Eigen::VectorXcd& x) const;

	const MeanDistortion& m_energy;
	const NumberedPoints& m_points;
	Array<std::array<Eigen::Index, 3>> m_slot; // of the entry between corners k and k + 1, or -1

	// The matrix with rows and columns scaled so that its diagonal is 1: the entries below that. By
	// columns and by rows: both substitutions gather what they add up, which is faster than to scatter it.
	Eigen::SparseMatrix<double> m_below;
	Eigen::SparseMatrix<double, Eigen::RowMajor> m_belowByRows;
	Eigen::VectorXd m_scale; // of the rows

	Eigen::VectorXcd m_residual, m_direction, m_solved, m_product; // of solve()
};

} // namespace ricci

#endif
