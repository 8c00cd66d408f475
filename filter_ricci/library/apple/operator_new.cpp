// SPDX-License-Identifier: GPL-3.0-or-later
// The operators new and delete of the library, compiled as hidden. A C++ library that is linked in brings its own, which
// could take the place of those of the program: not every linker can keep them inside. The memory is malloc's, as
// that of the system's operators, so that either may free what the other gave.
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

void* allocated(std::size_t size, std::size_t alignment)
{
	for (;;) {
		void* memory = nullptr;
		if (alignment <= alignof(std::max_align_t))
			memory = std::malloc(size == 0 ? 1 : size);
		else if (posix_memalign(&memory, alignment, size) != 0)
			memory = nullptr;
		if (memory != nullptr)
			return memory;
		const std::new_handler handler = std::get_new_handler();
		if (handler == nullptr)
			throw std::bad_alloc();
		handler();
	}
}

std::size_t of(std::align_val_t alignment)
{
	return static_cast<std::size_t>(alignment);
}

} // namespace

void* operator new(std::size_t size)
{
	return allocated(size, 1);
}

void* operator new[](std::size_t size)
{
	return allocated(size, 1);
}

void* operator new(std::size_t size, std::align_val_t alignment)
{
	return allocated(size, of(alignment));
}

void* operator new[](std::size_t size, std::align_val_t alignment)
{
	return allocated(size, of(alignment));
}

void operator delete(void* memory) noexcept
{
	std::free(memory);
}

void operator delete[](void* memory) noexcept
{
	std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept
{
	std::free(memory);
}

void operator delete[](void* memory, std::size_t) noexcept
{
	std::free(memory);
}

void operator delete(void* memory, std::align_val_t) noexcept
{
	std::free(memory);
}

void operator delete[](void* memory, std::align_val_t) noexcept
{
	std::free(memory);
}

void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
	std::free(memory);
}

void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept
{
	std::free(memory);
}
