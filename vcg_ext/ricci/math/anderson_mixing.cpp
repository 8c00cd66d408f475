// SPDX-License-Identifier: GPL-3.0-or-later
#include "anderson_mixing.h"

#include <Eigen/QR>

namespace ricci {

std::vector<double>
AndersonMixing::next(const std::vector<double>& x, const std::vector<double>& image)
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

} // namespace ricci
