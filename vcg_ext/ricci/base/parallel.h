// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PARALLEL_H
#define RICCI_PARALLEL_H

#include <algorithm>
#include <cstdint>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace ricci {

/// Threads that loops over elements use by default.
inline int defaultThreads()
{
	constexpr unsigned kMost = 16; // memory is what these loops wait for
	return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, kMost));
}

/// Calls work(first, last) for parts of [0, count), up to \p threads of them at
/// a time. The parts must be independent and \p work must not throw. The parts'
/// bounds vary with the number of threads: a result that does not must not
/// depend on them, so sums over elements are not for here.
template<class Work>
void inParallel(int count, int threads, const Work& work)
{
	constexpr int kLeastPart = 16384; // elements that are worth a thread
	const int parts = std::clamp(count / kLeastPart, 1, std::max(threads, 1));
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

} // namespace ricci

#endif
