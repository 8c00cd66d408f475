// SPDX-License-Identifier: GPL-3.0-or-later
#include "factored_hessian.h"

#include "../base/tolerances.h"
#include "../error.h"

#include <algorithm>
#include <cmath>

namespace ricci {

namespace {

/// From one shift to the next, up to that entry.
constexpr double kShiftGrowth = 100.0;

} // namespace

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

void FactoredHessian::continueOn(const CurvatureMap& from, const CurvatureMap& to)
{
	m_revision = m_revision == from.revision() ? to.revision() : -1;
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
