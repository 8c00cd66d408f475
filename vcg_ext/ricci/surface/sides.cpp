// SPDX-License-Identifier: GPL-3.0-or-later
#include "sides.h"

#include <algorithm>

namespace ricci {

Sides::Sides(const std::vector<Triangle>& triangles)
{
	const auto start = [&](Corner c) { return triangles[positionOf(c.face())][c.index()]; };
	const auto low = [&](Corner c) { return std::min(start(c), start(c.next())); };
	const auto high = [&](Corner c) { return std::max(start(c), start(c.next())); };
	m_across.resize(3 * triangles.size());
	m_sides.reserve(m_across.size());
	for (const Corner c : m_across.indices())
		m_sides.push_back(c);
	bucketSort(m_sides.values(), low, [&](Corner a, Corner b) {
		const int highA = high(a), highB = high(b);
		return highA != highB ? highA < highB : a < b;
	});
	for (int first = 0, last = 0; first < m_sides.size(); first = last) {
		m_first.push_back(first);
		const Corner side = m_sides[first];
		const int lowEnd = low(side), highEnd = high(side);
		while (last < m_sides.size() && low(m_sides[last]) == lowEnd &&
			   high(m_sides[last]) == highEnd)
			++last;
		if (last - first != 2)
			continue;
		const Corner other = m_sides[first + 1];
		if (start(side) != start(other)) {
			m_across[side] = other;
			m_across[other] = side;
		}
	}
	m_first.push_back(m_sides.size());
}

} // namespace ricci
