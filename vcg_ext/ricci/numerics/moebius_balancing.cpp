// SPDX-License-Identifier: GPL-3.0-or-later
#include "moebius_balancing.h"

#include "../base/tolerances.h"
#include "iteration.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace ricci {

namespace {

using Vector = Eigen::Vector3d;

/// Newton steps; near the end they converge quadratically.
constexpr int kMaxSteps = 200;

/// Largest length of a step in the hyperbolic metric of the ball.
constexpr double kMaxStep = 2.0;

/// The boost by \p d, as it acts on the sphere: the Lorentz transformation of the light cone of all
/// (1, x) that moves the centre of the ball by |d| against d. \p energy receives the change of the
/// minimised function: sum w log of the factors by which the first coordinates grow.
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

double balanceByMoebius(std::vector<Point3>& points, const std::vector<double>& weights)
{
	double total = 0.0;
	for (double w : weights)
		total += w;
	if (points.empty() || !(total > 0.0))
		return 0.0;
	std::vector<Point3> trial(points.size());
	double offset = 1.0;
	for (int step = 0; step < kMaxSteps; ++step) {
		// In units of the total weight, with the present centre at 0: the gradient is -mean, the
		// Hessian 1 - mean of x x^T.
		Vector mean = Vector::Zero();
		Eigen::Matrix3d hessian = Eigen::Matrix3d::Identity();
		for (std::size_t i = 0; i < points.size(); ++i) {
			const Vector x(points[i][0], points[i][1], points[i][2]);
			mean += weights[i] / total * x;
			hessian -= weights[i] / total * x * x.transpose();
		}
		const bool better = mean.norm() < offset;
		offset = mean.norm();
		if (offset < kManyRoundings || (step > 0 && !better && offset < kStalledBalance))
			break;
		hessian.diagonal().array() += 1e-12;
		Vector d = hessian.ldlt().solve(mean);
		if (!d.allFinite() || d.dot(mean) <= 0.0)
			d = mean;
		d *= std::min(1.0, kMaxStep / d.norm());
		double energy = 0.0;
		bool moved = false;
		for (int halving = 0; halving < 40 && !moved; ++halving) {
			boost(points, weights, d, trial, energy);
			const double slope = -d.dot(mean) * total; // of the energy along d
			moved =
				energy <= LineSearch::kDecrease * slope || std::abs(slope) < kManyRoundings * total;
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
