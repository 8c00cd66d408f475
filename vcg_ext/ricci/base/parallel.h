// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PARALLEL_H
#define RICCI_PARALLEL_H

#include "task.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <future>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace ricci {

/// Threads that loops over elements use by default.
inline int defaultThreads()
{
	constexpr unsigned kMaxThreads = 16; // memory is what these loops wait for
	// Read once: the system opens a file to count its processors.
	static const int threads =
		static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, kMaxThreads));
	return threads;
}

/// Threads for tasks on so many triangles in all, each of which takes a microsecond or more: one where
/// the start of another would take longer than the tasks.
inline int threadsFor(std::int64_t triangles)
{
	constexpr std::int64_t kWorthAThread = 1000;
	return triangles < kWorthAThread ? 1 : defaultThreads();
}

/// Calls work(first, last) for parts of [0, count), up to \p threads of them at
/// a time. The parts must be independent and \p work must not throw. The parts'
/// bounds vary with the number of threads: a result that does not must not
/// depend on them, so sums over elements are not for here.
/// \param minPart elements that are worth a thread
template<class Work>
void inParallel(int count, int threads, const Work& work, int minPart = 16384)
{
	const int parts = std::clamp(count / minPart, 1, std::max(threads, 1));
	const auto bound = [&](int part) {
		return static_cast<int>(std::int64_t(count) * part / parts);
	};
	std::vector<std::thread> others;
	int own = 1; // parts from here on have no thread
	try {
		others.reserve(static_cast<std::size_t>(parts - 1));
		for (; own < parts; ++own)
			others.emplace_back(
				[&work, first = bound(own), last = bound(own + 1)] { work(first, last); });
	}
	catch (const std::system_error&) { // no more threads to be had
	}
	catch (const std::bad_alloc&) { // nor memory for one
	}
	work(0, bound(1));
	if (own < parts)
		work(bound(own), count);
	for (std::thread& other : others)
		other.join();
}

/// A thread that waits for others calls checkpoint() after each such time.
constexpr std::chrono::milliseconds kBetweenWaits(400);

/// Calls work(i) for every i of [0, count), each in one of \p threads threads, in any order. The tasks
/// must be independent of each other. checkpoint() is the run's own in the calling thread, which also calls
/// it before each task and while it waits for the others; in these it does nothing but end them once another
/// thread has thrown. What \p work or checkpoint() throws is thrown on.
template<class Work>
void tasksInParallel(int count, int threads, const Work& work)
{
	checkpoint();
	std::atomic<int> next{0};
	std::atomic<bool> ended{false};
	const double memory = Task::memoryLimit();
	std::vector<std::exception_ptr> thrown(static_cast<std::size_t>(std::max(threads, 1)));
	const auto unlessEnded = [&](std::size_t thread, const auto& run) {
		const HelpGuard guard(ended, memory);
		try {
			run();
		}
		catch (const HelpEnded&) {
		}
		catch (...) {
			thrown[thread] = std::current_exception();
			ended = true;
		}
	};
	const auto runTasks = [&] {
		for (int i = next++; i < count; i = next++) {
			checkpoint();
			work(i);
		}
	};
	std::vector<std::future<void>> others;
	try {
		others.reserve(thrown.size());
		for (std::size_t i = 1; i < std::min(thrown.size(), static_cast<std::size_t>(count)); ++i)
			others.push_back(std::async(std::launch::async, [&, i] { unlessEnded(i, runTasks); }));
	}
	catch (const std::system_error&) { // no more threads to be had
	}
	catch (const std::bad_alloc&) { // nor memory for one
	}
	unlessEnded(0, [&] {
		runTasks();
		for (const std::future<void>& other : others)
			while (other.wait_for(kBetweenWaits) != std::future_status::ready)
				checkpoint();
	});
	for (const std::future<void>& other : others)
		other.wait();
	for (const std::exception_ptr& exception : thrown)
		if (exception)
			std::rethrow_exception(exception);
}

/// Calls main() in the calling thread and meanwhile aside() in another one, if \p threads are more than
/// one; else first aside(), then main(). They must be independent of each other. checkpoint() is the run's
/// own in the calling thread, also while it waits; in the other one it does nothing but end \p aside once
/// the calling thread has thrown. What any of them throws is thrown on.
template<class Main, class Aside>
void besides(int threads, const Main& main, const Aside& aside)
{
	std::atomic<bool> ended{false};
	std::exception_ptr thrown;
	const double memory = Task::memoryLimit();
	std::future<void> other;
	if (threads > 1)
		try {
			other = std::async(std::launch::async, [&] {
				const HelpGuard guard(ended, memory);
				aside();
			});
		}
		catch (const std::system_error&) { // no more threads to be had
		}
		catch (const std::bad_alloc&) { // nor memory for one
		}
	if (!other.valid()) {
		aside();
		main();
		return;
	}
	try {
		main();
		while (other.wait_for(kBetweenWaits) != std::future_status::ready)
			checkpoint();
	}
	catch (...) {
		thrown = std::current_exception();
		ended = true;
	}
	try {
		other.get();
	}
	catch (const HelpEnded&) {
	}
	catch (...) {
		if (!thrown)
			thrown = std::current_exception();
	}
	if (thrown)
		std::rethrow_exception(thrown);
}

} // namespace ricci

#endif
