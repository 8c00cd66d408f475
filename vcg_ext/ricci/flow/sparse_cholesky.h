// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SPARSE_CHOLESKY_H
#define RICCI_SPARSE_CHOLESKY_H

#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace ricci {

/// Work done by a SparseCholesky since its construction: what a machine's speed does not change.
struct CholeskyWork
{
	int orderings = 0, analyses = 0, factorizations = 0, solutions = 0;
	double flops = 0.0; ///< floating-point operations of all of them
};

/// Solver of symmetric positive definite sparse systems given by their lower triangle: supernodal
/// CHOLMOD where it was found at build time (RICCI_USE_CHOLMOD), Eigen's SimplicialLDLT otherwise.
///
/// Unknowns are eliminated in the order of their numbers. order() tells how to number them; the
/// caller lays its matrix out accordingly, so that nothing has to be permuted afterwards.
class SparseCholesky
{
public:
	using Matrix = Eigen::SparseMatrix<double>;

	SparseCholesky();
	~SparseCholesky();
	SparseCholesky(const SparseCholesky&) = delete;
	SparseCholesky& operator=(const SparseCholesky&) = delete;

	/// Fill-reducing ordering of the unknowns of \p pattern: [number wanted] unknown. Approximate
	/// minimum degree, and nested dissection (METIS, with CHOLMOD only) where the factor would be
	/// large.
	/// \throw std::bad_alloc
	std::vector<int> order(const Matrix& pattern);

	/// Symbolic factorisation. Stays valid while the pattern does. Costs nothing for the pattern
	/// that order() has just been given, renumbered.
	/// \throw std::bad_alloc
	void analyze(const Matrix& pattern);

	/// Numeric factorisation. \return false if \p matrix is not positive definite.
	/// \throw std::bad_alloc
	bool factorize(const Matrix& matrix);

	/// Solves with the last factor.
	void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x);

	/// Entries of the factor, by the last symbolic factorisation.
	double factorEntries() const;

	/// Floating-point operations of a numeric factorisation, by the last symbolic one.
	double factorFlops() const;

	const CholeskyWork& work() const { return m_work; }

	/// The library behind this class, for logs and benchmarks.
	static const char* name();

private:
	struct Implementation;
	std::unique_ptr<Implementation> m_implementation;
	CholeskyWork m_work;
};

} // namespace ricci

#endif
