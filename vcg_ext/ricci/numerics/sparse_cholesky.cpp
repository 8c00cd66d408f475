// SPDX-License-Identifier: GPL-3.0-or-later
#include "sparse_cholesky.h"

#include "../base/graphs.h"
#include "../base/indexed.h"
#include "../error.h"
#include "cholmod_checkpoint.h"
#include "one_thread.h"

#include <Eigen/IterativeLinearSolvers>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <new>
#include <numeric>
#include <string>
#include <utility>

#ifdef RICCI_USE_CHOLMOD
#include "supernodal_solver.h"
#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif
#else
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#endif

namespace ricci {

#ifdef RICCI_USE_CHOLMOD

namespace {

/// A matrix as CHOLMOD sees it: it is only read.
class View
{
public:
	explicit View(const SparseCholesky::Matrix& matrix) :
			m_starts(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.cols() + 1),
			m_rows(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros())
	{
		m_view.nrow = static_cast<std::size_t>(matrix.rows());
		m_view.ncol = static_cast<std::size_t>(matrix.cols());
		m_view.nzmax = static_cast<std::size_t>(matrix.nonZeros());
		m_view.p = m_starts.data();
		m_view.i = m_rows.data();
		m_view.x = const_cast<double*>(matrix.valuePtr());
		m_view.stype = -1;
		m_view.itype = CHOLMOD_LONG;
		m_view.xtype = CHOLMOD_REAL;
		m_view.dtype = CHOLMOD_DOUBLE;
		m_view.sorted = 1;
		m_view.packed = 1;
	}

	cholmod_sparse* get() { return &m_view; }

private:
	std::vector<Long> m_starts, m_rows;
	cholmod_sparse m_view{};
};

/// Asks for large pages where the system has them: a factor is written and read as a whole, many times. That saves some
/// 2 % of the time of a map of 100,000 triangles.
void takeLargePages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
	static const auto page =
		static_cast<std::size_t>(sysconf(_SC_PAGESIZE)); // madvise() takes only whole ones
	const std::size_t before = (page - reinterpret_cast<std::uintptr_t>(begin) % page) % page;
	if (bytes > before + page)
		madvise(static_cast<char*>(begin) + before, (bytes - before) / page * page, MADV_HUGEPAGE);
#endif
}

} // namespace

struct SparseCholesky::Implementation
{
	cholmod_common common;
	cholmod_factor* factor = nullptr;
	double flops = 0.0, entries = 0.0;
	SupernodalSolver solver;

	Implementation()
	{
		cholmod_l_start(&common);
		common.nmethods = 1; // no search through several orderings
		common.supernodal = CHOLMOD_SUPERNODAL;
		// Few zeros among the entries for the sake of wider supernodes: solutions are many, and each
		// goes through all of them.
		common.zrelax[0] = 0.2;
		common.print = 0;
	}
	~Implementation()
	{
		cholmod_l_free_factor(&factor, &common);
		cholmod_l_finish(&common);
	}
	Implementation(const Implementation&) = delete;
	Implementation& operator=(const Implementation&) = delete;

	/// Throws what a failure is called here.
	[[noreturn]] void fail(const Matrix& matrix) const
	{
		switch (common.status) {
		case CHOLMOD_OUT_OF_MEMORY:
			throw std::bad_alloc();
		case CHOLMOD_TOO_LARGE:
			throw TooLarge(TooLarge::Unknowns, static_cast<std::size_t>(matrix.rows()), 0.0, 0.0);
		default:
			throw InternalError(
				"CHOLMOD failed with status " + std::to_string(common.status) + " on " +
				std::to_string(matrix.rows()) + " unknowns");
		}
	}

	void analyze(const Matrix& pattern, int ordering, int postorder)
	{
		View a(pattern);
		cholmod_l_free_factor(&factor, &common);
		common.method[0].ordering = ordering;
		common.postorder = postorder;
		factor = cholmod_l_analyze(a.get(), &common);
		flops = common.fl;
		entries = common.lnz;
		if (factor == nullptr)
			fail(pattern);
		cholmod_l_free_work(&common);
		solver.plan(*factor);
	}

	/// A good order of elimination: [position] unknown.
	std::vector<int> order(const Matrix& pattern)
	{
		const OneThread oneThread;
		analyze(pattern, CHOLMOD_AMD, 1);
		// The factor is that of the renumbered matrix in its natural order.
		auto* permutation = static_cast<Long*>(factor->Perm);
		std::vector<int> result(factor->n);
		std::transform(permutation, permutation + factor->n, result.begin(), [](Long unknown) {
			return static_cast<int>(unknown);
		});
		std::iota(permutation, permutation + factor->n, Long(0));
		factor->ordering = CHOLMOD_NATURAL;
		return result;
	}

	/// The symbolic factor for the natural order.
	void analyze(const Matrix& pattern)
	{
		const OneThread oneThread;
		analyze(pattern, CHOLMOD_NATURAL, 0);
	}

	/// order() leaves the symbolic factor of the matrix in that order.
	static constexpr bool kOrderAnalyzes = true;

	bool factorize(const Matrix& matrix)
	{
		const OneThread oneThread;
		View a(matrix);
		if (factor->xtype == CHOLMOD_PATTERN) {
			if (!cholmod_l_change_factor(CHOLMOD_REAL, 1, 1, 1, 1, factor, &common))
				fail(matrix);
			takeLargePages(factor->x, factor->xsize * sizeof(double));
		}
		rethrowFromCholmod([&] { cholmod_l_factorize(a.get(), factor, &common); });
		cholmod_l_free_work(&common);
		if (common.status < CHOLMOD_OK)
			fail(matrix);
		return common.status == CHOLMOD_OK;
	}

	void solve(Eigen::VectorXd& x) { solver.solve(*factor, x); }
	void solve(Eigen::VectorXcd& x) { solver.solve(*factor, x); }
};

const char* SparseCholesky::name()
{
	return "CHOLMOD supernodal";
}

#else

struct SparseCholesky::Implementation
{
	/// Eigen keeps the column counts that its symbolic factorisation finds to itself.
	struct Solver : Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::NaturalOrdering<int>>
	{
		const auto& columnEntries() const { return m_nonZerosPerCol; }
	};
	Solver solver;
	double flops = 0.0, entries = 0.0;

	std::vector<int> order(const Matrix& pattern)
	{
		Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
		Eigen::AMDOrdering<int> ordering;
		ordering(pattern.selfadjointView<Eigen::Lower>(), permutation);
		const auto& indices = permutation.indices();
		return {indices.data(), indices.data() + indices.size()};
	}

	static constexpr bool kOrderAnalyzes = false;

	void analyze(const Matrix& pattern)
	{
		solver.analyzePattern(pattern);
		if (solver.info() != Eigen::Success)
			throw std::bad_alloc();
		flops = entries = 0.0;
		for (const int below : solver.columnEntries()) {
			entries += 1.0 + below;
			flops += (1.0 + below) * (1.0 + below);
		}
		if (entries > std::numeric_limits<int>::max())
			throw TooLarge(TooLarge::Unknowns, static_cast<std::size_t>(pattern.rows()), 0.0, 0.0);
	}

	bool factorize(const Matrix& matrix)
	{
		solver.factorize(matrix);
		// LDLT goes through negative pivots without complaint.
		return solver.info() == Eigen::Success && (solver.vectorD().array() > 0.0).all();
	}

	void solve(Eigen::VectorXd& x) { x = solver.solve(x).eval(); }

	void solve(Eigen::VectorXcd& x)
	{
		using Pairs = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
		Eigen::Map<Pairs> pairs(reinterpret_cast<double*>(x.data()), x.size(), 2);
		pairs = solver.solve(pairs).eval();
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

/// Notices whether it is another than that of the last matrix.
void SparseCholesky::takePattern(const Matrix& pattern)
{
	const int *starts = pattern.outerIndexPtr(), *rows = pattern.innerIndexPtr();
	const int *startsEnd = starts + pattern.cols() + 1, *rowsEnd = rows + pattern.nonZeros();
	if (std::equal(starts, startsEnd, m_starts.begin(), m_starts.end()) &&
		std::equal(rows, rowsEnd, m_rows.begin(), m_rows.end()))
		return;
	m_isAnalyzed = false;
	m_starts.assign(starts, startsEnd);
	m_rows.assign(rows, rowsEnd);
	if (m_order.position.size() != pattern.rows()) {
		m_order.position.setLinSpaced(pattern.rows(), 0, static_cast<int>(pattern.rows()) - 1);
		m_order.flops = 0.0;
	}
	layOut();
}

void SparseCholesky::takeOrder(const EliminationOrder& order)
{
	m_order = order;
	m_isAnalyzed = false;
	m_starts.clear(); // so that the next pattern is laid out
}

/// Makes the pattern of m_ordered, and m_entry.
void SparseCholesky::layOut()
{
	using Entry = std::pair<int, int>; // row, number
	const Eigen::VectorXi& position = m_order.position;
	const auto count = static_cast<int>(position.size());
	Adjacency<int, Entry> entries(count, [&](const auto& add) {
		for (int column = 0, i = 0; column < count; ++column)
			for (; i < m_starts[positionOf(column) + 1]; ++i) {
				const auto [low, high] =
					std::minmax(position[m_rows[positionOf(i)]], position[column]);
				add(low, Entry(high, i));
			}
	});
	m_ordered.resize(count, count);
	m_ordered.resizeNonZeros(static_cast<Eigen::Index>(m_rows.size()));
	m_entry.resize(m_rows.size());
	int slot = 0;
	for (int column = 0; column < count; ++column) {
		const ItemRange<Entry> own = entries[column];
		std::sort(own.begin(), own.end());
		for (const auto& [row, number] : own) {
			m_ordered.innerIndexPtr()[slot] = row;
			m_entry[positionOf(slot++)] = number;
		}
		m_ordered.outerIndexPtr()[column + 1] = slot;
	}
}

void SparseCholesky::analyze(const Matrix& pattern)
{
	takePattern(pattern);
	if (m_isAnalyzed || pattern.rows() == 0)
		return;
	Implementation& own = *m_implementation;
	const auto analyzeOrdered = [&] {
		own.analyze(m_ordered);
		++m_work.analyses;
	};
	if (m_order.flops > 0.0)
		analyzeOrdered();
	if (m_order.flops == 0.0 || own.flops > kMaxGrowth * m_order.flops) {
		const std::vector<int> unknown = own.order(m_ordered);
		++m_work.orderings;
		Eigen::VectorXi position(m_order.position.size());
		for (int i = 0; i < position.size(); ++i)
			position[unknown[positionOf(i)]] = i;
		for (int& i : m_order.position)
			i = position[i];
		layOut();
		if (Implementation::kOrderAnalyzes)
			++m_work.analyses;
		else
			analyzeOrdered();
		m_order.flops = own.flops;
	}
	m_isAnalyzed = true;
}

void SparseCholesky::takeValues(const Matrix& matrix)
{
	double* value = m_ordered.valuePtr();
	for (const int entry : m_entry)
		*value++ = matrix.valuePtr()[entry];
}

bool SparseCholesky::factorize(const Matrix& matrix)
{
	analyze(matrix);
	takeValues(matrix);
	return factorizeOrdered();
}

bool SparseCholesky::factorize(Matrix&& matrix)
{
	analyze(matrix);
	takeValues(matrix);
	matrix = Matrix();
	return factorizeOrdered();
}

bool SparseCholesky::factorizeOrdered()
{
	if (m_ordered.rows() == 0)
		return true;
	const bool isDefinite = m_implementation->factorize(m_ordered);
	++m_work.factorizations;
	m_work.flops += factorFlops();
	return isDefinite;
}

void SparseCholesky::solveOrdered(Eigen::VectorXd& x)
{
	m_implementation->solve(x);
	++m_work.solutions;
	m_work.flops += 4.0 * factorEntries();
}

Eigen::MatrixXd SparseCholesky::solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs)
{
	const Eigen::VectorXi& position = m_order.position;
	Eigen::MatrixXd x(rhs.rows(), rhs.cols());
	if (x.rows() == 0)
		return x;
	Eigen::Index column = 0;
	Eigen::VectorXcd pair(rhs.cols() > 1 ? x.rows() : 0);
	for (; column + 2 <= x.cols(); column += 2) {
		for (Eigen::Index i = 0; i < x.rows(); ++i)
			pair[position[i]] = {rhs(i, column), rhs(i, column + 1)};
		m_implementation->solve(pair);
		m_work.solutions += 2;
		m_work.flops += 8.0 * factorEntries();
		for (Eigen::Index i = 0; i < x.rows(); ++i) {
			x(i, column) = pair[position[i]].real();
			x(i, column + 1) = pair[position[i]].imag();
		}
	}
	if (column < x.cols()) {
		Eigen::VectorXd last(x.rows());
		for (Eigen::Index i = 0; i < x.rows(); ++i)
			last[position[i]] = rhs(i, column);
		solveOrdered(last);
		for (Eigen::Index i = 0; i < x.rows(); ++i)
			x(i, column) = last[position[i]];
	}
	return x;
}

namespace {

/// A function in the form of a preconditioner of Eigen: what stands for the inverse of the matrix.
struct Preconditioner
{
	std::function<Eigen::VectorXd(const Eigen::VectorXd& residual)> solve;

	Preconditioner& compute(const SparseCholesky::Matrix&) { return *this; }
	Eigen::ComputationInfo info() { return Eigen::Success; }
};

} // namespace

int SparseCholesky::iterate(
	const Matrix& matrix,
	const Eigen::VectorXd& rhs,
	double accuracy,
	int maxIterations,
	Eigen::VectorXd& x)
{
	takePattern(matrix);
	takeValues(matrix);
	Eigen::ConjugateGradient<Matrix, Eigen::Lower, Preconditioner> gradients;
	gradients.preconditioner().solve = [&](Eigen::VectorXd residual) {
		solveOrdered(residual); // by the last factor
		return residual;
	};
	gradients.setTolerance(accuracy);
	gradients.setMaxIterations(maxIterations);
	gradients.compute(m_ordered);
	const Eigen::PermutationWrapper<const Eigen::VectorXi> order(m_order.position);
	x = order.transpose() * gradients.solve(order * rhs).eval();
	const bool isSolved = gradients.info() == Eigen::Success && x.allFinite();
	return isSolved ? static_cast<int>(gradients.iterations()) : maxIterations + 1;
}

double SparseCholesky::factorEntries() const
{
	return m_implementation->entries;
}

double SparseCholesky::factorFlops() const
{
	return m_implementation->flops;
}

} // namespace ricci
