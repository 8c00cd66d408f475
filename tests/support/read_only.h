// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_READ_ONLY_H
#define RICCI_TESTS_READ_ONLY_H

#ifdef __linux__

#include <cstddef>
#include <cstdint>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

namespace ricci::testing {

/// While it lives the whole pages of a vector's storage cannot be written: an attempt ends the
/// process. The pages at both ends, which the vector shares with others, stay as they are.
template<class T>
class ReadOnly
{
public:
	explicit ReadOnly(std::vector<T>& items)
	{
		const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
		const auto first = reinterpret_cast<std::uintptr_t>(items.data());
		const auto last = first + items.size() * sizeof(T);
		m_begin = (first + page - 1) / page * page;
		m_size = last / page * page - m_begin;
		m_works = protect(PROT_READ);
	}
	~ReadOnly() { protect(PROT_READ | PROT_WRITE); }
	ReadOnly(const ReadOnly&) = delete;
	ReadOnly& operator=(const ReadOnly&) = delete;

	/// Whether there is such a page, and the system protects it.
	bool works() const { return m_works && m_size > 0; }

private:
	bool protect(int access) const
	{
		return mprotect(reinterpret_cast<void*>(m_begin), m_size, access) == 0;
	}

	std::uintptr_t m_begin = 0;
	std::size_t m_size = 0;
	bool m_works = false;
};

} // namespace ricci::testing

#endif

#endif
