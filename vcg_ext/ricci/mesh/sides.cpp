// SPDX-License-Identifier: GPL-3.0-or-later
#include "sides.h"

#include <algorithm>

namespace ricci {

namespace {

/// Numbers of the vertices of triangles, in the order of their indices: not many more than there are vertices.
class VertexNumbers
{
public:
	explicit VertexNumbers(const std::vector<Triangle>& triangles)
	{
		if (triangles.empty())
			return;
		int last = m_first = triangles.front()[0];
		for (const Triangle& t : triangles)
			for (const int v : t) {
				m_first = std::min(m_first, v);
				last = std::max(last, v);
			}
		m_count = last + 1 - m_first;
		if (m_count / 4 < static_cast<int>(3 * triangles.size()))
			return;
		for (const Triangle& t : triangles)
			m_known.insert(m_known.end(), t.begin(), t.end());
		std::sort(m_known.begin(), m_known.end());
		m_known.erase(std::unique(m_known.begin(), m_known.end()), m_known.end());
		m_count = static_cast<int>(m_known.size());
	}

	int count() const { return m_count; }
	int operator()(int v) const
	{
		if (m_known.empty())
			return v - m_first;
		return static_cast<int>(
			std::lower_bound(m_known.begin(), m_known.end(), v) - m_known.begin());
	}

private:
	int m_first = 0, m_count = 0;
	std::vector<int> m_known; // sorted, if there are few of those from the first to the last
};

} // namespace

Sides::Sides(const std::vector<Triangle>& triangles)
{
	struct Side
	{
		int end; ///< number of its lower end in the first sort, of its higher one in the second
		Corner corner;
	};
	m_across.resize(3 * triangles.size());
	m_sides.reserve(m_across.size());
	m_first.reserve(m_across.size() / 2 + 1);
	const VertexNumbers number(triangles);
	// By the lower end, of each by the higher one, of each by corner.
	const Adjacency<int, Side> byHigh(number.count(), [&](const auto& add) {
		int corner = 0;
		for (const Triangle& t : triangles) {
			const int a = number(t[0]), b = number(t[1]), c = number(t[2]);
			add(std::max(a, b), Side{std::min(a, b), Corner(corner++)});
			add(std::max(b, c), Side{std::min(b, c), Corner(corner++)});
			add(std::max(c, a), Side{std::min(c, a), Corner(corner++)});
		}
	});
	const Adjacency<int, Side> byLow(number.count(), [&](const auto& add) {
		for (int high = 0; high < number.count(); ++high)
			for (const Side& side : byHigh[high])
				add(side.end, Side{high, side.corner});
	});
	const auto start = [&](Corner c) { return triangles[positionOf(c.face())][c.index()]; };
	for (int low = 0; low < number.count(); ++low) {
		const ItemRange<const Side> sides = byLow[low];
		for (const Side *first = sides.begin(), *last = first; first != sides.end(); first = last) {
			m_first.push_back(m_sides.size());
			for (; last != sides.end() && last->end == first->end; ++last)
				m_sides.push_back(last->corner);
			const Corner side = first->corner, other = last[-1].corner;
			if (last - first == 2 && start(side) != start(other)) {
				m_across[side] = other;
				m_across[other] = side;
			}
		}
	}
	m_first.push_back(m_sides.size());
}

} // namespace ricci
