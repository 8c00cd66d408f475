// SPDX-License-Identifier: GPL-3.0-or-later
#include "hessian.h"

#include "../numbers.h"

#include <algorithm>

namespace ricci {

void Hessian::layOut(const CurvatureMap& map, const std::vector<int>& unknown, int unknownCount)
{
	const Triangulation& t = map.triangulation();
	const int edgeCount = t.edgeCount();
	m_rowOfOrigin.resize(at(edgeCount));
	m_rowOfTarget.resize(at(edgeCount));
	m_offDiagonal.assign(at(edgeCount), -1);
	m_diagonal.resize(at(unknownCount));

	// Column c: its diagonal first, then one entry for each edge to a higher unknown.
	std::vector<int> columnSize(at(unknownCount), 1);
	for (int e = 0; e < edgeCount; ++e) {
		const int a = m_rowOfOrigin[at(e)] = unknown[at(t.origin(2 * e))];
		const int b = m_rowOfTarget[at(e)] = unknown[at(t.target(2 * e))];
		if (a >= 0 && b >= 0 && a != b)
			++columnSize[at(std::min(a, b))];
	}
	std::vector<int> columnStart(at(unknownCount) + 1, 0);
	for (int c = 0; c < unknownCount; ++c)
		columnStart[at(c) + 1] = columnStart[at(c)] + columnSize[at(c)];
	struct Entry
	{
		int row, edge;
	};
	std::vector<Entry> entries(at(columnStart.back()));
	std::vector<int> cursor(columnStart.begin(), columnStart.end() - 1);
	for (int c = 0; c < unknownCount; ++c)
		entries[at(cursor[at(c)]++)] = {c, -1};
	for (int e = 0; e < edgeCount; ++e) {
		const int a = m_rowOfOrigin[at(e)], b = m_rowOfTarget[at(e)];
		if (a >= 0 && b >= 0 && a != b)
			entries[at(cursor[at(std::min(a, b))]++)] = {std::max(a, b), e};
	}

	m_matrix.resize(unknownCount, unknownCount);
	m_matrix.resizeNonZeros(columnStart.back());
	int* outer = m_matrix.outerIndexPtr();
	int* inner = m_matrix.innerIndexPtr();
	int slot = 0;
	for (int c = 0; c < unknownCount; ++c) {
		const auto first = entries.begin() + columnStart[at(c)];
		const auto last = entries.begin() + columnStart[at(c) + 1];
		std::sort(first, last, [](const Entry& a, const Entry& b) {
			return a.row != b.row ? a.row < b.row : a.edge < b.edge;
		});
		outer[c] = slot;
		for (auto entry = first; entry != last; ++entry) {
			if (entry == first || entry->row != (entry - 1)->row)
				inner[slot++] = entry->row;
			if (entry->edge < 0)
				m_diagonal[at(c)] = slot - 1;
			else
				m_offDiagonal[at(entry->edge)] = slot - 1;
		}
	}
	outer[unknownCount] = slot;
	m_matrix.resizeNonZeros(slot);
}

void Hessian::fill(const CurvatureMap& map, double shift)
{
	double* value = m_matrix.valuePtr();
	std::fill(value, value + m_matrix.nonZeros(), 0.0);
	for (int slot : m_diagonal)
		value[slot] = shift;
	for (std::size_t e = 0; e < m_offDiagonal.size(); ++e) {
		const double w = map.weights()[e];
		const double C = map.cosineLess1()[e];
		const int a = m_rowOfOrigin[e], b = m_rowOfTarget[e];
		if (a >= 0 && a == b) {
			// A loop has its own circle at both ends: 2 w cosh(l) - 2 w. Two ends that are
			// different vertices never share a row.
			value[m_diagonal[at(a)]] += 2.0 * w * C;
			continue;
		}
		if (a >= 0)
			value[m_diagonal[at(a)]] += w * (1.0 + C);
		if (b >= 0)
			value[m_diagonal[at(b)]] += w * (1.0 + C);
		if (m_offDiagonal[e] >= 0)
			value[m_offDiagonal[e]] -= w;
	}
}

double Hessian::largestDiagonal() const
{
	double largest = 0.0;
	for (int slot : m_diagonal)
		largest = std::max(largest, m_matrix.valuePtr()[slot]);
	return largest;
}

} // namespace ricci
