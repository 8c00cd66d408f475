// SPDX-License-Identifier: GPL-3.0-or-later
#include "anderson_mixing.h"

#include <Eigen/QR>

namespace ricci {

std::vector<double>
AndersonMixing::next(const std::vector<double>& x, const std::vector<double>& image)
{
	const std::size_t n = x.size();
	std::vector<double> residual(n);
	for (std::size_t i = 0; i < n; ++i)
		residual[i] = image[i] - x[i];
	m_images.push_back(image);
	m_residuals.push_back(residual);
	if (m_images.size() > m_depth + 1) {
		m_images.erase(m_images.begin());
		m_residuals.erase(m_residuals.begin());
	}
	const std::size_t m = m_images.size() - 1;
	if (m == 0)
		return image;
	// With the differences of consecutive residuals as columns the least-squares problem has no
	// constraint on its coefficients.
	Eigen::MatrixXd differences(n, m);
	for (std::size_t k = 0; k < m; ++k)
		for (std::size_t i = 0; i < n; ++i)
			differences(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
				m_residuals[k + 1][i] - m_residuals[k][i];
	const Eigen::VectorXd c = differences.colPivHouseholderQr().solve(
		Eigen::Map<const Eigen::VectorXd>(residual.data(), static_cast<Eigen::Index>(n)));
	std::vector<double> mixed = image;
	for (std::size_t k = 0; k < m; ++k)
		for (std::size_t i = 0; i < n; ++i)
			mixed[i] -= c[static_cast<Eigen::Index>(k)] * (m_images[k + 1][i] - m_images[k][i]);
	return mixed;
}

} // namespace ricci
