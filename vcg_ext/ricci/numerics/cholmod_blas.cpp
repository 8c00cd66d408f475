// SPDX-License-Identifier: GPL-3.0-or-later
// What CHOLMOD's static library takes from others, for a process that has none of them: the functions
// of BLAS and LAPACK that a real supernodal factorisation calls, by Eigen, and names that have to be
// there but are not used. Each function is as CHOLMOD calls it: its letters, factors 1 and 0.
//
// Linked as an object before CHOLMOD, so that those of CHOLMOD's own functions that are here take the
// place of the library's: they need METIS, or code that fits into programs only (Debian's library is
// position independent for those, not for modules).
//
// No function allocates memory, because no exception may pass through CHOLMOD: matrices are taken in
// blocks of a size that Eigen finds room for on the stack. What depends on it is the speed alone.
#include "../base/parallel.h"
#include "cholmod_checkpoint.h"

#include <Eigen/Cholesky>

#include <cholmod.h>

#include <cstdlib>

namespace {

using Eigen::Index;

constexpr Index kBlock = 64;

using Block = Eigen::Map<
	Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kBlock, kBlock>,
	0,
	Eigen::OuterStride<>>;

/// A matrix by columns, which lie \p stride numbers apart.
struct Matrix
{
	double* values;
	Index rows, columns, stride;

	Matrix part(Index i, Index j, Index height, Index width) const
	{
		return {values + i + j * stride, height, width, stride};
	}
	/// What begins in row i and column j, as far as a block reaches.
	Block block(Index i, Index j) const
	{
		return {
			values + i + j * stride,
			std::min(kBlock, rows - i),
			std::min(kBlock, columns - j),
			Eigen::OuterStride<>(stride)};
	}
	void setZero() const
	{
		for (Index j = 0; j < columns; ++j)
			std::fill_n(values + j * stride, rows, 0.0);
	}
};

/// Products of two numbers that are worth a thread: they take a millisecond.
constexpr double kMinProducts = 4e6;

/// Calls work(i) for the first number i of every block of \p size rows or columns, which are independent
/// of each other, in threads if there are many \p products of numbers in all. For none if the
/// factorisation is to end.
template<class Work>
void forBlocks(Index size, double products, const Work& work)
{
	if (!ricci::checkpointInCholmod(products))
		return;
	const int threads = products < 2.0 * kMinProducts ? 1 : ricci::defaultThreads();
	const int parts =
		static_cast<int>(std::min<double>(threads, std::max(1.0, products / kMinProducts)));
	ricci::inParallel(
		parts,
		parts,
		[&](int first, int last) {
			for (int part = first; part < last; ++part)
				for (Index i = part * kBlock; i < size; i += parts * kBlock)
					work(i);
		},
		1);
}

enum class Blocks { All, Lower };

/// c += sign a b^T, in the \p blocks of c.
void addProduct(double sign, const Matrix& a, const Matrix& b, const Matrix& c, Blocks blocks)
{
	const double share = blocks == Blocks::Lower ? 0.5 : 1.0;
	const double products = share * double(c.rows) * double(c.columns) * double(a.columns);
	forBlocks(c.rows, products, [&](Index i) {
		const Index columns = blocks == Blocks::Lower ? std::min(i + 1, c.columns) : c.columns;
		for (Index j = 0; j < columns; j += kBlock)
			for (Index k = 0; k < a.columns; k += kBlock)
				c.block(i, j).noalias() += sign * a.block(i, k) * b.block(j, k).transpose();
	});
}

/// b = b a^-T for the lower triangle a.
void divide(const Matrix& a, const Matrix& b)
{
	for (Index j = 0; j < b.columns; j += kBlock) {
		const Index width = std::min(kBlock, b.columns - j);
		const Matrix done = b.part(0, 0, b.rows, j), now = b.part(0, j, b.rows, width);
		addProduct(-1.0, done, a.part(j, 0, width, j), now, Blocks::All);
		forBlocks(b.rows, 0.5 * double(b.rows) * double(width * width), [&](Index i) {
			a.block(j, j)
				.transpose()
				.triangularView<Eigen::Upper>()
				.solveInPlace<Eigen::OnTheRight>(now.block(i, 0));
		});
	}
}

/// The factor of the lower triangle \p a in its place. \return false if it is not positive definite
bool factorize(const Matrix& a)
{
	for (Index j = 0; j < a.columns; j += kBlock) {
		const Index width = std::min(kBlock, a.columns - j), below = a.rows - j;
		const Matrix done = a.part(j, 0, below, j), now = a.part(j, j, below, width);
		addProduct(-1.0, done, done.part(0, 0, width, j), now, Blocks::Lower);
		Eigen::Ref<Block::PlainObject, 0, Eigen::OuterStride<>> diagonal = now.block(0, 0);
		const Eigen::LLT<decltype(diagonal)> factor(diagonal);
		// Eigen takes the root of a NaN.
		if (factor.info() != Eigen::Success || !(diagonal.diagonal().array() > 0.0).all())
			return false;
		divide(now, now.part(width, 0, below - width, width));
	}
	return true;
}

} // namespace

extern "C" {

/// c = a b^T.
void dgemm_(
	const char*,
	const char*,
	const int* rows,
	const int* columns,
	const int* inner,
	const double*,
	double* a,
	const int* strideA,
	double* b,
	const int* strideB,
	const double*,
	double* c,
	const int* strideC)
{
	const Matrix product{c, *rows, *columns, *strideC};
	product.setZero();
	addProduct(
		1.0, {a, *rows, *inner, *strideA}, {b, *columns, *inner, *strideB}, product, Blocks::All);
}

/// The lower triangle of c = a a^T. Above it, too, numbers may change: CHOLMOD reads none.
void dsyrk_(
	const char*,
	const char*,
	const int* rows,
	const int* inner,
	const double*,
	double* a,
	const int* strideA,
	const double*,
	double* c,
	const int* strideC)
{
	const Matrix factor{a, *rows, *inner, *strideA}, product{c, *rows, *rows, *strideC};
	product.setZero();
	addProduct(1.0, factor, factor, product, Blocks::Lower);
}

/// b = b a^-T for the lower triangle a.
void dtrsm_(
	const char*,
	const char*,
	const char*,
	const char*,
	const int* rows,
	const int* columns,
	const double*,
	double* a,
	const int* strideA,
	double* b,
	const int* strideB)
{
	divide({a, *columns, *columns, *strideA}, {b, *rows, *columns, *strideB});
}

/// The factor of the lower triangle a. Where that fails, and where checkpoint() has thrown, the first column
/// is named: CHOLMOD then ends at once, while it would repeat what comes before a later one.
void dpotrf_(const char*, const int* size, double* a, const int* stride, int* info)
{
	const bool isFactored = factorize({a, *size, *size, *stride});
	*info = isFactored && ricci::checkpointInCholmod(0.0) ? 0 : 1;
}

// The loops of CHOLMOD that are parallel with OpenMP, in one thread.
void GOMP_parallel(void (*loop)(void*), void* data, unsigned, unsigned)
{
	loop(data);
}

int omp_get_num_threads()
{
	return 1;
}

int omp_get_thread_num()
{
	return 0;
}

/// In place of SuiteSparse_time(), by the linker: CHOLMOD times every product of a factorisation, which nobody asks for
/// and takes up to 2 % of a run.
double __wrap_SuiteSparse_time() // NOLINT(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
{
	return 0.0;
}

// Complex factors: never asked for.
void zgemm_()
{
	std::abort();
}

void zherk_()
{
	std::abort();
}

void zpotrf_()
{
	std::abort();
}

void ztrsm_()
{
	std::abort();
}

/// Prints nothing, unlike CHOLMOD's own.
int cholmod_l_error(int status, const char*, int, const char*, cholmod_common* common)
{
	common->status = status;
	return 1;
}

int cholmod_l_metis(
	cholmod_sparse*, SuiteSparse_long*, std::size_t, int, SuiteSparse_long*, cholmod_common* common)
{
	common->status = CHOLMOD_NOT_INSTALLED;
	return 0;
}

SuiteSparse_long cholmod_l_nested_dissection(
	cholmod_sparse*,
	SuiteSparse_long*,
	std::size_t,
	SuiteSparse_long*,
	SuiteSparse_long*,
	SuiteSparse_long*,
	cholmod_common* common)
{
	common->status = CHOLMOD_NOT_INSTALLED;
	return -1;
}

} // extern "C"
