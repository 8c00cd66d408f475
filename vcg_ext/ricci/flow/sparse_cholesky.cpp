// SPDX-License-Identifier: GPL-3.0-or-later
#include "sparse_cholesky.h"

#include "../numbers.h"

#include <new>
#include <numeric>

#ifdef RICCI_USE_CHOLMOD
#include <cholmod.h>
#else
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#endif

#if defined(RICCI_USE_CHOLMOD) && defined(__GNUC__) && defined(__ELF__)
// There where the BLAS behind CHOLMOD is OpenBLAS, and where CHOLMOD was built with OpenMP.
extern "C" {
__attribute__((weak)) void openblas_set_num_threads(int);
__attribute__((weak)) int openblas_get_num_threads(void);
__attribute__((weak)) void omp_set_max_active_levels(int);
__attribute__((weak)) int omp_get_max_active_levels(void);
}
#define RICCI_THREAD_CONTROL
#endif

namespace ricci {

namespace {

[[noreturn]] void tooLittleMemory()
{
	throw std::bad_alloc();
}

} // namespace

#ifdef RICCI_USE_CHOLMOD

namespace {

/// One thread for the libraries below: how many there are must not change a bit of the result, and
/// CHOLMOD's own loops are so short that threads cost more than they save.
class OneThread
{
public:
	OneThread()
	{
#ifdef RICCI_THREAD_CONTROL
		if (openblas_set_num_threads && openblas_get_num_threads) {
			m_blasThreads = openblas_get_num_threads();
			if (m_blasThreads > 1)
				openblas_set_num_threads(1);
		}
		if (omp_set_max_active_levels && omp_get_max_active_levels) {
			m_levels = omp_get_max_active_levels();
			omp_set_max_active_levels(0);
		}
#endif
	}
	~OneThread()
	{
#ifdef RICCI_THREAD_CONTROL
		if (m_blasThreads > 1)
			openblas_set_num_threads(m_blasThreads);
		if (m_levels >= 0)
			omp_set_max_active_levels(m_levels);
#endif
	}
	OneThread(const OneThread&) = delete;
	OneThread& operator=(const OneThread&) = delete;

private:
	int m_blasThreads = 0, m_levels = -1;
};

/// From this number of unknowns on the ordering is METIS's nested dissection: it takes longer than
/// the factorisation it saves, but the factor is smaller by a third, and beyond this size memory is
/// what runs out.
constexpr int kNestedDissectionFrom = 2000000;

} // namespace

struct SparseCholesky::Implementation
{
	cholmod_common common;
	cholmod_factor* factor = nullptr;
	bool analyzed = false; ///< by order()
	double flops = 0.0, entries = 0.0;
	cholmod_dense *solution = nullptr, *workspace = nullptr, *workspace2 = nullptr;

	Implementation()
	{
		cholmod_start(&common);
		common.nmethods = 1; // no search through several orderings
		common.supernodal = CHOLMOD_SUPERNODAL;
		common.print = 0;
	}
	~Implementation()
	{
		cholmod_free_factor(&factor, &common);
		cholmod_free_dense(&solution, &common);
		cholmod_free_dense(&workspace, &common);
		cholmod_free_dense(&workspace2, &common);
		cholmod_finish(&common);
	}
	Implementation(const Implementation&) = delete;
	Implementation& operator=(const Implementation&) = delete;

	/// \p matrix as CHOLMOD sees it: it is only read.
	static cholmod_sparse view(const Matrix& matrix)
	{
		cholmod_sparse a{};
		a.nrow = at(matrix.rows());
		a.ncol = at(matrix.cols());
		a.nzmax = at(matrix.nonZeros());
		a.p = const_cast<int*>(matrix.outerIndexPtr());
		a.i = const_cast<int*>(matrix.innerIndexPtr());
		a.x = const_cast<double*>(matrix.valuePtr());
		a.stype = -1;
		a.itype = CHOLMOD_INT;
		a.xtype = CHOLMOD_REAL;
		a.dtype = CHOLMOD_DOUBLE;
		a.sorted = 1;
		a.packed = 1;
		return a;
	}

	void analyze(const Matrix& pattern, int ordering, int postorder)
	{
		cholmod_sparse a = view(pattern);
		cholmod_free_factor(&factor, &common);
		common.method[0].ordering = ordering;
		common.postorder = postorder;
		factor = cholmod_analyze(&a, &common);
		if (!factor)
			tooLittleMemory();
		flops = common.fl;
		entries = common.lnz;
	}
};

SparseCholesky::SparseCholesky() : m_implementation(std::make_unique<Implementation>())
{
}

std::vector<int> SparseCholesky::order(const Matrix& pattern)
{
	const OneThread oneThread;
	Implementation& own = *m_implementation;
	own.analyze(pattern, pattern.rows() < kNestedDissectionFrom ? CHOLMOD_AMD : CHOLMOD_METIS, 1);
	++m_work.orderings;
	++m_work.analyses;
	// The factor is that of the renumbered matrix in its natural order.
	int* permutation = static_cast<int*>(own.factor->Perm);
	std::vector<int> order(permutation, permutation + own.factor->n);
	std::iota(permutation, permutation + own.factor->n, 0);
	own.factor->ordering = CHOLMOD_NATURAL;
	own.analyzed = true;
	return order;
}

void SparseCholesky::analyze(const Matrix& pattern)
{
	Implementation& own = *m_implementation;
	if (!own.analyzed || own.factor->n != at(pattern.rows())) {
		const OneThread oneThread;
		own.analyze(pattern, CHOLMOD_NATURAL, 0);
		++m_work.analyses;
	}
	own.analyzed = false;
}

bool SparseCholesky::factorize(const Matrix& matrix)
{
	const OneThread oneThread;
	Implementation& own = *m_implementation;
	cholmod_sparse a = Implementation::view(matrix);
	cholmod_factorize(&a, own.factor, &own.common);
	++m_work.factorizations;
	m_work.flops += own.flops;
	if (own.common.status < CHOLMOD_OK)
		tooLittleMemory();
	return own.common.status == CHOLMOD_OK;
}

void SparseCholesky::solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x)
{
	const OneThread oneThread;
	Implementation& own = *m_implementation;
	cholmod_dense b{};
	b.nrow = b.nzmax = b.d = at(rhs.size());
	b.ncol = 1;
	b.x = const_cast<double*>(rhs.data());
	b.xtype = CHOLMOD_REAL;
	b.dtype = CHOLMOD_DOUBLE;
	// cholmod_solve2() would make these itself, but sees the failure of the second only.
	const auto make = [&](cholmod_dense*& space, std::size_t rows, std::size_t columns) {
		if (!cholmod_ensure_dense(&space, rows, columns, rows, CHOLMOD_REAL, &own.common))
			tooLittleMemory();
	};
	make(own.workspace, b.nrow, 1);
	make(own.workspace2, 1, own.factor->maxesize);
	if (!cholmod_solve2(
			CHOLMOD_A,
			own.factor,
			&b,
			nullptr,
			&own.solution,
			nullptr,
			&own.workspace,
			&own.workspace2,
			&own.common))
		tooLittleMemory();
	++m_work.solutions;
	m_work.flops += 4.0 * own.entries;
	x = Eigen::Map<const Eigen::VectorXd>(static_cast<double*>(own.solution->x), rhs.size());
}

double SparseCholesky::factorEntries() const
{
	return m_implementation->entries;
}

double SparseCholesky::factorFlops() const
{
	return m_implementation->flops;
}

const char* SparseCholesky::name()
{
	return "CHOLMOD supernodal";
}

#else

struct SparseCholesky::Implementation
{
	/// Eigen's has the column counts that its symbolic factorisation found, for itself.
	struct Solver : Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::NaturalOrdering<int>>
	{
		const auto& columnEntries() const { return m_nonZerosPerCol; }
	};
	Solver solver;
	double flops = 0.0, entries = 0.0;
};

SparseCholesky::SparseCholesky() : m_implementation(std::make_unique<Implementation>())
{
}

std::vector<int> SparseCholesky::order(const Matrix& pattern)
{
	Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
	Eigen::AMDOrdering<int> ordering;
	ordering(pattern.selfadjointView<Eigen::Lower>(), permutation);
	++m_work.orderings;
	const auto& indices = permutation.indices();
	return {indices.data(), indices.data() + indices.size()};
}

void SparseCholesky::analyze(const Matrix& pattern)
{
	Implementation& own = *m_implementation;
	own.solver.analyzePattern(pattern);
	if (own.solver.info() != Eigen::Success)
		tooLittleMemory();
	++m_work.analyses;
	own.flops = own.entries = 0.0;
	for (const int below : own.solver.columnEntries()) {
		own.entries += 1.0 + below;
		own.flops += (1.0 + below) * (1.0 + below);
	}
}

bool SparseCholesky::factorize(const Matrix& matrix)
{
	Implementation& own = *m_implementation;
	own.solver.factorize(matrix);
	++m_work.factorizations;
	m_work.flops += own.flops;
	// LDLT goes through negative pivots without complaint.
	return own.solver.info() == Eigen::Success && (own.solver.vectorD().array() > 0.0).all();
}

void SparseCholesky::solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x)
{
	x.noalias() = m_implementation->solver.solve(rhs);
	++m_work.solutions;
	m_work.flops += 4.0 * m_implementation->entries;
}

double SparseCholesky::factorEntries() const
{
	return m_implementation->entries;
}

double SparseCholesky::factorFlops() const
{
	return m_implementation->flops;
}

const char* SparseCholesky::name()
{
	return "Eigen SimplicialLDLT";
}

#endif

SparseCholesky::~SparseCholesky() = default;

} // namespace ricci
