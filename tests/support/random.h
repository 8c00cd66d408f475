// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_RANDOM_H
#define RICCI_TESTS_RANDOM_H

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace ricci::testing {

/// Random numbers that are the same with every standard library: its engines are specified to the
/// bit, its distributions are not.
class Random
{
public:
	explicit Random(std::uint64_t seed) : m_engine(seed) {}

	/// Uniform in [low, high).
	double real(double low, double high)
	{
		return low + (high - low) * static_cast<double>(m_engine() >> 11) * 0x1p-53;
	}

	/// Uniform in 0 .. n - 1; the bias of the remainder is of no concern here.
	int index(int n) { return static_cast<int>(m_engine() % static_cast<std::uint64_t>(n)); }

	bool coin() { return (m_engine() & 1) != 0; }

	template<class T>
	void shuffle(std::vector<T>& items)
	{
		for (std::size_t i = items.size(); i > 1; --i)
			std::swap(items[i - 1], items[static_cast<std::size_t>(index(static_cast<int>(i)))]);
	}

private:
	std::mt19937_64 m_engine;
};

} // namespace ricci::testing

#endif
