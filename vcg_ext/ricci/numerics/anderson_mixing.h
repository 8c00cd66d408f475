// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_ANDERSON_MIXING_H
#define RICCI_ANDERSON_MIXING_H

#include <Eigen/QR>

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
