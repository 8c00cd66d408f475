// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DISTORTION_LAPLACIAN_H
#define RICCI_DISTORTION_LAPLACIAN_H

#include "../math/sparse_cholesky.h"
#include "mean_distortion.h"

namespace ricci {

/// What is near to the second derivative of a mean distortion E and easily inverted: with the
/// derivatives s = dE / d|f_zbar|^2 held fixed, E changes with the unknowns d like
/// sum s |f_zbar(d)|^2 = d^H N d. The real part of N is a cotangent Laplacian with the weights s of
/// the triangles: real, symmetric and positive definite, so that one real factor serves real and
/// imaginary parts alike. (The imaginary part vanishes inside where all s are equal.) Where a seam
/// turns, entries across it have the real part of that turn.
class DistortionLaplacian
{
public:
	/// Numbers the unknowns of \p points for the factorisation. Both must outlive it.
	DistortionLaplacian(MeanDistortion& energy, MovablePoints& points);

	/// Takes the derivatives where \p energy was last evaluated.
	/// \return false where rounding keeps the matrix from being positive definite
	/// \throw std::bad_alloc
	bool factorize(const MeanDistortion& energy);

	/// Operations of a factorisation for each entry of the factor; a solution takes four.
	double costOfFactor() const { return m_cholesky.factorFlops() / m_cholesky.factorEntries(); }

	/// x = matrix^-1 rhs.
	/// \pre factorize() has returned true
	void solve(const Eigen::VectorXcd& rhs, Eigen::VectorXcd& x) { m_cholesky.solve(rhs, x); }

private:
	using Matrix = SparseCholesky::Matrix;

	void layOut(const MeanDistortion& energy);
	void fill(const MeanDistortion& energy);

	const MovablePoints& m_points;
	Matrix m_matrix;                         // lower triangle, each column from its diagonal on
	FaceArray<std::array<int, 3>> m_unknown; // of the corners, or -1
	FaceArray<std::array<int, 3>> m_slot;    // of the entry between corners k and k + 1, or -1
	SparseCholesky m_cholesky;
};

} // namespace ricci

#endif
