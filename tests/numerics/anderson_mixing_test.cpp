// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/numerics/iteration.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <vector>

namespace ricci::testing {
namespace {

/// x <- A x + b, where A has the spectral norm \p norm at most.
struct AffineMap
{
	Eigen::MatrixXd A;
	Eigen::VectorXd b;

	AffineMap(int n, double norm, Random& random) : A(n, n), b(n)
	{
		for (int i = 0; i < n; ++i) {
			b[i] = random.real(-1, 1);
			for (int j = 0; j < n; ++j)
				A(i, j) = random.real(-1, 1);
		}
		A *= norm / A.norm();
	}
	std::vector<double> operator()(const std::vector<double>& x) const
	{
		const Eigen::VectorXd y = A * Eigen::Map<const Eigen::VectorXd>(x.data(), b.size()) + b;
		return {y.data(), y.data() + y.size()};
	}
	double error(const std::vector<double>& x) const
	{
		const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(b.size(), b.size()) - A;
		return (Eigen::Map<const Eigen::VectorXd>(x.data(), b.size()) - rest.lu().solve(b)).norm();
	}
};

TEST(AndersonMixing, EndsAfterOneStepMoreThanUnknownsOnAnyAffineMap)
{
	Random random(301);
	for (int trial = 0; trial < 50; ++trial) {
		const int n = 1 + random.index(6);
		const AffineMap map(n, random.real(0.3, 3.0), random); // the plain iteration may diverge
		AndersonMixing mixing(static_cast<std::size_t>(n));
		std::vector<double> x(static_cast<std::size_t>(n), 0.0);
		for (int step = 0; step <= n; ++step)
			x = mixing.next(x, map(x));
		EXPECT_LT(map.error(x), 1e-6 * (1.0 + map.error(std::vector<double>(x.size(), 0.0))));
		mixing.restart();
		EXPECT_EQ(mixing.next(x, map(x)), map(x));
	}
}

} // namespace
} // namespace ricci::testing
