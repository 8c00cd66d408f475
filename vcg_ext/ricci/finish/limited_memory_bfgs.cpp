// SPDX-License-Identifier: GPL-3.0-or-later
#include "limited_memory_bfgs.h"

#include <algorithm>

namespace ricci {

LimitedMemoryBfgs::LimitedMemoryBfgs(Eigen::Index unknowns, int depth) :
		m_depth(depth), m_steps(static_cast<std::size_t>(depth)), m_reduced(unknowns)
{
	for (Step& s : m_steps) {
		s.step.resize(unknowns);
		s.change.resize(unknowns);
	}
}

double LimitedMemoryBfgs::dot(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b)
{
	// std::complex is two doubles.
	using Parts = Eigen::Map<const Eigen::VectorXd>;
	return Parts(reinterpret_cast<const double*>(a.data()), 2 * a.size())
		.dot(Parts(reinterpret_cast<const double*>(b.data()), 2 * b.size()));
}

void LimitedMemoryBfgs::remember(const Eigen::VectorXcd& step, const Eigen::VectorXcd& change)
{
	const double product = dot(step, change);
	if (!(product > 0.0))
		return;
	Step& s = back(0);
	s.step = step;
	s.change = change;
	s.product = product;
	m_next = (m_next + 1) % m_depth;
	m_known = std::min(m_known + 1, m_depth);
}

void LimitedMemoryBfgs::reduce()
{
	for (int i = 1; i <= m_known; ++i) {
		Step& s = back(i);
		s.share = dot(s.step, m_reduced) / s.product;
		m_reduced -= s.share * s.change;
	}
}

void LimitedMemoryBfgs::complete(Eigen::VectorXcd& direction)
{
	for (int i = m_known; i >= 1; --i) {
		const Step& s = back(i);
		direction += (s.share - dot(s.change, direction) / s.product) * s.step;
	}
}

} // namespace ricci
