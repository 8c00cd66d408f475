// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SPARSE_CHOLESKY_H
#define RICCI_SPARSE_CHOLESKY_H

#include <Eigen/SparseCore>

#include <memory>

namespace ricci {

/// Solver of symmetric positive definite sparse systems given by their lower triangle: supernodal
/// CHOLMOD where it was found at build time (RICCI_USE_CHOLMOD), Eigen's SimplicialLDLT otherwise.
class SparseCholesky
{
public:
	using Matrix = Eigen::SparseMatrix<double>;

	SparseCholesky();
	~SparseCholesky();
	SparseCholesky(const SparseCholesky&) = delete;
	SparseCholesky& operator=(const SparseCholesky&) = delete;

	/// Fill-reducing ordering and symbolic factorisation. Stays valid while the pattern does.
	void analyze(const Matrix& pattern);

	/// Numeric factorisation. \return false if \p matrix is not positive definite.
	bool factorize(const Matrix& matrix);

	/// Solves with the last factor.
	void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x);

	/// The library behind this class, for logs and benchmarks.
	static const char* name();

private:
	struct Implementation;
	std::unique_ptr<Implementation> m_implementation;
};

} // namespace ricci

#endif
