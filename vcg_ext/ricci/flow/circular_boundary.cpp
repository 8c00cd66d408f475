// SPDX-License-Identifier: GPL-3.0-or-later
#include "circular_boundary.h"

#include "../numbers.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <complex>

namespace ricci {

namespace {

using Complex = std::complex<double>;

double arcOf(double side, double radius)
{
	return 2.0 * std::asin(std::min(1.0, side / (2.0 * radius)));
}

} // namespace

InscribedPolygon inscribedPolygon(const std::vector<double>& sides)
{
	const auto longestSide = std::max_element(sides.begin(), sides.end());
	const double longest = *longestSide;
	// Angle sum less 2 pi as a function of the radius: decreasing while the centre is inside. If it
	// is negative already where the longest side is a diameter, the centre lies beyond that side,
	// whose arc then is the larger of the two.
	const auto excess = [&](double radius, bool outside) {
		double sum = 0.0;
		for (auto side = sides.begin(); side != sides.end(); ++side)
			sum += outside && side == longestSide ? 2 * kPi - arcOf(*side, radius)
												  : arcOf(*side, radius);
		return sum - 2 * kPi;
	};
	const bool outside = excess(0.5 * longest, false) < 0.0;
	double low = 0.5 * longest, high = longest;
	const auto beyond = [&](double radius) {
		return outside ? excess(radius, true) > 0.0 : excess(radius, false) < 0.0;
	};
	while (!beyond(high) && std::isfinite(high))
		high *= 2.0;
	for (int i = 0; i < 200 && high - low > 1e-16 * high; ++i) {
		const double middle = 0.5 * (low + high);
		(beyond(middle) ? high : low) = middle;
	}
	InscribedPolygon polygon;
	polygon.radius = 0.5 * (low + high);
	double sum = 0.0;
	for (auto side = sides.begin(); side != sides.end(); ++side) {
		const double arc = arcOf(*side, polygon.radius);
		polygon.arcs.push_back(outside && side == longestSide ? 2 * kPi - arc : arc);
		sum += polygon.arcs.back();
	}
	for (double& arc : polygon.arcs)
		arc *= 2 * kPi / sum;
	return polygon;
}

std::vector<double> exteriorAngles(const std::vector<double>& arcs)
{
	std::vector<double> angles(arcs.size());
	for (std::size_t i = 0; i < arcs.size(); ++i)
		angles[i] = 0.5 * (arcs[i] + arcs[(i + arcs.size() - 1) % arcs.size()]);
	return angles;
}

std::vector<double> centredArcs(const std::vector<double>& arcs, const std::vector<double>& weights)
{
	const std::size_t n = arcs.size();
	std::vector<Complex> z(n);
	double angle = 0.0, total = 0.0;
	for (std::size_t i = 0; i < n; ++i) {
		z[i] = std::polar(1.0, angle);
		angle += arcs[i];
		total += weights[i];
	}
	if (*std::max_element(weights.begin(), weights.end()) >= 0.5 * total)
		return arcs;
	// Newton's method on the barycentre b of the present points: moving w to the centre changes b
	// by -w + conj(w) mean(z^2) to first order.
	for (int iteration = 0; iteration < 100; ++iteration) {
		Complex b = 0.0, square = 0.0;
		for (std::size_t i = 0; i < n; ++i) {
			b += weights[i] * z[i];
			square += weights[i] * z[i] * z[i];
		}
		b /= total, square /= total;
		if (std::abs(b) < 1e-15)
			break;
		Complex w = (b + square * std::conj(b)) / (1.0 - std::norm(square));
		const double size = std::abs(w);
		if (!(size < 0.5))
			w = b / std::abs(b) * 0.5 * std::abs(b);
		for (Complex& p : z) {
			p = (p - w) / (1.0 - std::conj(w) * p);
			p /= std::abs(p);
		}
	}
	std::vector<double> centred(n);
	double sum = 0.0;
	for (std::size_t i = 0; i < n; ++i) {
		double arc = std::arg(z[(i + 1) % n] * std::conj(z[i]));
		if (arc < 0.0)
			arc += 2 * kPi;
		sum += centred[i] = arc;
	}
	for (double& arc : centred)
		arc *= 2 * kPi / sum;
	return centred;
}

std::vector<double>
AndersonMixing::next(const std::vector<double>& x, const std::vector<double>& image)
{
	const std::size_t n = x.size();
	std::vector<double> residual(n);
	for (std::size_t i = 0; i < n; ++i)
		residual[i] = image[i] - x[i];
	m_points.push_back(image);
	m_residuals.push_back(residual);
	if (m_points.size() > m_depth + 1) {
		m_points.erase(m_points.begin());
		m_residuals.erase(m_residuals.begin());
	}
	const std::size_t m = m_points.size() - 1;
	if (m == 0)
		return image;
	// The affine combination of the last residuals that is least in the mean-square sense.
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
			mixed[i] -= c[static_cast<Eigen::Index>(k)] * (m_points[k + 1][i] - m_points[k][i]);
	return mixed;
}

} // namespace ricci
