// SPDX-License-Identifier: GPL-3.0-or-later
// What iterations share: a line search, descent directions, the mixing of fixed points.
#ifndef RICCI_ITERATION_H
#define RICCI_ITERATION_H

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ricci {

/// Shortens a step until a function falls enough along it: by a share of what its slope promises
/// [Nocedal Wright 2006, 3.1, 3.5]. The next length is that of the lowest point of the parabola through
/// both values with the slope, within bounds.
struct LineSearch
{
	/// The share of the promised decrease that a step must reach (Armijo's rule).
	static constexpr double kDecrease = 1e-4;

	double shortest;                                 ///< the search fails below
	double minShortening = 0.1, maxShortening = 0.5; ///< factors from one length to the next

	/// The first step has the length 1.
	/// \param slope of the function at length 0, negative
	/// \param now its value there
	/// \param valueAt valueAt(length); where it is not finite, the step is shortened by maxShortening
	/// \param accepts accepts(), asked where the value is low enough
	/// \return the length, or 0
	template<class Value, class Accepts>
	double run(double slope, double now, const Value& valueAt, const Accepts& accepts) const
	{
		double length = 1.0;
		while (length >= shortest) {
			const double value = valueAt(length), promised = slope * length;
			if (value <= now + kDecrease * promised && accepts())
				return length;
			const double vertex = -promised / (2.0 * (value - now - promised));
			length *= std::isfinite(value) ? std::clamp(vertex, minShortening, maxShortening)
										   : maxShortening;
		}
		return 0.0;
	}

	template<class Value>
	double run(double slope, double now, const Value& valueAt) const
	{
		return run(slope, now, valueAt, [] { return true; });
	}
};

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
		using Reals = Eigen::Map<const Eigen::VectorXd>;
		return Reals(reinterpret_cast<const double*>(a.data()), 2 * a.size())
			.dot(Reals(reinterpret_cast<const double*>(b.data()), 2 * b.size()));
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

/// Acceleration of a fixed-point iteration x <- g(x) [Anderson 1965]: the next x is the affine
/// combination of the last images g(x_i) whose coefficients make the combination of their residuals
/// g(x_i) - x_i shortest in the least-squares sense (in the unconstrained form of
/// [Walker Ni 2011], without damping).
class AndersonMixing
{
public:
	/// \param depth how many steps back the combination reaches; 0 is the plain iteration
	explicit AndersonMixing(std::size_t depth) : m_depth(depth) {}

	/// The next x.
	/// \param x the present one, of the same length in all calls
	/// \param image g(x)
	std::vector<double> next(const std::vector<double>& x, const std::vector<double>& image)
	{
		const auto vector = [](const std::vector<double>& values) {
			return Eigen::Map<const Eigen::VectorXd>(
				values.data(), static_cast<Eigen::Index>(values.size()));
		};
		m_images.emplace_back(vector(image));
		m_residuals.emplace_back(vector(image) - vector(x));
		if (m_images.size() > m_depth + 1) {
			m_images.erase(m_images.begin());
			m_residuals.erase(m_residuals.begin());
		}
		// With the differences of consecutive residuals as columns the least-squares problem has no
		// constraint on its coefficients.
		const std::size_t m = m_images.size() - 1;
		if (m == 0)
			return image;
		Eigen::MatrixXd differences(x.size(), m);
		for (std::size_t k = 0; k < m; ++k)
			differences.col(static_cast<Eigen::Index>(k)) = m_residuals[k + 1] - m_residuals[k];
		const Eigen::VectorXd c = differences.colPivHouseholderQr().solve(m_residuals.back());
		Eigen::VectorXd mixed = m_images.back();
		for (std::size_t k = 0; k < m; ++k)
			mixed -= c[static_cast<Eigen::Index>(k)] * (m_images[k + 1] - m_images[k]);
		return {mixed.data(), mixed.data() + mixed.size()};
	}

	/// Forgets the steps so far.
	void restart() { m_images.clear(), m_residuals.clear(); }

private:
	std::size_t m_depth;
	std::vector<Eigen::VectorXd> m_images, m_residuals; ///< residual: image - x; oldest first
};

} // namespace ricci

#endif
