// SPDX-License-Identifier: GPL-3.0-or-later
// The folder numerics: sparse Cholesky, minimum cut, aggregation, iterations, doubles of doubles, isometries of the
// disk. Nothing that knows a mesh.
#ifndef RICCI_SPARSE_CHOLESKY_H
#define RICCI_SPARSE_CHOLESKY_H

#include <Eigen/Core>
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

/// The order in which a SparseCholesky eliminates unknowns.
struct EliminationOrder
{
	Eigen::VectorXi position; ///< [unknown] when it is eliminated
	double flops = 0.0;       ///< floating-point operations of a factorisation when it was chosen
};

/// Solver of symmetric positive definite sparse systems given by their lower triangle: supernodal
/// CHOLMOD [Chen et al. 2008] where it was found at build time (RICCI_USE_CHOLMOD; with
/// RICCI_STATIC_CHOLMOD its static library, with cholmod_blas.cpp and without METIS), Eigen's
/// SimplicialLDLT otherwise.
///
/// Unknowns are eliminated in an order that keeps the factor sparse, that of approximate minimum degree.
class SparseCholesky
{
public:
	using Matrix = Eigen::SparseMatrix<double>;

	SparseCholesky();
	~SparseCholesky();
	SparseCholesky(const SparseCholesky&) = delete;
	SparseCholesky& operator=(const SparseCholesky&) = delete;

	/// Symbolic factorisation, if \p pattern is not that of the last matrix. Keeps the order of
	/// elimination unless the number of unknowns is another, or a factorisation has become half as
	/// expensive again as when the order was chosen.
	/// \throw std::bad_alloc; TooLarge where the solver cannot number the factor's entries;
	/// InternalError where CHOLMOD fails otherwise
	void analyze(const Matrix& pattern);

	/// That of the last analyze().
	const EliminationOrder& order() const { return m_order; }

	/// Takes the order() of another solver, of as many unknowns, which else takes up to half as long to find as
	/// the factor. It is kept as analyze() keeps its own: not where the pattern is so different that a
	/// factorisation is half as expensive again as there.
	void takeOrder(const EliminationOrder& order);

	/// Numeric factorisation, after analyze().
	/// \return false if \p matrix is not positive definite
	/// \throw as analyze()
	bool factorize(const Matrix& matrix);
	bool factorize(Matrix&& matrix); ///< frees it before there is a factor

	/// matrix^-1 \p rhs with the last factor, for any number of columns. Two columns take little more
	/// than half as long as two calls.
	/// \pre factorize() has returned true
	Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs);

	/// Conjugate gradients for \p matrix, which is near the one factorised: the factor is their
	/// preconditioner. They end where |matrix x - rhs| <= \p accuracy |rhs|.
	/// \return number of iterations, more than \p maxIterations if they do not suffice
	/// \pre factorize() has returned true for a matrix of the same size
	int iterate(
		const Matrix& matrix,
		const Eigen::VectorXd& rhs,
		double accuracy,
		int maxIterations,
		Eigen::VectorXd& x);

	/// Entries of the factor, by the last symbolic factorisation.
	double factorEntries() const;

	/// Floating-point operations of a numeric factorisation, by the last symbolic one.
	double factorFlops() const;

	const CholeskyWork& work() const { return m_work; }

	/// The library behind this class, for logs and benchmarks.
	static const char* name();

private:
	struct Implementation;

	/// A factorisation may become more expensive by this factor before another order is chosen.
	static constexpr double kMaxGrowth = 1.5;

	void takePattern(const Matrix& pattern);
	void layOut();
	void takeValues(const Matrix& matrix);
	bool factorizeOrdered();
	void solveOrdered(Eigen::VectorXd& x);

	std::unique_ptr<Implementation> m_implementation;
	CholeskyWork m_work;
	std::vector<int> m_starts, m_rows; // of the last matrix
	EliminationOrder m_order;
	Matrix m_ordered;          // the last matrix, its unknowns in that order
	std::vector<int> m_entry;  // [entry of it] number among those of the last matrix
	bool m_isAnalyzed = false; // the symbolic factor is that of the last matrix
};

} // namespace ricci

#endif
