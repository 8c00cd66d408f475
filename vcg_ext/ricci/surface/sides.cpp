// SPDX-License-Identifier: GPL-3.0-or-later
#include "sides.h"

#include <algorithm>

namespace ricci {

Sides::Sides(const std::vector<Triangle>& triangles)
{
	struct Side
	{
		int low, high;
		Corner corner;
		bool ascends;
	};
	std::vector<Side> sides;
	sides.reserve(3 * triangles.size());
	m_across.resize(3 * triangles.size());
	for (const Corner c : m_across.indices()) {
		const Triangle& t = triangles[positionOf(c.face())];
		const int a = t[c.index()], b = t[c.next().index()];
		sides.push_back({std::min(a, b), std::max(a, b), c, a < b});
	}
	bucketSort(
		sides,
		[](const Side& s) { return s.low; },
		[](const Side& a, const Side& b) {
			return a.high != b.high ? a.high < b.high : a.corner < b.corner;
		});
	m_sides.reserve(sides.size());
	for (auto first = sides.begin(), last = first; first != sides.end(); first = last) {
		m_first.push_back(m_sides.size());
		for (; last != sides.end() && last->low == first->low && last->high == first->high; ++last)
			m_sides.push_back(last->corner);
		if (last - first == 2 && first->ascends != first[1].ascends) {
			m_across[first->corner] = first[1].corner;
			m_across[first[1].corner] = first->corner;
		}
	}
	m_first.push_back(m_sides.size());
}

} // namespace ricci
