// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_BYTE_SOURCE_H
#define RICCI_TESTS_BYTE_SOURCE_H

#include <cstddef>
#include <cstdint>

namespace ricci::testing {

/// Decisions drawn from an input of the fuzzer, byte by byte. Behind its end the bytes go on as
/// pseudo-random numbers that its first eight bytes alone determine: short inputs describe large
/// meshes, and a change at the end of an input leaves the rest of the mesh as it was.
class ByteSource
{
public:
	ByteSource(const std::uint8_t* data, std::size_t size) : m_data(data), m_size(size)
	{
		for (std::size_t i = 0; i < 8 && i < size; ++i)
			m_state = (m_state << 8) + data[i];
	}

	std::uint8_t byte()
	{
		if (m_next < m_size)
			return m_data[m_next++];
		// splitmix64
		std::uint64_t z = m_state += 0x9e3779b97f4a7c15u;
		z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
		z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
		return static_cast<std::uint8_t>((z ^ (z >> 31)) >> 56);
	}

	/// 0 .. n - 1, one byte for n up to 256.
	int below(int n)
	{
		unsigned value = byte();
		for (unsigned range = 256; range < static_cast<unsigned>(n); range *= 256)
			value = 256 * value + byte();
		return static_cast<int>(value % static_cast<unsigned>(n));
	}

	/// True once in \p n.
	bool oneIn(int n) { return below(n) == n - 1; }

	/// In [low, high], with 16 bits.
	double real(double low, double high)
	{
		const int a = byte(), b = byte();
		return low + (high - low) * (256 * a + b) / 65535.0;
	}

private:
	const std::uint8_t* m_data;
	std::size_t m_size, m_next = 0;
	std::uint64_t m_state = 0;
};

} // namespace ricci::testing

#endif
