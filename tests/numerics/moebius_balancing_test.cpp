// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/complex.h"
#include "support/random.h"

#include <ricci/numerics/moebius_balancing.h>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>

namespace ricci::testing {
namespace {

std::vector<Point3> randomPoints(int n, Random& random)
{
	std::vector<Point3> points;
	while (static_cast<int>(points.size()) < n) {
		const Eigen::Vector3d x(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
		if (x.norm() < 1.0 && x.norm() > 0.1)
			points.push_back({x[0] / x.norm(), x[1] / x.norm(), x[2] / x.norm()});
	}
	return points;
}

/// Of four points from \p i on.
Complex crossRatioAt(const std::vector<Point3>& p, std::size_t i)
{
	return crossRatio(p[i], p[i + 1], p[i + 2], p[i + 3]);
}

Eigen::Vector3d mean(const std::vector<Point3>& points, const std::vector<double>& weights)
{
	Eigen::Vector3d sum = Eigen::Vector3d::Zero();
	double total = 0.0;
	for (std::size_t i = 0; i < points.size(); ++i) {
		sum += weights[i] * Eigen::Vector3d(points[i][0], points[i][1], points[i][2]);
		total += weights[i];
	}
	return sum / total;
}

TEST(MoebiusBalancing, BalancesByAMoebiusTransformation)
{
	Random random(411);
	for (int trial = 0; trial < 20; ++trial) {
		std::vector<Point3> points = randomPoints(60, random);
		std::vector<double> weights;
		for (std::size_t i = 0; i < points.size(); ++i)
			weights.push_back(random.real(0.0, 1.0));
		// A strong squeeze towards one point.
		const double scale = std::exp(random.real(-6, 6));
		const Complex shift(random.real(-2, 2), random.real(-2, 2));
		for (Point3& p : points)
			p = onSphere(scale * inPlane(p) + shift);
		const std::vector<Point3> before = points;
		const double offset = balanceByMoebius(points, weights);
		EXPECT_LT(offset, 1e-12);
		EXPECT_LT(mean(points, weights).norm(), 1e-12);
		for (const Point3& p : points)
			EXPECT_NEAR(std::hypot(p[0], p[1], p[2]), 1.0, 1e-14);
		for (std::size_t i = 0; i + 3 < points.size(); ++i) {
			const Complex was = crossRatioAt(before, i);
			EXPECT_LT(std::abs(crossRatioAt(points, i) - was), 1e-6 * (1.0 + std::abs(was)));
		}
	}
}

TEST(MoebiusBalancing, BalancesTwoClustersAcrossEachOther)
{
	// The Hessian is nearly singular along the line between the clusters.
	Random random(413);
	for (double width : {0.1, 0.01, 0.001}) {
		std::vector<Point3> points;
		std::vector<double> weights;
		for (int i = 0; i < 40; ++i) {
			const Complex z = width * Complex(random.real(-1, 1), random.real(-1, 1));
			points.push_back(onSphere(i % 2 == 0 ? z : 1.0 / z));
			weights.push_back(random.real(0.9, 1.1));
		}
		EXPECT_LT(balanceByMoebius(points, weights), 1e-12);
		EXPECT_LT(mean(points, weights).norm(), 1e-12);
	}
}

TEST(MoebiusBalancing, EndsWhereNoTransformationBalances)
{
	// Half of the weight in one point: the transformation does not exist.
	std::vector<Point3> points{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
	balanceByMoebius(points, {3.0, 1.0, 1.0});
	for (const Point3& p : points)
		EXPECT_NEAR(std::hypot(p[0], p[1], p[2]), 1.0, 1e-12);
}

} // namespace
} // namespace ricci::testing
