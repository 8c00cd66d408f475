// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_NUMBER_RANGES_H
#define RICCI_NUMBER_RANGES_H

#include "../base/indexed.h"

#include <vector>

namespace ricci {

/// The numbers 0, 1, 2, ... divided into consecutive ranges, one for each index of the type \p I.
template<class I>
class NumberRanges
{
public:
	NumberRanges() : m_first(1, 0) {}

	/// Range i gets the next \p size(i) numbers.
	template<class Size>
	NumberRanges(IndexRange<I> indices, Size size) : NumberRanges()
	{
		m_first.reserve(positionOf(indices.size()) + 1);
		for (const I i : indices)
			append(size(i));
	}

	/// Adds one more range.
	void append(int size) { m_first.push_back(m_first.back() + size); }

	int first(I i) const { return m_first[positionOf(i)]; }
	int last(I i) const { return m_first[positionOf(i) + 1]; } ///< one past the range
	int size(I i) const { return last(i) - first(i); }
	int total() const { return m_first.back(); }

private:
	std::vector<int> m_first;
};

} // namespace ricci

#endif
