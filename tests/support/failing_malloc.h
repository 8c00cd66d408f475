// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_FAILING_MALLOC_H
#define RICCI_TESTS_FAILING_MALLOC_H

#include <gtest/gtest.h>

#include <new>

// A C library whose allocations fail on demand. A program that lists failing_malloc.cpp among its
// sources has it in place of malloc() and its kin for the whole process, CHOLMOD and BLAS included.
// It needs glibc, and no address sanitizer, which brings an allocator of its own.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
#define RICCI_CAN_FAIL_MALLOC
#endif

/// The first statement of a test that uses FailingMalloc: skips the test where it cannot work.
#ifdef RICCI_CAN_FAIL_MALLOC
#define RICCI_NEEDS_FAILING_MALLOC()
#else
#define RICCI_NEEDS_FAILING_MALLOC()                                                               \
	GTEST_SKIP() << "SKIPPED: allocations can be made to fail with glibc and without sanitizers"
#endif

namespace ricci::testing {

/// Which allocations fail.
enum class Failing {
	One,          ///< a single one
	AllThatFollow ///< it and every later one
};

/// From its construction to end() one allocation of the process fails, in whichever thread, as if
/// memory had run out; or all from this one on. Those of libgomp, which CHOLMOD calls, are neither
/// counted nor made to fail: it ends the process when one of its own fails. All blocks are recorded
/// meanwhile, to see one freed twice: glibc itself sees this only where nothing has taken the block
/// in between. A second release is counted and not carried out. After some 30000 blocks no more are
/// recorded. One object at a time; does nothing without RICCI_CAN_FAIL_MALLOC.
class FailingMalloc
{
public:
	/// \param n allocations that succeed before the one that fails
	FailingMalloc(long n, Failing which);
	~FailingMalloc() { end(); }
	FailingMalloc(const FailingMalloc&) = delete;
	FailingMalloc& operator=(const FailingMalloc&) = delete;

	/// Allocations succeed again.
	void end();

	/// Allocations that were made to fail. 0 if there were no more than n.
	long failures() const;

	/// Blocks that were released again after their release.
	long freedTwice() const;
};

/// Fails the n-th allocation of \p action, for n = 0, 1, ..., in growing steps after some hundred, until it
/// runs through without one.
/// \param check is called after each try, with whether the action came to its end, the number of
/// failures, and n
/// \return how many n were tried
template<class Prepare, class Action, class Check>
long failEveryAllocation(Failing which, Prepare prepare, Action action, Check check)
{
	for (long n = 0;; n += 1 + n / 256) {
		prepare();
		bool completed = false, expected = true;
		FailingMalloc failing(n, which);
		try {
			action();
			completed = true;
		}
		catch (const std::bad_alloc&) {
		}
		catch (...) {
			expected = false;
		}
		failing.end();
		EXPECT_EQ(failing.freedTwice(), 0) << "freed twice after the failure of allocation " << n;
		EXPECT_TRUE(expected) << "another exception than bad_alloc at allocation " << n;
		check(completed, failing.failures(), n);
		if (failing.failures() == 0 || ::testing::Test::HasFailure())
			return n;
	}
}

} // namespace ricci::testing

#endif
