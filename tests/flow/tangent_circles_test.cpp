// SPDX-License-Identifier: GPL-3.0-or-later
#include "../support/intrinsic.h"
#include "../support/random_surface.h"

#include <ricci/flow/curvature_map.h>
#include <ricci/flow/newton.h>
#include <ricci/metric/euclidean.h>

#include <gtest/gtest.h>

#include <cmath>

namespace ricci::testing {
namespace {

/// Circles that touch, I = 1 exactly: such edges cannot flip, and never have to.
TEST(Newton, TangentCirclesNeverFlip)
{
	Random random(609);
	for (int round = 0; round < 6; ++round) {
		SCOPED_TRACE(round);
		const Triangulation torus = glued(bumpyTorus(12, 9, random));
		CirclePacking packing{torus, {}};
		for (int e = 0; e < torus.edgeCount(); ++e)
			packing.delta.push_back(random.index(3) == 0 ? 0.0 : random.real(0.0, 2.0));
		VertexVector u(torus.vertexCount());
		for (double& x : u)
			x = random.real(-1.0, 1.0);
		FlippingCurvatureMap<Euclidean> map(packing);
		NewtonSolver newton(map, VertexArray<char>(torus.vertexCount(), 0));
		NewtonOptions options;
		options.epsilon = 1e-10;
		const NewtonResult result = newton.solve(
			u, VertexVector(Eigen::VectorXd::Zero(u.size())), options, [](int, double) {});
		EXPECT_TRUE(result.converged);
		EXPECT_TRUE(u.allFinite());
		EXPECT_EQ(map.brokenTriangles(), 0);
		for (double delta : map.delta())
			EXPECT_TRUE(std::isfinite(delta) && delta >= 0.0);
		const MetricMeasure measure(map.triangulation(), map.lengths());
		for (long double k : measure.curvature)
			EXPECT_LT(std::abs(k), 1e-9L);
	}
}

} // namespace
} // namespace ricci::testing
