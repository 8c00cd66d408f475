// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_ANDERSON_MIXING_H
#define RICCI_ANDERSON_MIXING_H

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace ricci {

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
	std::vector<double> next(const std::vector<double>& x, const std::vector<double>& image);

	/// Forgets the steps so far.
	void restart() { m_images.clear(), m_residuals.clear(); }

private:
	std::size_t m_depth;
	std::vector<Eigen::VectorXd> m_images, m_residuals; ///< residual: image - x; oldest first
};

} // namespace ricci

#endif
