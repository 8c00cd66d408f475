// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_LIMITED_MEMORY_BFGS_H
#define RICCI_LIMITED_MEMORY_BFGS_H

#include <Eigen/Core>

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
	LimitedMemoryBfgs(Eigen::Index unknowns, int depth);

	/// Remembers a step and what it changed of the gradient, unless the function bends down along
	/// it.
	void remember(const Eigen::VectorXcd& step, const Eigen::VectorXcd& change);

	/// The direction of descent at \p gradient.
	/// \param solve solve(rhs, x) applies the first approximation, which must be positive definite
	template<class Solve>
	void
	direction(const Eigen::VectorXcd& gradient, const Solve& solve, Eigen::VectorXcd& direction)
	{
		m_reduced = -gradient;
		reduce();
		solve(m_reduced, direction);
		complete(direction);
	}

	/// The scalar product of the real and imaginary parts.
	static double dot(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b);

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
	void reduce();
	void complete(Eigen::VectorXcd& direction);

	int m_depth, m_next = 0, m_known = 0;
	std::vector<Step> m_steps; ///< a ring
	Eigen::VectorXcd m_reduced;
};

} // namespace ricci

#endif
