// SPDX-License-Identifier: GPL-3.0-or-later
#include <ricci/base/parallel.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <limits>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

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

/// While a crew lives, loops are helped by the same threads.
#ifdef __linux__
TEST(Processors, AreThoseThatTheProcessMayUse)
{
	cpu_set_t all, one;
	ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
	EXPECT_EQ(processors(), CPU_COUNT(&all));
	std::size_t first = 0;
	while (!CPU_ISSET(first, &all))
		++first;
	CPU_ZERO(&one);
	CPU_SET(first, &one);
	ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
	EXPECT_EQ(processors(), 1);
	ASSERT_EQ(sched_setaffinity(0, sizeof all, &all), 0);
}
#endif

TEST(Crew, ItsThreadsAreKept)
{
	std::mutex mutex;
	std::set<std::thread::id> seen;
	const Crew crew;
	for (int run = 0; run < 100; ++run)
		inParallel(
			30,
			3,
			[&](int, int) {
				const std::lock_guard<std::mutex> lock(mutex);
				seen.insert(std::this_thread::get_id());
			},
			1);
	EXPECT_LE(seen.size(), 3U);
	EXPECT_EQ(seen.count(std::this_thread::get_id()), 1U);
}

/// The only thread that could help is held: a loop that waited for it would not end.
TEST(Crew, NobodyWaitsForHelpThatHasNotBegun)
{
	std::atomic<bool> begun{false}, released{false};
	const Crew crew;
	const auto hold = [&] {
		begun = true;
		while (!released)
			std::this_thread::yield();
	};
	Crew::Offer held(1, hold);
	while (!begun)
		std::this_thread::yield();
	std::vector<int> times(1000, 0);
	const auto count = [&](int first, int last) {
		for (int i = first; i < last; ++i)
			++times[static_cast<std::size_t>(i)];
	};
	inParallel(1000, 2, count, 1);
	EXPECT_EQ(std::count(times.begin(), times.end(), 1), 1000);
	int aside = 0;
	besides(
		2, [] {}, [&] { ++aside; });
	EXPECT_EQ(aside, 1);
	EXPECT_FALSE(held.end(std::chrono::milliseconds(1)));
	released = true;
	while (!held.end(std::chrono::milliseconds(1)))
		std::this_thread::yield();
}

/// Calls \p update at every update.
class Caller : public Progress
{
public:
	explicit Caller(std::function<void(double)> update) : m_update(std::move(update)) {}
	bool update(double fraction, const std::string&) override
	{
		m_update(fraction);
		return true;
	}

private:
	std::function<void(double)> m_update;
};

TEST(TasksInParallel, EachIsDoneOnceAndTheCallingThreadAloneIsHeard)
{
	for (const int count : {0, 1, 3, 500})
		for (const int threads : {0, 1, 2, 5}) {
			const auto caller = std::this_thread::get_id();
			int updates = 0;
			Caller listener([&](double) {
				EXPECT_EQ(std::this_thread::get_id(), caller);
				++updates;
			});
			const Task task(listener);
			std::vector<long> sums(static_cast<std::size_t>(count), 0);
			tasksInParallel(count, threads, [&](int i) {
				for (int k = 0; k <= i; ++k) {
					checkpoint();
					sums[static_cast<std::size_t>(i)] += k;
				}
			});
			EXPECT_GE(updates, 1);
			for (int i = 0; i < count; ++i)
				EXPECT_EQ(sums[static_cast<std::size_t>(i)], long(i) * (i + 1) / 2);
		}
}

TEST(TasksInParallel, WhatATaskOrTheListenerThrowsEndsAll)
{
	for (const int threads : {1, 2, 5}) {
		std::vector<char> done(200, 0);
		const auto work = [&](int i) {
			checkpoint();
			if (i == 20)
				throw std::runtime_error("a task");
			done[static_cast<std::size_t>(i)] = 1;
		};
		EXPECT_THROW(tasksInParallel(200, threads, work), std::runtime_error);
		EXPECT_EQ(done[20], 0);
		EXPECT_LT(std::count(done.begin(), done.end(), 1), 200);
		// No task ends by itself: the others notice that the listener has thrown.
		int updates = 0;
		Caller listener([&](double) {
			if (++updates == 100)
				throw std::logic_error("the listener");
		});
		const Task task(listener);
		const auto endless = [](int) {
			for (;;)
				checkpoint();
		};
		EXPECT_THROW(tasksInParallel(threads, threads, endless), std::logic_error);
	}
}

/// What the caller throws ends help, and the help that this has.
TEST(TasksInParallel, HelpWithinHelpEndsWithIt)
{
	std::atomic<bool> begun{false};
	const auto endless = [&](int) {
		for (begun = true;;)
			checkpoint();
	};
	const auto fail = [&] {
		for (int i = 0; !begun && i < 100000; ++i)
			std::this_thread::sleep_for(std::chrono::microseconds(100));
		throw std::logic_error("the caller");
	};
	EXPECT_THROW(besides(2, fail, [&] { tasksInParallel(2, 2, endless); }), std::logic_error);
}

/// The task in the other thread goes on after the caller's own is done.
TEST(TasksInParallel, TheListenerIsHeardWhileTheCallerWaits)
{
	const auto caller = std::this_thread::get_id();
	std::atomic<bool> begun{false}, left{false};
	Caller listener([&](double) {
		if (left)
			throw std::logic_error("the listener");
	});
	const Task task(listener);
	const auto work = [&](int) {
		if (std::this_thread::get_id() != caller) {
			begun = true;
			for (;;)
				checkpoint();
		}
		for (int i = 0; !begun && i < 100000; ++i)
			std::this_thread::sleep_for(std::chrono::microseconds(100));
		left = true;
	};
	EXPECT_THROW(tasksInParallel(2, 2, work), std::logic_error);
}

/// Both sides write into one array, to places of their own, which are read when both are done.
TEST(Besides, BothAreDoneAndSeenAfterwards)
{
	for (const int threads : {1, 2})
		for (int run = 0; run < 50; ++run) {
			std::vector<int> both(2000, 0);
			int updates = 0;
			Caller listener([&](double) { ++updates; });
			const Task task(listener);
			besides(
				threads,
				[&] { std::iota(both.begin(), both.begin() + 1000, 0); },
				[&] {
					for (std::size_t i = 1000; i < both.size(); ++i) {
						checkpoint();
						both[i] = static_cast<int>(i);
					}
				});
			for (std::size_t i = 0; i < both.size(); ++i)
				EXPECT_EQ(both[i], static_cast<int>(i));
			EXPECT_GE(updates, threads == 1 ? 1000 : 0);
		}
}

TEST(Besides, OfTwoErrorsItIsThatOfTheCaller)
{
	for (const int threads : {1, 2})
		for (int run = 0; run < 20; ++run) {
			std::atomic<bool> hasFailed{threads == 1};
			const auto fails = [&] {
				while (!hasFailed)
					checkpoint();
				throw std::runtime_error("main");
			};
			const auto failsAside = [&] {
				hasFailed = true;
				throw std::logic_error("aside");
			};
			EXPECT_THROW(besides(threads, fails, failsAside), std::runtime_error);
		}
}

TEST(Besides, WhatIsThrownInOneEndsTheOther)
{
	for (int run = 0; run < 20; ++run) {
		std::vector<int> written(100, 0);
		const auto fails = [] { throw std::runtime_error("main"); };
		const auto writes = [&] {
			for (std::size_t i = 0;; ++i) {
				checkpoint();
				++written[i % written.size()];
			}
		};
		EXPECT_THROW(besides(2, fails, writes), std::runtime_error);
		// It has ended: nothing writes any more.
		const std::vector<int> seen = written;
		EXPECT_EQ(written, seen);
		const auto failsAside = [] { throw std::logic_error("aside"); };
		for (const int threads : {1, 2})
			EXPECT_THROW(
				besides(
					threads, [] {}, failsAside),
				std::logic_error);
	}
}

TEST(Task, PartsShareTheBarWhichNeverGoesBack)
{
	std::vector<double> fractions;
	Caller recorder([&](double fraction) { fractions.push_back(fraction); });
	const Task whole(recorder);
	advance(0.25, "begin");
	{
		const Task part(0.5, 1.0);
		advance(0.5, "part");
		const Task piece(0.0, 0.5); // of the part
		advance(1.0, "piece");
	}
	advance(0.25, "again");
	checkpoint();
	EXPECT_EQ(fractions, (std::vector<double>{0.25, 0.75, 0.75, 0.75, 0.75}));
}

TEST(Task, ItsMemoryLimitHoldsInItsPartsAndInThreadsThatHelp)
{
	EXPECT_EQ(Task::memoryLimit(), 0.0);
	Progress silent;
	Task whole(silent);
	whole.setMemoryLimit(1000.0);
	const Task part(0.0, 1.0);
	tasksInParallel(8, 4, [](int) { EXPECT_EQ(Task::memoryLimit(), 1000.0); });
}

TEST(Task, RefusesLimitsThatAreNone)
{
	Progress silent;
	for (const double limit : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
		EXPECT_THROW(Task(silent, limit), InvalidOption);
		Task task(silent);
		EXPECT_THROW(task.setMemoryLimit(limit), InvalidOption);
		EXPECT_EQ(Task::memoryLimit(), 0.0);
	}
	EXPECT_NO_THROW(checkpoint()); // no refused task is left behind
	EXPECT_NO_THROW(Task(silent, std::numeric_limits<double>::infinity()));
}

} // namespace
} // namespace ricci::testing
