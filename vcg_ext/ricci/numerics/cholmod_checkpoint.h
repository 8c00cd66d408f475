// SPDX-License-Identifier: GPL-3.0-or-later
// checkpoint() during a factorisation by CHOLMOD, called by the BLAS in cholmod_blas.cpp. No exception may pass
// through CHOLMOD: what checkpoint() throws is kept for the thread until CHOLMOD has returned.
#ifndef RICCI_CHOLMOD_CHECKPOINT_H
#define RICCI_CHOLMOD_CHECKPOINT_H

#include "../base/task.h"

#include <exception>
#include <utility>

namespace ricci {

/// Products of two numbers from one call of checkpoint() to the next: some milliseconds.
constexpr double kProductsBetweenCheckpoints = 2e7;

/// What checkpoint() throws in the present factorisation of a thread. A pointer: an object with a destructor
/// would be registered in every thread, which ends the process where memory has run out.
inline thread_local std::exception_ptr* keptFromCholmod = nullptr;

/// To be called before \p products of two numbers.
/// \return false once checkpoint() has thrown: what is factorised will not be used
inline bool checkpointInCholmod(double products)
{
	static thread_local double sum = 0.0; // since the last call of checkpoint()
	sum += products;
	if (sum > kProductsBetweenCheckpoints && keptFromCholmod && !*keptFromCholmod) {
		sum = 0.0;
		try {
			checkpoint();
		}
		catch (...) {
			*keptFromCholmod = std::current_exception();
		}
	}
	return !keptFromCholmod || !*keptFromCholmod;
}

/// Calls \p factorize, which calls CHOLMOD, and throws what checkpoint() has thrown in it.
template<class Factorize>
void rethrowFromCholmod(const Factorize& factorize)
{
	std::exception_ptr kept, *const before = std::exchange(keptFromCholmod, &kept);
	factorize(); // C: nothing is thrown
	keptFromCholmod = before;
	if (kept)
		std::rethrow_exception(kept);
}

} // namespace ricci

#endif
