// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/complex.h"
#include "support/random.h"

#include <ricci/numerics/moebius_balancing.h>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>

namespace ricci::testing {
namespace {

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
