// SPDX-License-Identifier: GPL-3.0-or-later
// Threads that do not start.
#include "../support/failing_malloc.h"
#include "../support/shapes.h"

#include <ricci/base/parallel.h>
#include <ricci/base/task.h>

#include <algorithm>
#include <vector>

namespace ricci::testing {
namespace {

TEST(Parallel, WithoutMemoryForThreadsTheWorkIsDoneAllTheSame)
{
	RICCI_NEEDS_FAILING_MALLOC();
	constexpr int kCount = 100000;
	std::vector<int> done;
	const long tried = failEveryAllocation(
		Failing::AllThatFollow,
		[&] { done.assign(kCount, 0); },
		[&] {
			inParallel(kCount, 4, [&](int first, int last) {
				for (int i = first; i < last; ++i)
					++done[at(i)];
			});
		},
		[&](bool completed, long, long n) {
			EXPECT_TRUE(completed) << "allocation " << n;
			EXPECT_EQ(std::count(done.begin(), done.end(), 1), kCount) << "allocation " << n;
		});
	EXPECT_GT(tried, 1);
}

TEST(Besides, WithoutMemoryForAThreadBothAreDoneAllTheSame)
{
	RICCI_NEEDS_FAILING_MALLOC();
	int main = 0, aside = 0;
	const long tried = failEveryAllocation(
		Failing::AllThatFollow,
		[&] { main = aside = 0; },
		[&] {
			besides(
				2, [&] { ++main; }, [&] { ++aside; });
		},
		[&](bool completed, long, long n) {
			EXPECT_TRUE(completed) << "allocation " << n;
			EXPECT_EQ(main, 1) << "allocation " << n;
			EXPECT_EQ(aside, 1) << "allocation " << n;
		});
	EXPECT_GT(tried, 1);
}

/// More than int can number.
TEST(MemoryEstimate, RefusesWhatCannotBeNumbered)
{
	EXPECT_NO_THROW(requireMemory(10000, 10000, false));
	EXPECT_THROW(requireMemory(400000000, 400000000, false), TooLarge);
	EXPECT_THROW(requireOverlayMemory(1000000000, false), TooLarge);
}

} // namespace
} // namespace ricci::testing
