// SPDX-License-Identifier: GPL-3.0-or-later
#include "failing_malloc.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#ifdef RICCI_CAN_FAIL_MALLOC
#include <link.h>
#endif

namespace {

/// Held by one thread at a time. Never allocates.
class SpinLock
{
public:
	explicit SpinLock(std::atomic_flag& flag) : m_flag(flag)
	{
		while (m_flag.test_and_set(std::memory_order_acquire)) {
		}
	}
	~SpinLock() { m_flag.clear(std::memory_order_release); }
	SpinLock(const SpinLock&) = delete;
	SpinLock& operator=(const SpinLock&) = delete;

private:
	std::atomic_flag& m_flag;
};

/// The blocks handed out since begin(), and which of them have been given back. Never allocates.
class Ledger
{
public:
	void begin()
	{
		const SpinLock lock(m_busy);
		++m_run;
		m_count = 0;
		m_twice = 0;
	}

	void end()
	{
		const SpinLock lock(m_busy);
		m_count = kMaxCount;
	}

	/// \param block may be null, a failure
	void handOut(void* block)
	{
		const SpinLock lock(m_busy);
		if (block != nullptr && m_count < kMaxCount)
			slot(block).live = true;
	}

	/// \return whether it may be freed
	bool takeBack(void* block)
	{
		const SpinLock lock(m_busy);
		if (block == nullptr || m_count >= kMaxCount)
			return true;
		Slot& s = slot(block);
		if (!s.live)
			++m_twice;
		return std::exchange(s.live, false);
	}

	long twice()
	{
		const SpinLock lock(m_busy);
		return m_twice;
	}

private:
	static constexpr std::size_t kSlots = std::size_t(1) << 16, kMaxCount = kSlots / 2;

	struct Slot
	{
		const void* block;
		long run;
		bool live;
	};

	/// A block that is not in the ledger is older than it, and alive.
	Slot& slot(const void* block)
	{
		std::size_t i = (reinterpret_cast<std::uintptr_t>(block) >> 4) * 0x9E3779B97F4A7C15u;
		for (i %= kSlots; m_slots[i].run == m_run && m_slots[i].block != block;
			 i = (i + 1) % kSlots) {
		}
		if (m_slots[i].run != m_run) {
			m_slots[i] = {block, m_run, true};
			++m_count;
		}
		return m_slots[i];
	}

	Slot m_slots[kSlots] = {};
	long m_run = 0, m_twice = 0;
	std::size_t m_count = kMaxCount;
	std::atomic_flag m_busy = ATOMIC_FLAG_INIT;
};

/// Where the code of a library lies. Empty if it is not loaded.
struct CodeRange
{
	std::uintptr_t begin = 0, end = 0;

	bool contains(const void* address) const
	{
		const auto a = reinterpret_cast<std::uintptr_t>(address);
		return a >= begin && a < end;
	}
};

CodeRange openMp()
{
	CodeRange range;
#ifdef RICCI_CAN_FAIL_MALLOC
	dl_iterate_phdr(
		[](dl_phdr_info* info, std::size_t, void* data) {
			if (std::strstr(info->dlpi_name, "libgomp") == nullptr)
				return 0;
			auto* found = static_cast<CodeRange*>(data);
			found->begin = info->dlpi_addr;
			for (int i = 0; i < info->dlpi_phnum; ++i)
				found->end = std::max<std::uintptr_t>(
					found->end,
					info->dlpi_addr + info->dlpi_phdr[i].p_vaddr + info->dlpi_phdr[i].p_memsz);
			return 1;
		},
		&range);
#endif
	return range;
}

/// Counts the allocations since begin() and decides which of them fail.
class Countdown
{
public:
	void begin(long n, bool lasting)
	{
		m_openMp = openMp();
		m_lasting = lasting;
		m_failures = 0;
		m_left = n;
	}

	void end() { m_left = -1; }

	bool mustFail(const void* caller)
	{
		// The usual case first: this is called for every allocation of the process.
		if (m_left < 0 || m_openMp.contains(caller))
			return false;
		const SpinLock lock(m_busy);
		if (m_left < 0)
			return false; // another thread took the only failure
		if (m_left > 0) {
			--m_left;
			return false;
		}
		if (!m_lasting)
			m_left = -1;
		++m_failures;
		errno = ENOMEM;
		return true;
	}

	long count() const { return m_failures; }

private:
	CodeRange m_openMp;
	bool m_lasting = false;
	std::atomic<long> m_left{-1}, m_failures{0}; // left: that succeed; -1: none fails
	std::atomic_flag m_busy = ATOMIC_FLAG_INIT;
};

// Initialised before the first allocation of the process, because nothing has to run for it.
Ledger ledger;
Countdown countdown;

} // namespace

#ifdef RICCI_CAN_FAIL_MALLOC
namespace {

void* handedOut(void* block)
{
	ledger.handOut(block);
	return block;
}

} // namespace

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);

void* malloc(std::size_t size)
{
	return countdown.mustFail(__builtin_return_address(0)) ? nullptr
														   : handedOut(__libc_malloc(size));
}
void* calloc(std::size_t count, std::size_t size)
{
	return countdown.mustFail(__builtin_return_address(0)) ? nullptr
														   : handedOut(__libc_calloc(count, size));
}
void* realloc(void* block, std::size_t size)
{
	if (countdown.mustFail(__builtin_return_address(0)) || !ledger.takeBack(block))
		return nullptr;
	void* moved = __libc_realloc(block, size);
	ledger.handOut(moved == nullptr && size > 0 ? block : moved); // a failure leaves the old block
	return moved;
}
void* memalign(std::size_t alignment, std::size_t size)
{
	return countdown.mustFail(__builtin_return_address(0))
			   ? nullptr
			   : handedOut(__libc_memalign(alignment, size));
}
void* aligned_alloc(std::size_t alignment, std::size_t size)
{
	return countdown.mustFail(__builtin_return_address(0))
			   ? nullptr
			   : handedOut(__libc_memalign(alignment, size));
}
void free(void* block)
{
	if (ledger.takeBack(block))
		__libc_free(block);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size)
{
	if (countdown.mustFail(__builtin_return_address(0)))
		return ENOMEM;
	*block = handedOut(__libc_memalign(alignment, size));
	return *block == nullptr ? ENOMEM : 0;
}
}
#endif

namespace ricci::testing {

FailingMalloc::FailingMalloc(long n, Failing which)
{
	ledger.begin();
	countdown.begin(n, which == Failing::AllThatFollow);
}

void FailingMalloc::end()
{
	countdown.end();
	ledger.end();
}

long FailingMalloc::failures() const
{
	return countdown.count();
}

long FailingMalloc::freedTwice() const
{
	return ledger.twice();
}

} // namespace ricci::testing
