// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SPARSE_CHOLESKY_H
#define RICCI_SPARSE_CHOLESKY_H

#include "../base/indexed.h"
#include "../progress.h"

#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace ricci {

/// Work done by a SparseCholesky since its construction: what a machine's speed does not change.
struct CholeskyWork
{
	int orderings = 0, analyses = 0, factorizations = 0, solutions = 0;
	double flops = 0.0; ///< floating-point operations of all of them

	friend CholeskyWork operator+(const CholeskyWork& a, const CholeskyWork& b)
	{
		return {
			a.orderings + b.orderings,
			a.analyses + b.analyses,
			a.factorizations + b.factorizations,
			a.solutions + b.solutions,
			a.flops + b.flops};
	}
};

/// Solver of symmetric positive definite sparse systems given by their lower triangle: supernodal
/// CHOLMOD [Chen et al. 2008] where it was found at build time (RICCI_USE_CHOLMOD; with
/// RICCI_STATIC_CHOLMOD its static library, with cholmod_blas.cpp and without METIS), Eigen's
/// SimplicialLDLT otherwise.
///
/// Unknowns are eliminated in the order of their rows, which analyze() chooses: matrices are laid out
/// in that order, so that nothing has to be permuted afterwards.
class SparseCholesky
{
public:
	using Matrix = Eigen::SparseMatrix<double>;

	/// From this number of unknowns on the order is that of nested dissection: it takes longer than the
	/// factorisation that it saves, but the factor is smaller by a third, and beyond this size memory is
	/// what runs out.
	static constexpr int kNestedDissectionFrom = 2000000;

	/// \param nestedDissectionFrom another number, for tests
	explicit SparseCholesky(int nestedDissectionFrom = kNestedDissectionFrom);
	~SparseCholesky();
	SparseCholesky(const SparseCholesky&) = delete;
	SparseCholesky& operator=(const SparseCholesky&) = delete;

	/// Symbolic factorisation of \p pattern. Stays valid while the pattern does.
	///
	/// Where that reduces the fill, chooses other rows and has the pattern laid out for them by \p
	/// layOut(): the first time, where the number of unknowns is another, and where changes of the
	/// pattern have made a factorisation half as expensive again as when the rows were chosen. Their
	/// order is that of approximate minimum degree, or of nested dissection where the factor is large and
	/// CHOLMOD has METIS.
	/// \param row an array of int, by element: the row of its unknown in the pattern, -1 if it has
	/// none
	/// \return whether the rows have changed
	/// \throw std::bad_alloc; TooLarge where the solver cannot number the factor's entries;
	/// InternalError where CHOLMOD fails otherwise
	template<class Rows, class LayOut>
	bool analyze(const Matrix& pattern, Rows& row, const LayOut& layOut)
	{
		if (pattern.rows() == m_orderedRows) {
			analyzeAsNumbered(pattern);
			if (factorFlops() <= kMaxGrowth * m_orderedFlops)
				return false;
		}
		const Array<int> chosen = chooseRows(pattern);
		for (int& r : row)
			if (r >= 0)
				r = chosen[r];
		layOut();
		analyzeAsNumbered(pattern);
		m_orderedRows = pattern.rows();
		m_orderedFlops = factorFlops();
		return true;
	}

	/// Numeric factorisation of a matrix with the pattern last analyzed.
	/// \param tick called meanwhile if it is not empty, in this thread; may throw. With
	/// cholmod_blas.cpp only: other solvers never call it
	/// \return false if \p matrix is not positive definite
	/// \throw as analyze()
	bool factorize(const Matrix& matrix, const Tick& tick = {});

	/// Solves with the last factor: \p x = matrix^-1 \p rhs.
	/// \pre factorize() has returned true
	void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x);

	/// The same for real and imaginary parts in one pass over the factor, which takes little more
	/// than half as long as two.
	void solve(const Eigen::VectorXcd& rhs, Eigen::VectorXcd& x);

	/// Entries of the factor, by the last symbolic factorisation.
	double factorEntries() const;

	/// Floating-point operations of a numeric factorisation, by the last symbolic one.
	double factorFlops() const;

	const CholeskyWork& work() const { return m_work; }

	/// The library behind this class, for logs and benchmarks.
	static const char* name();

private:
	struct Implementation;

	/// A factorisation may become more expensive by this factor before other rows are chosen.
	static constexpr double kMaxGrowth = 1.5;

	Array<int> chooseRows(const Matrix& pattern);
	std::vector<int> order(const Matrix& pattern);
	void analyzeAsNumbered(const Matrix& pattern);

	std::unique_ptr<Implementation> m_implementation;
	CholeskyWork m_work;
	Eigen::Index m_orderedRows = -1;
	double m_orderedFlops = 0.0; ///< of a factorisation, when the rows were chosen
};

} // namespace ricci

#endif
