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
		if (omp_set_max_active_levels && omp_get_max_active_levels) {
			m_levels = omp_get_max_active_levels();
			omp_set_max_active_levels(0);
		}
		const std::lock_guard<std::mutex> lock(s_mutex);
		if (s_users++ > 0 || !openblas_set_num_threads || !openblas_get_num_threads)
			return;
		s_blasThreads = openblas_get_num_threads();
		if (s_blasThreads > 1)
			openblas_set_num_threads(1);
#endif
	}
	~OneThread()
	{
#ifdef RICCI_THREAD_CONTROL
		if (m_levels >= 0)
			omp_set_max_active_levels(m_levels);
		const std::lock_guard<std::mutex> lock(s_mutex);
		if (--s_users == 0 && s_blasThreads > 1)
			openblas_set_num_threads(s_blasThreads);
#endif
	}
	OneThread(const OneThread&) = delete;
	OneThread& operator=(const OneThread&) = delete;

#ifdef RICCI_THREAD_CONTROL
private:
	// OpenBLAS has one number of threads for all that call it: the first user changes it, the last one
	// puts it back.
	static inline std::mutex s_mutex;
	static inline int s_users = 0, s_blasThreads = 0;

	int m_levels = -1; // of OpenMP, which each thread has for itself
#endif
};

} // namespace ricci

#endif
