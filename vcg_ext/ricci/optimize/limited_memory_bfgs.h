// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_LIMITED_MEMORY_BFGS_H
#define RICCI_LIMITED_MEMORY_BFGS_H

#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace ricci {

/// Descent directions -H g of a function of complex unknowns from its gradients g: H is a first
/// approximation of the inverse of the second derivative, improved by what the last steps have
/// shown of it (limited-memory BFGS, the two-loop recursion of [Nocedal Wright 2006, 7.2]).
/// Allocates nothing after its construction.
class LimitedMemoryBfgs
{
public:
	/// \param depth number of steps that are remembered
	LimitedMemoryBfgs(Eigen::Index unknowns, int depth) :
			m_depth(depth), m_steps(
								static_cast<std::size_t>(depth),
								{Eigen::VectorXcd(unknowns), Eigen::VectorXcd(unknowns)}),
			m_reduced(unknowns)
	{
	}

	/// Remembers a step and what it changed of the gradient, unless the function bends down along
	/// it.
	void remember(const Eigen::VectorXcd& step, const Eigen::VectorXcd& change)
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

	/// The direction of descent at \p gradient.
	/// \param solve solve(rhs, x) applies the first approximation, which must be positive definite
	template<class Solve>
	void
	direction(const Eigen::VectorXcd& gradient, const Solve& solve, Eigen::VectorXcd& direction)
	{
		m_reduced = -gradient;
		for (int i = 1; i <= m_known; ++i) {
			Step& s = back(i);
			s.share = dot(s.step, m_reduced) / s.product;
			m_reduced -= s.share * s.change;
		}
		solve(m_reduced, direction);
		for (int i = m_known; i >= 1; --i) {
			const Step& s = back(i);
			direction += (s.share - dot(s.change, direction) / s.product) * s.step;
		}
	}

	/// The scalar product of the real and imaginary parts.
	static double dot(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b)
	{
		// std::complex is two doubles.
		using Parts = Eigen::Map<const Eigen::VectorXd>;
		return Parts(reinterpret_cast<const double*>(a.data()), 2 * a.size())
			.dot(Parts(reinterpret_cast<const double*>(b.data()), 2 * b.size()));
	}

private:
	struct Step
	{
		Eigen::VectorXcd step, change;
		double product = 0.0; ///< of the two
		double share = 0.0;   ///< in the present direction
	};

	Step& back(int steps)
	{
		return m_steps[static_cast<std::size_t>((m_next + m_depth - steps) % m_depth)];
	}

	int m_depth, m_next = 0, m_known = 0;
	std::vector<Step> m_steps; ///< a ring
	Eigen::VectorXcd m_reduced;
};

} // namespace ricci

#endif
