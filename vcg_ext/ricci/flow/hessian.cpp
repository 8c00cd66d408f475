// SPDX-License-Identifier: GPL-3.0-or-later
#include "hessian.h"

#include <algorithm>

namespace ricci {

void Hessian::layOut(const CurvatureMap& map, const VertexArray<int>& row, int unknowns)
{
	const Triangulation& t = map.triangulation();
	m_rowOfOrigin.resize(t.edgeCount());
	m_rowOfTarget.resize(t.edgeCount());
	m_offDiagonal.assign(t.edgeCount(), -1);
	m_diagonal.resize(unknowns);

	// Column c: its diagonal first, then one entry for each edge to a higher unknown.
	Array<int> columnSize(unknowns, 1);
	for (const Edge e : t.edges()) {
		const int a = m_rowOfOrigin[e] = row[t.origin(e.halfedge())];
		const int b = m_rowOfTarget[e] = row[t.target(e.halfedge())];
		if (a >= 0 && b >= 0 && a != b)
			++columnSize[std::min(a, b)];
	}
	Array<int> columnStart(unknowns + 1, 0);
	for (int c = 0; c < unknowns; ++c)
		columnStart[c + 1] = columnStart[c] + columnSize[c];
	struct Entry
	{
		int row;
		Edge edge; // none on the diagonal
	};
	Array<Entry> entries(columnStart.back());
	Array<int> cursor = columnStart;
	for (int c = 0; c < unknowns; ++c)
		entries[cursor[c]++] = {c, Edge()};
	for (const Edge e : t.edges()) {
		const int a = m_rowOfOrigin[e], b = m_rowOfTarget[e];
		if (a >= 0 && b >= 0 && a != b)
			entries[cursor[std::min(a, b)]++] = {std::max(a, b), e};
	}

	m_matrix.resize(unknowns, unknowns);
	m_matrix.resizeNonZeros(columnStart.back());
	int* outer = m_matrix.outerIndexPtr();
	int* inner = m_matrix.innerIndexPtr();
	int slot = 0;
	for (int c = 0; c < unknowns; ++c) {
		const auto first = entries.begin() + columnStart[c];
		const auto last = entries.begin() + columnStart[c + 1];
		std::sort(first, last, [](const Entry& a, const Entry& b) {
			return a.row != b.row ? a.row < b.row : a.edge < b.edge;
		});
		outer[c] = slot;
		for (auto entry = first; entry != last; ++entry) {
			if (entry == first || entry->row != (entry - 1)->row)
				inner[slot++] = entry->row;
			if (entry->edge.isValid())
				m_offDiagonal[entry->edge] = slot - 1;
			else
				m_diagonal[c] = slot - 1;
		}
	}
	outer[unknowns] = slot;
	m_matrix.resizeNonZeros(slot);
}

void Hessian::fill(const CurvatureMap& map, double shift)
{
	double* value = m_matrix.valuePtr();
	std::fill(value, value + m_matrix.nonZeros(), 0.0);
	for (const int slot : m_diagonal)
		value[slot] = shift;
	for (const Edge e : m_offDiagonal.indices()) {
		const double w = map.weights()[e];
		const double C = map.cosineLess1()[e];
		const int a = m_rowOfOrigin[e], b = m_rowOfTarget[e];
		if (a >= 0 && a == b) {
			// A loop, or an edge between mirror images, has circles of one size at both ends: 2 w
			// cosh(l) - 2 w.
			value[m_diagonal[a]] += 2.0 * w * C;
			continue;
		}
		if (a >= 0)
			value[m_diagonal[a]] += w * (1.0 + C);
		if (b >= 0)
			value[m_diagonal[b]] += w * (1.0 + C);
		if (m_offDiagonal[e] >= 0)
			value[m_offDiagonal[e]] -= w;
	}
}

double Hessian::largestDiagonal() const
{
	double largest = 0.0;
	for (const int slot : m_diagonal)
		largest = std::max(largest, m_matrix.valuePtr()[slot]);
	return largest;
}

} // namespace ricci
