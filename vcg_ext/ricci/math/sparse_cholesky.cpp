// SPDX-License-Identifier: GPL-3.0-or-later
#include "sparse_cholesky.h"

#include "../error.h"
#include "cholmod_tick.h"
#include "one_thread.h"

#include <algorithm>
#include <limits>
#include <new>
#include <numeric>
#include <string>

#ifdef RICCI_USE_CHOLMOD
#include <cholmod.h>
#else
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#endif

namespace ricci {

#ifdef RICCI_USE_CHOLMOD

namespace {

/// CHOLMOD's numbers of entries. The factor of ten million unknowns has more of them than int can
/// tell; below that nothing but the analysis takes longer, by half.
using Long = SuiteSparse_long;

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

} // namespace

struct SparseCholesky::Implementation
{
	cholmod_common common;
	cholmod_factor* factor = nullptr;
	bool analyzed = false; ///< by order()
	double flops = 0.0, entries = 0.0;
	/// Work space of solve(). Not an Eigen vector: memory is freed twice if its resize() fails.
	std::vector<double> rowsBelow;
	std::vector<double> pairsBelow; ///< the same for complex right sides
	const int nestedDissectionFrom;

	explicit Implementation(int dissectionFrom) : nestedDissectionFrom(dissectionFrom)
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

	/// \return whether there is a factor; if not, common.status says why
	bool tryToAnalyze(const Matrix& pattern, int ordering, int postorder)
	{
		View a(pattern);
		cholmod_l_free_factor(&factor, &common);
		common.method[0].ordering = ordering;
		common.postorder = postorder;
		factor = cholmod_l_analyze(a.get(), &common);
		flops = common.fl;
		entries = common.lnz;
		return factor != nullptr;
	}

	void analyze(const Matrix& pattern, int ordering, int postorder)
	{
		if (!tryToAnalyze(pattern, ordering, postorder))
			fail(pattern);
	}

	/// Columns first .. first + width - 1 of the factor, which have the same rows: their own, and
	/// \p height others below. Stored by columns, each from the diagonal block's first row.
	struct Supernode
	{
		int first, width, height;
		const Long* below; ///< [height] rows below the diagonal block
		const double* values;

		const double* column(int c) const
		{
			return values + positionOf(c) * (positionOf(width) + positionOf(height));
		}
		using Vector = Eigen::Map<const Eigen::VectorXd>;
		Vector columnBelow(int c) const { return {column(c) + width, height}; }
	};

	Supernode supernode(std::size_t k) const
	{
		const auto* first = static_cast<const Long*>(factor->super);
		const auto* rows = static_cast<const Long*>(factor->pi);
		const auto* start = static_cast<const Long*>(factor->px);
		const auto width = static_cast<int>(first[k + 1] - first[k]);
		return {
			static_cast<int>(first[k]),
			width,
			static_cast<int>(rows[k + 1] - rows[k]) - width,
			static_cast<const Long*>(factor->s) + rows[k] + width,
			static_cast<const double*>(factor->x) + start[k]};
	}

	/// x = L^-1 x, supernode by supernode. A right side of few entries reaches few of them.
	void solveForward(double* x)
	{
		for (std::size_t k = 0; k < factor->nsuper; ++k) {
			const Supernode node = supernode(k);
			double* own = x + node.first;
			if (std::all_of(own, own + node.width, [](double value) { return value == 0.0; }))
				continue;
			for (int c = 0; c < node.width; ++c) {
				const double* column = node.column(c);
				own[c] /= column[c];
				for (int r = c + 1; r < node.width; ++r)
					own[r] -= column[r] * own[c];
			}
			Eigen::Map<Eigen::VectorXd> below(rowsBelow.data(), node.height);
			below.setZero();
			int c = 0;
			for (; c + 4 <= node.width; c += 4) // a quarter of the passes over the sums
				below += node.columnBelow(c) * own[c] + node.columnBelow(c + 1) * own[c + 1] +
						 node.columnBelow(c + 2) * own[c + 2] +
						 node.columnBelow(c + 3) * own[c + 3];
			for (; c < node.width; ++c)
				below += node.columnBelow(c) * own[c];
			for (int r = 0; r < node.height; ++r)
				x[node.below[r]] -= below[r];
		}
	}

	/// x = L^-T x.
	void solveBackward(double* x)
	{
		for (std::size_t k = factor->nsuper; k-- > 0;) {
			const Supernode node = supernode(k);
			double* own = x + node.first;
			Eigen::Map<Eigen::VectorXd> below(rowsBelow.data(), node.height);
			for (int r = 0; r < node.height; ++r)
				below[r] = x[node.below[r]];
			for (int c = node.width - 1; c >= 0; --c) {
				const double* column = node.column(c);
				double sum = own[c] - node.columnBelow(c).dot(below);
				for (int r = c + 1; r < node.width; ++r)
					sum -= column[r] * own[r];
				own[c] = sum / column[c];
			}
		}
	}

	/// A complex number among the real and imaginary parts of many, for the machine's vectors.
	using Pair = Eigen::Array2d;
	static Eigen::Map<Pair> at(double* parts, Long i) { return Eigen::Map<Pair>(parts + 2 * i); }

	/// x = L^-1 x for complex numbers.
	void solvePairsForward(double* x)
	{
		double* below = pairsBelow.data();
		for (std::size_t k = 0; k < factor->nsuper; ++k) {
			const Supernode node = supernode(k);
			double* own = x + 2 * node.first;
			for (int c = 0; c < node.width; ++c) {
				const double* column = node.column(c);
				const Pair solved = at(own, c) / column[c];
				at(own, c) = solved;
				for (int r = c + 1; r < node.width; ++r)
					at(own, r) -= column[r] * solved;
			}
			std::fill(below, below + 2 * node.height, 0.0);
			int c = 0;
			for (; c + 4 <= node.width; c += 4)
				addColumns<4>(node, c, own, below);
			for (; c < node.width; ++c)
				addColumns<1>(node, c, own, below);
			for (int r = 0; r < node.height; ++r)
				at(x, node.below[r]) -= at(below, r);
		}
	}

	/// Adds what columns first .. first + Count - 1 contribute to the rows below.
	template<int Count>
	static void addColumns(const Supernode& node, int first, double* own, double* below)
	{
		const double* values[Count];
		Pair solved[Count];
		for (int i = 0; i < Count; ++i) {
			values[i] = node.column(first + i) + node.width;
			solved[i] = at(own, first + i);
		}
		for (int r = 0; r < node.height; ++r) {
			Pair sum = at(below, r);
			for (int i = 0; i < Count; ++i)
				sum += values[i][r] * solved[i];
			at(below, r) = sum;
		}
	}

	/// x = L^-T x for complex numbers.
	void solvePairsBackward(double* x)
	{
		double* below = pairsBelow.data();
		for (std::size_t k = factor->nsuper; k-- > 0;) {
			const Supernode node = supernode(k);
			double* own = x + 2 * node.first;
			for (int r = 0; r < node.height; ++r)
				at(below, r) = at(x, node.below[r]);
			for (int c = node.width - 1; c >= 0; --c) {
				const double *column = node.column(c), *values = column + node.width;
				Pair sum = at(own, c),
					 others = Pair::Zero(); // two, which do not wait for each other
				int r = 0;
				for (; r + 2 <= node.height; r += 2) {
					sum -= values[r] * at(below, r);
					others -= values[r + 1] * at(below, r + 1);
				}
				if (r < node.height)
					sum -= values[r] * at(below, r);
				sum += others;
				for (r = c + 1; r < node.width; ++r)
					sum -= column[r] * at(own, r);
				at(own, c) = sum / column[c];
			}
		}
	}
};

/// [row chosen] row of the pattern.
std::vector<int> SparseCholesky::order(const Matrix& pattern)
{
	if (pattern.rows() == 0)
		return {};
	const OneThread oneThread;
	Implementation& own = *m_implementation;
	// METIS may not be there, or not number so many edges.
	const bool isDissected =
		pattern.rows() >= own.nestedDissectionFrom && own.tryToAnalyze(pattern, CHOLMOD_METIS, 1);
	if (!isDissected)
		own.analyze(pattern, CHOLMOD_AMD, 1);
	++m_work.orderings;
	++m_work.analyses;
	// The factor is that of the renumbered matrix in its natural order.
	Long* permutation = static_cast<Long*>(own.factor->Perm);
	std::vector<int> order(own.factor->n);
	std::transform(permutation, permutation + own.factor->n, order.begin(), [](Long row) {
		return static_cast<int>(row);
	});
	std::iota(permutation, permutation + own.factor->n, Long(0));
	own.factor->ordering = CHOLMOD_NATURAL;
	own.analyzed = true;
	return order;
}

/// Costs nothing for the pattern that order() has just analyzed, renumbered.
void SparseCholesky::analyzeAsNumbered(const Matrix& pattern)
{
	if (pattern.rows() == 0)
		return;
	Implementation& own = *m_implementation;
	if (!own.analyzed || own.factor->n != static_cast<std::size_t>(pattern.rows())) {
		const OneThread oneThread;
		own.analyze(pattern, CHOLMOD_NATURAL, 0);
		++m_work.analyses;
	}
	own.analyzed = false;
}

bool SparseCholesky::factorize(const Matrix& matrix, const Tick& tick)
{
	if (matrix.rows() == 0)
		return true;
	const OneThread oneThread;
	CholmodTick ticking(tick);
	Implementation& own = *m_implementation;
	View a(matrix);
	cholmod_l_factorize(a.get(), own.factor, &own.common);
	ticking.rethrow();
	++m_work.factorizations;
	m_work.flops += own.flops;
	if (own.common.status < CHOLMOD_OK)
		own.fail(matrix);
	return own.common.status == CHOLMOD_OK;
}

// CHOLMOD's own solution calls BLAS for each supernode, most of which are so small that the calls
// take as long as the arithmetic: this is about twice as fast.
void SparseCholesky::solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x)
{
	if (rhs.size() == 0) {
		x = rhs;
		return;
	}
	Implementation& own = *m_implementation;
	own.rowsBelow.resize(own.factor->maxesize);
	x = rhs;
	own.solveForward(x.data());
	own.solveBackward(x.data());
	++m_work.solutions;
	m_work.flops += 4.0 * own.entries;
}

void SparseCholesky::solve(const Eigen::VectorXcd& rhs, Eigen::VectorXcd& x)
{
	if (rhs.size() == 0) {
		x = rhs;
		return;
	}
	Implementation& own = *m_implementation;
	own.pairsBelow.resize(2 * own.factor->maxesize);
	x = rhs;
	auto* parts = reinterpret_cast<double*>(x.data()); // std::complex is two doubles
	own.solvePairsForward(parts);
	own.solvePairsBackward(parts);
	m_work.solutions += 2;
	m_work.flops += 8.0 * own.entries;
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
	/// Eigen keeps the column counts that its symbolic factorisation finds to itself.
	struct Solver : Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::NaturalOrdering<int>>
	{
		const auto& columnEntries() const { return m_nonZerosPerCol; }
	};
	Solver solver;
	double flops = 0.0, entries = 0.0;

	explicit Implementation(int /*nestedDissectionFrom*/) {} // AMD is the only order here
};

/// [row chosen] row of the pattern.
std::vector<int> SparseCholesky::order(const Matrix& pattern)
{
	if (pattern.rows() == 0)
		return {};
	Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
	Eigen::AMDOrdering<int> ordering;
	ordering(pattern.selfadjointView<Eigen::Lower>(), permutation);
	++m_work.orderings;
	const auto& indices = permutation.indices();
	return {indices.data(), indices.data() + indices.size()};
}

void SparseCholesky::analyzeAsNumbered(const Matrix& pattern)
{
	if (pattern.rows() == 0)
		return;
	Implementation& own = *m_implementation;
	own.solver.analyzePattern(pattern);
	if (own.solver.info() != Eigen::Success)
		throw std::bad_alloc();
	++m_work.analyses;
	own.flops = own.entries = 0.0;
	for (const int below : own.solver.columnEntries()) {
		own.entries += 1.0 + below;
		own.flops += (1.0 + below) * (1.0 + below);
	}
	if (own.entries > std::numeric_limits<int>::max())
		throw TooLarge(TooLarge::Unknowns, static_cast<std::size_t>(pattern.rows()), 0.0, 0.0);
}

bool SparseCholesky::factorize(const Matrix& matrix, const Tick&)
{
	if (matrix.rows() == 0)
		return true;
	Implementation& own = *m_implementation;
	own.solver.factorize(matrix);
	++m_work.factorizations;
	m_work.flops += own.flops;
	// LDLT goes through negative pivots without complaint.
	return own.solver.info() == Eigen::Success && (own.solver.vectorD().array() > 0.0).all();
}

void SparseCholesky::solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x)
{
	if (rhs.size() == 0) {
		x = rhs;
		return;
	}
	x.noalias() = m_implementation->solver.solve(rhs);
	++m_work.solutions;
	m_work.flops += 4.0 * m_implementation->entries;
}

void SparseCholesky::solve(const Eigen::VectorXcd& rhs, Eigen::VectorXcd& x)
{
	if (rhs.size() == 0) {
		x = rhs;
		return;
	}
	using Pairs = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
	x.resize(rhs.size());
	const Eigen::Map<const Pairs> right(reinterpret_cast<const double*>(rhs.data()), rhs.size(), 2);
	Eigen::Map<Pairs>(reinterpret_cast<double*>(x.data()), x.size(), 2) =
		m_implementation->solver.solve(right);
	m_work.solutions += 2;
	m_work.flops += 8.0 * m_implementation->entries;
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

SparseCholesky::SparseCholesky(int nestedDissectionFrom) :
		m_implementation(std::make_unique<Implementation>(nestedDissectionFrom))
{
}

SparseCholesky::~SparseCholesky() = default;

/// [row of the pattern] the row that it should have.
Array<int> SparseCholesky::chooseRows(const Matrix& pattern)
{
	const std::vector<int> order = this->order(pattern);
	Array<int> chosen(order.size());
	for (std::size_t i = 0; i < order.size(); ++i)
		chosen[order[i]] = static_cast<int>(i);
	return chosen;
}

} // namespace ricci
