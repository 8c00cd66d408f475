// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_ONE_THREAD_H
#define RICCI_ONE_THREAD_H

#include <mutex>

#if defined(RICCI_USE_CHOLMOD) && !defined(RICCI_STATIC_CHOLMOD) && defined(__GNUC__) &&           \
	defined(__ELF__)
// Defined where the BLAS behind CHOLMOD is OpenBLAS, and where CHOLMOD was built with OpenMP.
extern "C" {
__attribute__((weak)) void openblas_set_num_threads(int);
__attribute__((weak)) int openblas_get_num_threads(void);
__attribute__((weak)) void omp_set_max_active_levels(int);
__attribute__((weak)) int omp_get_max_active_levels(void);
}
#define RICCI_THREAD_CONTROL
#endif

namespace ricci {

/// While there is one, CHOLMOD and the BLAS below it use one thread: how many there are must not change a
/// bit of the result, and CHOLMOD's own loops are so short that threads cost more than they save.
class OneThread
{
public:
	OneThread()
	{
#ifdef RICCI_THREAD_CONTROL
		Libraries& own = libraries();
		const std::lock_guard<std::mutex> lock(own.mutex);
		if (own.users++ > 0)
			return;
		if (openblas_set_num_threads && openblas_get_num_threads) {
			own.blasThreads = openblas_get_num_threads();
			if (own.blasThreads > 1)
				openblas_set_num_threads(1);
		}
		if (omp_set_max_active_levels && omp_get_max_active_levels) {
			own.levels = omp_get_max_active_levels();
			omp_set_max_active_levels(0);
		}
#endif
	}
	~OneThread()
	{
#ifdef RICCI_THREAD_CONTROL
		Libraries& own = libraries();
		const std::lock_guard<std::mutex> lock(own.mutex);
		if (--own.users > 0)
			return;
		if (own.blasThreads > 1)
			openblas_set_num_threads(own.blasThreads);
		if (own.levels >= 0)
			omp_set_max_active_levels(own.levels);
#endif
	}
	OneThread(const OneThread&) = delete;
	OneThread& operator=(const OneThread&) = delete;

#ifdef RICCI_THREAD_CONTROL
private:
	/// What they are set to is common to all threads: the first user changes it, the last one puts it
	/// back.
	struct Libraries
	{
		std::mutex mutex;
		int users = 0, blasThreads = 0, levels = -1;
	};
	static Libraries& libraries()
	{
		static Libraries common;
		return common;
	}
#endif
};

} // namespace ricci

#endif
