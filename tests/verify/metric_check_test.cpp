// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/flipped_flow.h"
#include "support/intrinsic.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/error.h>
#include <ricci/flow/curvature_map.h>
#include <ricci/metric/circle_packing.h>
#include <ricci/metric/euclidean.h>
#include <ricci/metric/hyperbolic.h>
#include <ricci/verify/metric_check.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

/// A metric near that of a mesh, in one of the backgrounds, with what the flow makes of it.
template<class Geometry>
struct Example
{
	GeometricCurvatureMap<Geometry> map;
	VertexVector u;
	Background background;

	Example(const SurfaceMesh& mesh, Background b, double scale, double spread, Random& random) :
			map(Packed(mesh).packing), u(Packed(mesh).u()), background(b)
	{
		for (double& x : u)
			x += std::log(scale) + random.real(-spread, spread);
		map.evaluate(u);
	}

	MetricCheck check(const EdgeArray<double>& lengths, const VertexVector& target) const
	{
		return checkMetric(background, map, u, lengths, target);
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
		const VertexVector& K = example.map.curvature();
		const MetricCheck good = example.check(example.map.lengths(), K);
		EXPECT_EQ(good.lengthError, 0.0);
		EXPECT_LT(good.curvatureError, 1e-14); // the flow's own sums
		EXPECT_EQ(good.broken, 0);

		// A target that is missed by a known amount.
		VertexVector target = K;
		target[Vertex(3)] += 1e-6;
		MetricCheck bad = example.check(example.map.lengths(), target);
		EXPECT_NEAR(bad.curvatureError, 1e-6, 1e-11);
		EXPECT_EQ(bad.vertex, Vertex(3));
		target[Vertex(3)] = std::numeric_limits<double>::quiet_NaN(); // nothing prescribed
		EXPECT_LT(example.check(example.map.lengths(), target).curvatureError, 1e-14);

		// A length that is not that of its circles.
		EdgeArray<double> lengths = example.map.lengths();
		lengths[Edge(5)] *= 1.0 + 1e-6;
		bad = example.check(lengths, K);
		EXPECT_NEAR(bad.lengthError, 1e-6, 1e-11);
		EXPECT_GT(bad.curvatureError, 1e-8);
		lengths[Edge(5)] = lengths[Edge(6)] = 0.0;
		EXPECT_GT(example.check(lengths, K).broken, 0);
		lengths[Edge(5)] = std::numeric_limits<double>::quiet_NaN();
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
	const EdgeArray<double> lengths(6, 2.0), delta(6, 0.0); // touching circles of radius 1
	const GeometricCurvatureMap<Euclidean> map({Triangulation(4, mesh.triangles), delta});
	const VertexVector u = VertexVector::Zero(4);
	const auto error = [&](double K) {
		return checkMetric(
				   Background::EuclideanPlane, map, u, lengths, VertexVector::Constant(4, K))
			.curvatureError;
	};
	EXPECT_EQ(error(kPi), 0.0);
	EXPECT_NEAR(error(kPi - 0.25), 0.25, 1e-12); // less what rounding explains
}

TEST(MetricCheck, OpenCurvatureIsTheSumOfWhatTheFreeVerticesMiss)
{
	FlowResult flow;
	flow.curvature = VertexVector::LinSpaced(4, 1.0, 4.0);
	flow.target.curvature = VertexVector::Zero(4);
	flow.target.curvature << 1.5, 1.75, 3.0, -100.0;
	flow.target.fixed = {0, 0, 0, 1};
	EXPECT_EQ(openCurvature(flow), 0.5 + 0.25);
}

TEST(MetricCheck, RequiresTheTargetThatTheFlowSaysItHasReached)
{
	Random random(630);
	const SurfaceMesh mesh = bumpyTorus(10, 8, random);
	std::vector<double> cones(mesh.positions.size(), 0.0);
	cones[3] = 1.0;
	cones[40] = -1.0;
	FlippedFlow flow(mesh, prescribed(cones));
	const VertexArray<char> closed(mesh.positions.size(), 0);
	EXPECT_NO_THROW(requireMetric(flow.result, closed));
	flow.result.target.curvature[Vertex(3)] += 1e-6;
	const auto error = refusalOf<NotConverged>([&] { requireMetric(flow.result, closed); });
	EXPECT_EQ(error.problem, NotConverged::CheckFailed);
	expectWords(error.finding, {"curvature 1e-06 off at one vertex"});
	expectWords(error.what(), {error.finding});
	flow.result.target.fixed[Vertex(3)] = 1; // nothing is prescribed there
	EXPECT_NO_THROW(requireMetric(flow.result, closed));
}

} // namespace
} // namespace ricci::testing
