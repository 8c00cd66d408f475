// SPDX-License-Identifier: GPL-3.0-or-later
// Needs nothing but the header, so that the thread sanitizer can have it alone. Mocks of OpenBLAS and OpenMP
// stand in for the libraries.
#undef RICCI_STATIC_CHOLMOD
#undef RICCI_USE_CHOLMOD
#define RICCI_USE_CHOLMOD
#include <ricci/numerics/one_thread.h>

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#ifdef RICCI_THREAD_CONTROL

namespace {

std::atomic<int> blasThreads{1};
thread_local int openMpLevels = 1;

} // namespace

extern "C" {
void openblas_set_num_threads(int threads)
{
	blasThreads = threads;
}
int openblas_get_num_threads()
{
	return blasThreads;
}
void omp_set_max_active_levels(int levels)
{
	openMpLevels = levels;
}
int omp_get_max_active_levels()
{
	return openMpLevels;
}
}

namespace ricci::testing {
namespace {

TEST(OneThread, TheLastUserPutsTheNumbersBack)
{
	for (const int threads : {4, 1, 7}) {
		blasThreads = threads;
		openMpLevels = 3;
		auto first = std::make_unique<OneThread>();
		EXPECT_EQ(blasThreads, 1);
		EXPECT_EQ(openMpLevels, 0);
		auto second = std::make_unique<OneThread>();
		second.reset();
		EXPECT_EQ(blasThreads, 1);
		EXPECT_EQ(openMpLevels, 0);
		first.reset();
		EXPECT_EQ(blasThreads, threads);
		EXPECT_EQ(openMpLevels, 3);
	}
}

TEST(OneThread, HoldsForEachOfManyThreads)
{
	constexpr int kThreads = 4, kRounds = 100000;
	blasThreads = 4;
	std::atomic<int> broken{0};
	std::vector<std::thread> threads;
	threads.reserve(kThreads);
	for (int t = 0; t < kThreads; ++t)
		threads.emplace_back([&broken, levels = t + 1] {
			openMpLevels = levels;
			for (int round = 0; round < kRounds; ++round) {
				{
					const OneThread oneThread;
					if (blasThreads != 1 || openMpLevels != 0)
						++broken;
				}
				if (openMpLevels != levels)
					++broken;
			}
		});
	for (std::thread& thread : threads)
		thread.join();
	EXPECT_EQ(broken, 0);
	EXPECT_EQ(blasThreads, 4);
}

} // namespace
} // namespace ricci::testing

#endif
