// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_BYTES_H
#define RICCI_TESTS_BYTES_H

#include <string>
#include <type_traits>

namespace ricci::testing {

/// The bytes of numbers, and of arrays of them.
struct Bytes
{
	std::string all;

	template<class T>
	void add(const T& value)
	{
		static_assert(std::is_trivially_copyable_v<T>);
		all.append(reinterpret_cast<const char*>(&value), sizeof value);
	}
	template<class Range>
	void addAll(const Range& range)
	{
		for (const auto& value : range)
			add(value);
		all += '|';
	}
};

} // namespace ricci::testing

#endif
