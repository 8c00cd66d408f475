// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PARALLEL_H
#define RICCI_PARALLEL_H

#include "crew.h"
#include "task.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <thread>

#ifdef __linux__
#include <sched.h>
#endif

namespace ricci {

/// Processors that this process may use.
inline int processors()
{
#ifdef __linux__
	cpu_set_t allowed; // fails where it has too little room for all
	if (sched_getaffinity(0, sizeof allowed, &allowed) == 0)
		return CPU_COUNT(&allowed);
#endif
	return static_cast<int>(std::thread::hardware_concurrency());
}

/// Threads that loops over elements use by default.
inline int defaultThreads()
{
	// No more than 16: memory is what these loops wait for. Asked for once: that is a call of the system.
	static const int threads = std::clamp(processors(), 1, 16);
	return threads;
}

/// Threads for tasks on so many triangles in all, each of which takes a microsecond or more: one where
/// the start of another would take longer than the tasks.
inline int threadsFor(std::int64_t triangles)
{
	return triangles < 1000 ? 1 : defaultThreads();
}

/// Calls work(first, last) for parts of [0, count), up to \p threads of them at
/// a time. The parts must be independent and \p work must not throw. The parts'
/// bounds vary with the number of threads: a result that does not must not
/// depend on them, so sums over elements are not for here.
/// \param minPart elements that are worth a thread's help
template<class Work>
void inParallel(int count, int threads, const Work& work, int minPart = 8192)
{
	// More parts than threads, so that one that comes late or is interrupted does less.
	const int parts = threads > 1 ? std::clamp(count / minPart, 1, 4 * threads) : 1;
	if (parts == 1) {
		work(0, count);
		return;
	}
	const auto bound = [&](int part) {
		return static_cast<int>(std::int64_t(count) * part / parts);
	};
	std::atomic<int> next{0};
	const auto workOnParts = [&] {
		for (int i = next++; i < parts; i = next++)
			work(bound(i), bound(i + 1));
	};
	const Crew crew;
	const Crew::Offer offer(std::min(threads, parts) - 1, workOnParts);
	workOnParts();
}

/// A thread that waits for others calls checkpoint() after each such time.
constexpr std::chrono::milliseconds kBetweenWaits(400);

/// Calls own() in the calling thread and meanwhile help() in up to \p helpers others: fewer where there are
/// no more threads. checkpoint() is the run's own in the calling thread, which also calls it while it waits for
/// the others; in these it does nothing but end them. Once one thread has thrown, the others end. What any of
/// them throws is thrown on.
template<class Own, class Help>
void withHelpers(int helpers, const Own& own, const Help& help)
{
	HelpFlag flag;
	std::exception_ptr ofOwn, ofHelp;
	const auto unlessEnded = [&](const auto& run, std::exception_ptr& thrown) {
		const HelpFlag* before = HelpFlag::exchange(&flag);
		try {
			run();
		}
		catch (const HelpEnded&) {
		}
		catch (...) {
			if (!flag.end() || &thrown == &ofOwn) // the caller's comes first
				thrown = std::current_exception();
		}
		HelpFlag::exchange(before);
	};
	const auto asHelper = [&] { unlessEnded(help, ofHelp); };
	{
		const Crew crew;
		Crew::Offer offer(helpers, asHelper);
		const auto runAndWait = [&] {
			own();
			while (!offer.end(kBetweenWaits))
				checkpoint();
		};
		unlessEnded(runAndWait, ofOwn);
	}
	for (const std::exception_ptr& thrown : {ofOwn, ofHelp})
		if (thrown)
			std::rethrow_exception(thrown);
	if (flag.isEnded()) // by those whom this thread helps
		throw HelpEnded();
}

/// Calls work(i) for every i of [0, count), each in one of \p threads threads, in any order, with
/// withHelpers(); checkpoint() before each of them. The tasks must be independent of each other.
template<class Work>
void tasksInParallel(int count, int threads, const Work& work)
{
	checkpoint();
	std::atomic<int> next{0};
	const auto runTasks = [&] {
		for (int i = next++; i < count; i = next++) {
			checkpoint();
			work(i);
		}
	};
	withHelpers(std::min(threads, count) - 1, runTasks, runTasks);
}

/// Calls main() in the calling thread and meanwhile aside() in another one, if \p threads are more than
/// one and that is to be had before main() is done; else one after the other. See withHelpers(). They must be
/// independent of each other. What main() throws ends aside(); what aside() throws is thrown on once main() is
/// done, so that of two errors it always is main()'s.
template<class Main, class Aside>
void besides(int threads, const Main& main, const Aside& aside)
{
	std::atomic<bool> isTaken{false};
	std::exception_ptr ofAside;
	const auto unlessTaken = [&] {
		if (isTaken.exchange(true))
			return;
		try {
			aside();
		}
		catch (const HelpEnded&) {
			throw;
		}
		catch (...) {
			ofAside = std::current_exception();
		}
	};
	const auto both = [&] {
		main();
		unlessTaken();
	};
	withHelpers(threads > 1 ? 1 : 0, both, unlessTaken);
	if (ofAside)
		std::rethrow_exception(ofAside);
}

} // namespace ricci

#endif
