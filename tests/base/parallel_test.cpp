// SPDX-License-Identifier: GPL-3.0-or-later
// Needs nothing but the header, so that the thread sanitizer can have it alone.
#include <ricci/base/parallel.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

namespace ricci::testing {
namespace {

using Tick = std::function<void()>;

TEST(InParallel, EveryElementIsInOnePart)
{
	for (const int count : {0, 1, 7, 1000, 40000})
		for (const int threads : {0, 1, 2, 5})
			for (const int minPart : {1, 100, 16384}) {
				std::vector<int> times(static_cast<std::size_t>(count), 0);
				inParallel(
					count,
					threads,
					[&](int first, int last) {
						for (int i = first; i < last; ++i)
							++times[static_cast<std::size_t>(i)];
					},
					minPart);
				EXPECT_EQ(std::count(times.begin(), times.end(), 1), count);
			}
}

TEST(TasksInParallel, EachIsDoneOnceAndTheCallingThreadAloneTicks)
{
	for (const int count : {0, 1, 3, 500})
		for (const int threads : {0, 1, 2, 5}) {
			const auto caller = std::this_thread::get_id();
			int ticks = 0;
			const Tick tick = [&] {
				EXPECT_EQ(std::this_thread::get_id(), caller);
				++ticks;
			};
			std::vector<long> sums(static_cast<std::size_t>(count), 0);
			tasksInParallel(count, threads, tick, [&](int i, const Tick& own) {
				for (int k = 0; k <= i; ++k) {
					own();
					sums[static_cast<std::size_t>(i)] += k;
				}
			});
			EXPECT_GE(ticks, 1);
			for (int i = 0; i < count; ++i)
				EXPECT_EQ(sums[static_cast<std::size_t>(i)], long(i) * (i + 1) / 2);
		}
}

TEST(TasksInParallel, WhatATaskOrTheTickThrowsEndsAll)
{
	for (const int threads : {1, 2, 5}) {
		std::vector<char> done(200, 0);
		const auto work = [&](int i, const Tick& own) {
			own();
			if (i == 20)
				throw std::runtime_error("a task");
			done[static_cast<std::size_t>(i)] = 1;
		};
		EXPECT_THROW(
			tasksInParallel(
				200, threads, [] {}, work),
			std::runtime_error);
		EXPECT_EQ(done[20], 0);
		EXPECT_LT(std::count(done.begin(), done.end(), 1), 200);
		// No task ends by itself: the others hear that the tick has thrown.
		int ticks = 0;
		EXPECT_THROW(
			tasksInParallel(
				threads,
				threads,
				[&] {
					if (++ticks == 100)
						throw std::logic_error("the tick");
				},
				[](int, const Tick& own) {
					for (;;)
						own();
				}),
			std::logic_error);
	}
}

/// The task in the other thread goes on after the caller's own is done.
TEST(TasksInParallel, TheTickIsHeardWhileTheCallerWaits)
{
	const auto caller = std::this_thread::get_id();
	std::atomic<bool> begun{false}, left{false};
	EXPECT_THROW(
		tasksInParallel(
			2,
			2,
			[&] {
				if (left)
					throw std::logic_error("the tick");
			},
			[&](int, const Tick& own) {
				if (std::this_thread::get_id() != caller) {
					begun = true;
					for (;;)
						own();
				}
				for (int i = 0; !begun && i < 100000; ++i)
					std::this_thread::sleep_for(std::chrono::microseconds(100));
				left = true;
			}),
		std::logic_error);
}

/// Both sides write into one array, to places of their own, which are read when both are done.
TEST(Besides, BothAreDoneAndSeenAfterwards)
{
	for (const int threads : {1, 2})
		for (int run = 0; run < 50; ++run) {
			std::vector<int> both(2000, 0);
			int ticks = 0;
			besides(
				threads,
				[&] { ++ticks; },
				[&] { std::iota(both.begin(), both.begin() + 1000, 0); },
				[&](const Tick& own) {
					for (std::size_t i = 1000; i < both.size(); ++i) {
						own();
						both[i] = static_cast<int>(i);
					}
				});
			for (std::size_t i = 0; i < both.size(); ++i)
				EXPECT_EQ(both[i], static_cast<int>(i));
			EXPECT_GE(ticks, threads == 1 ? 1000 : 0);
		}
}

TEST(Besides, WhatIsThrownInOneEndsTheOther)
{
	for (int run = 0; run < 20; ++run) {
		std::vector<int> written(100, 0);
		EXPECT_THROW(
			besides(
				2,
				[] {},
				[] { throw std::runtime_error("main"); },
				[&](const Tick& own) {
					for (std::size_t i = 0;; ++i) {
						own();
						++written[i % written.size()];
					}
				}),
			std::runtime_error);
		// It has ended: nothing writes any more.
		const std::vector<int> seen = written;
		EXPECT_EQ(written, seen);
		EXPECT_THROW(
			besides(
				2, [] {}, [] {}, [](const Tick&) { throw std::logic_error("aside"); }),
			std::logic_error);
	}
}

} // namespace
} // namespace ricci::testing
