// SPDX-License-Identifier: GPL-3.0-or-later
#include "sparse_cholesky.h"

#include "../error.h"

#ifdef RICCI_USE_CHOLMOD
#include <Eigen/CholmodSupport>
#else
#include <Eigen/SparseCholesky>
#endif

namespace ricci {

#ifdef RICCI_USE_CHOLMOD

struct SparseCholesky::Implementation
{
	Eigen::CholmodSupernodalLLT<Matrix, Eigen::Lower> solver;

	Implementation()
	{
		// One ordering by approximate minimum degree: the same result on every run, and no search
		// through other methods at every change of connectivity.
		solver.cholmod().nmethods = 1;
		solver.cholmod().method[0].ordering = CHOLMOD_AMD;
		solver.cholmod().postorder = 1;
		solver.cholmod().print = 0;
	}

	bool succeeded() const { return solver.info() == Eigen::Success; }
};

const char* SparseCholesky::name()
{
	return "CHOLMOD supernodal";
}

#else

struct SparseCholesky::Implementation
{
	Eigen::SimplicialLDLT<Matrix, Eigen::Lower> solver;

	/// LDLT goes through negative pivots without complaint.
	bool succeeded() const
	{
		return solver.info() == Eigen::Success && (solver.vectorD().array() > 0.0).all();
	}
};

const char* SparseCholesky::name()
{
	return "Eigen SimplicialLDLT";
}

#endif

SparseCholesky::SparseCholesky() : m_implementation(std::make_unique<Implementation>())
{
}
SparseCholesky::~SparseCholesky() = default;

void SparseCholesky::analyze(const Matrix& pattern)
{
	m_implementation->solver.analyzePattern(pattern);
	if (m_implementation->solver.info() != Eigen::Success)
		throw Error(
			"The linear solver could not analyse its matrix: there may be too little memory.");
}

bool SparseCholesky::factorize(const Matrix& matrix)
{
	m_implementation->solver.factorize(matrix);
	return m_implementation->succeeded();
}

void SparseCholesky::solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x)
{
	x.noalias() = m_implementation->solver.solve(rhs);
}

} // namespace ricci
