// SPDX-License-Identifier: GPL-3.0-or-later
#include "hessian.h"

#include "../base/adjacency.h"
#include "../base/tolerances.h"
#include "../error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci {

namespace {

/// From one shift to the next, up to that entry.
constexpr double kShiftGrowth = 100.0;

} // namespace

void Hessian::layOut(const CurvatureMap& map, const VertexArray<int>& row, int unknowns)
{
	const Triangulation& t = map.triangulation();
	m_rowOfOrigin.resize(t.edgeCount());
	m_rowOfTarget.resize(t.edgeCount());
	m_offDiagonal.assign(t.edgeCount(), -1);
	m_diagonal.resize(unknowns);

	for (const Edge e : t.edges()) {
		m_rowOfOrigin[e] = row[t.origin(e.halfedge())];
		m_rowOfTarget[e] = row[t.target(e.halfedge())];
	}
	// Of each column the rows and their edges: no edge on the diagonal.
	using Entry = std::pair<int, Edge>;
	Adjacency<int, Entry> columns(unknowns, [&](const auto& add) {
		for (int c = 0; c < unknowns; ++c)
			add(c, Entry(c, Edge()));
		for (const Edge e : t.edges()) {
			const auto [low, high] = std::minmax(m_rowOfOrigin[e], m_rowOfTarget[e]);
			if (low >= 0 && low != high)
				add(low, Entry(high, e));
		}
	});
	m_matrix.resize(unknowns, unknowns);
	m_matrix.resizeNonZeros(static_cast<Eigen::Index>(columns.items().size()));
	int* outer = m_matrix.outerIndexPtr();
	int* inner = m_matrix.innerIndexPtr();
	int slot = 0;
	for (int c = 0; c < unknowns; ++c) {
		const ItemRange<Entry> column = columns[c];
		std::sort(column.begin(), column.end());
		outer[c] = slot;
		int last = -1;
		for (const auto& [r, e] : column) {
			if (r != last)
				inner[slot++] = last = r;
			(e.isValid() ? m_offDiagonal[e] : m_diagonal[c]) = slot - 1;
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

FactoredHessian::FactoredHessian(
	const VertexArray<char>& fixed, bool scaleInvariant, const VertexArray<Vertex>& mirror) :
		m_row(fixed.size(), -1)
{
	const bool anyFixed = std::find(fixed.begin(), fixed.end(), 1) != fixed.end();
	const Vertex pinned = !anyFixed && scaleInvariant ? Vertex(0) : Vertex();
	for (const Vertex v : fixed.indices()) {
		const Vertex first = mirror.empty() ? v : std::min(v, mirror[v]);
		if (first != v)
			m_row[v] = m_row[first];
		else if (!fixed[v] && v != pinned)
			m_row[v] = m_unknowns++;
	}
}

void FactoredHessian::fill(const CurvatureMap& map, double shift)
{
	if (m_revision != map.revision()) {
		m_hessian.layOut(map, m_row, m_unknowns);
		m_revision = map.revision();
	}
	m_hessian.fill(map, shift);
}

bool FactoredHessian::factorize(const CurvatureMap& map)
{
	double shift = map.brokenTriangles() > 0 ? kRegularisation : 0.0;
	fill(map, shift);
	m_isFactored = false;
	const double scale = std::max(m_hessian.largestDiagonal(), 1.0);
	while (!m_cholesky.factorize(m_hessian.matrix())) {
		shift = std::max(kShiftGrowth * shift, kFirstShift * scale);
		if (!(shift <= scale) || std::isinf(shift))
			throw SolverFailed(SolverFailed::Flow);
		m_hessian.fill(map, shift);
	}
	m_isFactored = true;
	m_isShifted = shift > 0.0;
	return !m_isShifted;
}

Eigen::VectorXd FactoredHessian::gather(const VertexVector& values) const
{
	Eigen::VectorXd rows = Eigen::VectorXd::Zero(m_unknowns);
	for (const Vertex v : m_row.indices())
		if (m_row[v] >= 0)
			rows[m_row[v]] += values[v];
	return rows;
}

VertexVector FactoredHessian::scatter(const Eigen::VectorXd& rows) const
{
	VertexVector values(m_row.size());
	for (const Vertex v : m_row.indices())
		values[v] = m_row[v] >= 0 ? rows[m_row[v]] : 0.0;
	return values;
}

} // namespace ricci
