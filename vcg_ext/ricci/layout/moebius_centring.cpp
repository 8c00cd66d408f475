// SPDX-License-Identifier: GPL-3.0-or-later
#include "moebius_centring.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace ricci {

namespace {

using Vector = Eigen::Vector3d;

/// Newton steps; each is quadratic near the end.
constexpr int kMostSteps = 200;

/// A step goes no further than this in the hyperbolic metric of the ball.
constexpr double kLongestStep = 2.0;

/// |sum w x| / sum w below which the points count as centred.
constexpr double kCentred = 1e-14;

/// Below this a step that wins nothing has met rounding.
constexpr double kStalled = 1e-10;

/// Share of the slope that a step must win; where the slope is rounding, any step will do.
constexpr double kArmijo = 1e-4, kNoSlope = 1e-14;

/// The boost by \p d: the Lorentz transformation of the light cone (1, x) that moves the centre of
/// the ball by |d| against d. \p energy receives sum w log of the factors of the first coordinate.
void boost(
	const std::vector<Point3>& from,
	const std::vector<double>& weights,
	const Vector& d,
	std::vector<Point3>& to,
	double& energy)
{
	const double length = d.norm();
	const Vector axis = length > 0.0 ? Vector(d / length) : Vector(Vector::UnitX());
	const double c = std::cosh(length), s = std::sinh(length);
	energy = 0.0;
	for (std::size_t i = 0; i < from.size(); ++i) {
		const Vector x(from[i][0], from[i][1], from[i][2]);
		const double along = axis.dot(x);
		// 1 - along without cancellation near the pole.
		const double away =
			along > 0.0 ? (x - along * axis).squaredNorm() / (1.0 + along) : 1.0 - along;
		const double time = c - s + s * away; // c - s along
		const Vector moved = x + axis * ((c - 1.0) * along - s);
		const Vector y = (moved / time).normalized();
		to[i] = {y[0], y[1], y[2]};
		energy += weights[i] * std::log(time);
	}
}

} // namespace

double centreByMoebius(std::vector<Point3>& points, const std::vector<double>& weights)
{
	double total = 0.0;
	for (double w : weights)
		total += w;
	if (points.empty() || !(total > 0.0))
		return 0.0;
	std::vector<Point3> trial(points.size());
	double offset = 1.0;
	for (int step = 0; step < kMostSteps; ++step) {
		// At the present place: gradient -mean, Hessian 1 - mean of x x^T.
		Vector mean = Vector::Zero();
		Eigen::Matrix3d hessian = Eigen::Matrix3d::Identity();
		for (std::size_t i = 0; i < points.size(); ++i) {
			const Vector x(points[i][0], points[i][1], points[i][2]);
			mean += weights[i] / total * x;
			hessian -= weights[i] / total * x * x.transpose();
		}
		const bool better = mean.norm() < offset;
		offset = mean.norm();
		if (offset < kCentred || (step > 0 && !better && offset < kStalled))
			break;
		hessian.diagonal().array() += 1e-12;
		Vector d = hessian.ldlt().solve(mean);
		if (!d.allFinite() || d.dot(mean) <= 0.0)
			d = mean;
		d *= std::min(1.0, kLongestStep / d.norm());
		double energy = 0.0;
		bool moved = false;
		for (int halving = 0; halving < 40 && !moved; ++halving) {
			boost(points, weights, d, trial, energy);
			const double slope = -d.dot(mean) * total; // of the energy along d
			moved = energy <= kArmijo * slope || std::abs(slope) < kNoSlope * total;
			if (!moved)
				d *= 0.5;
		}
		if (!moved)
			break;
		points.swap(trial);
	}
	return offset;
}

} // namespace ricci
