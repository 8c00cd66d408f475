// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/flow/curvature_map.h>
#include <ricci/metric/circle_packing.h>
#include <ricci/metric/euclidean.h>
#include <ricci/metric/hyperbolic.h>
#include <ricci/verify/metric_check.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

/// A metric near that of a mesh, in one of the backgrounds, with what the flow makes of it.
template<class Geometry>
struct Example
{
	GeometricCurvatureMap<Geometry> map;
	Eigen::VectorXd u;
	Background background;

	Example(const SurfaceMesh& mesh, Background b, double scale, double spread, Random& random) :
			map(packed(mesh)), background(b)
	{
		u.resize(map.triangulation().vertexCount());
		for (Eigen::Index v = 0; v < u.size(); ++v)
			u[v] = map.packing().u[static_cast<std::size_t>(v)] + std::log(scale) +
				   random.real(-spread, spread);
		map.evaluate(u);
	}

	static CirclePacking packed(const SurfaceMesh& mesh)
	{
		Triangulation t(static_cast<int>(mesh.positions.size()), mesh.triangles);
		const std::vector<double> lengths = edgeLengths(t, mesh.positions);
		const std::vector<double> radii = initialRadii(t, lengths);
		return inversiveDistancePacking(std::move(t), lengths, radii);
	}

	MetricCheck check(const std::vector<double>& lengths, const Eigen::VectorXd& target) const
	{
		return checkMetric(background, map.triangulation(), map.delta(), u, lengths, target);
	}
};

template<class Geometry>
void agreesAndDetects(Background background, double scale)
{
	Random random(600);
	for (const SurfaceMesh& mesh :
		 {bumpyTorus(9, 7, random), randomPlanarDisk(6, random), perforatedSlab(2, 1)}) {
		const Example<Geometry> example(mesh, background, scale, 1e-3, random);
		ASSERT_EQ(example.map.brokenTriangles(), 0);
		const Eigen::VectorXd& K = example.map.curvature();
		const MetricCheck good = example.check(example.map.lengths(), K);
		EXPECT_EQ(good.lengthError, 0.0);
		EXPECT_LT(good.curvatureError, 1e-14); // the flow's own sums
		EXPECT_EQ(good.broken, 0);

		// A target that is missed by a known amount.
		Eigen::VectorXd target = K;
		target[3] += 1e-6;
		MetricCheck bad = example.check(example.map.lengths(), target);
		EXPECT_NEAR(bad.curvatureError, 1e-6, 1e-11);
		EXPECT_EQ(bad.vertex, 3);
		target[3] = std::numeric_limits<double>::quiet_NaN(); // nothing prescribed
		EXPECT_LT(example.check(example.map.lengths(), target).curvatureError, 1e-14);

		// A length that is not that of its circles.
		std::vector<double> lengths = example.map.lengths();
		lengths[5] *= 1.0 + 1e-6;
		bad = example.check(lengths, K);
		EXPECT_NEAR(bad.lengthError, 1e-6, 1e-11);
		EXPECT_GT(bad.curvatureError, 1e-8);
		lengths[5] = lengths[6] = 0.0;
		EXPECT_GT(example.check(lengths, K).broken, 0);
		lengths[5] = std::numeric_limits<double>::quiet_NaN();
		EXPECT_TRUE(std::isinf(example.check(lengths, K).lengthError));
	}
}

TEST(MetricCheck, AgreesWithTheEuclideanFlowAndSeesWhatIsWrong)
{
	for (double scale : {1.0, 1e-6, 1e20})
		agreesAndDetects<Euclidean>(Background::EuclideanPlane, scale);
}

TEST(MetricCheck, AgreesWithTheHyperbolicFlowAndSeesWhatIsWrong)
{
	for (double scale : {0.1, 1e-3})
		agreesAndDetects<Hyperbolic>(Background::HyperbolicPlane, scale);
}

TEST(MetricCheck, KnowsTheRegularTetrahedron)
{
	const SurfaceMesh mesh = tetrahedron();
	const Triangulation t(4, mesh.triangles);
	const std::vector<double> lengths(6, 2.0), delta(6, 0.0); // touching circles of radius 1
	const Eigen::VectorXd u = Eigen::VectorXd::Zero(4);
	const double pi = 3.14159265358979323846;
	const auto error = [&](double K) {
		return checkMetric(
				   Background::EuclideanPlane,
				   t,
				   delta,
				   u,
				   lengths,
				   Eigen::VectorXd::Constant(4, K))
			.curvatureError;
	};
	EXPECT_EQ(error(pi), 0.0);
	EXPECT_NEAR(error(pi - 0.25), 0.25, 1e-12); // less what rounding explains
}

} // namespace
} // namespace ricci::testing
