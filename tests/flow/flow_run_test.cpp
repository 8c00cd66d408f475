// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flipped_flow.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/flow/flow_run.h>
#include <ricci/surface/flow_domain.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ricci::testing {
namespace {

/// A surface with boundary and a target on it.
struct Problem
{
	FlippedFlow flow; // for its surface and its admissible target
	FlowOptions options;

	Problem(const SurfaceMesh& mesh, const TargetRequest& request) : flow(mesh, request) {}
};

std::vector<Problem> problems()
{
	Random random(940);
	std::vector<Problem> all;
	all.emplace_back(
		shaken(rectangle(6, 5, 1, 1), 0.05, random), requestOf(TargetCurvature::Automatic, true));
	all.emplace_back(
		withoutStars(shaken(perforatedSlab(1, 3), 0.03, random), {0, 70}),
		requestOf(TargetCurvature::Automatic, false));
	return all;
}

/// Gauss-Bonnet on the double, which is closed: twice 2 pi chi of the surface.
TEST(TargetOnDouble, IsSymmetricAndHasTwiceTheCurvature)
{
	for (const Problem& p : problems()) {
		const DoubleSurface d = doubleOf(p.flow.base());
		const Target target = targetOnDouble(p.flow.result.target, d.mirror);
		const Topology& topology = p.flow.surface().topology;
		EXPECT_EQ(d.triangulation.eulerCharacteristic(), 2 * topology.type.eulerCharacteristic());
		for (const Vertex v : d.mirror.indices()) {
			EXPECT_EQ(target.curvature[d.mirror[v]], target.curvature[v]);
			EXPECT_EQ(target.fixed[d.mirror[v]], target.fixed[v]);
		}
		if (!target.hasFixed()) {
			EXPECT_NEAR(
				target.curvature.sum(), 4 * kPi * topology.type.eulerCharacteristic(), 1e-11);
		}
	}
}

/// A run on the surface and one on its double, which goes on from there, find one metric.
TEST(FlowRun, GoesOnFromTheHalfOnTheDouble)
{
	for (const Problem& p : problems()) {
		std::vector<FlowState> states;
		FlowProgress progress(p.options.epsilon, states);
		const EmbeddedSurface& surface = p.flow.surface();
		const Target& target = p.flow.result.target;
		FlowRun half(surface, initialPacking(surface, p.options), target, p.options, progress);
		ASSERT_TRUE(half.solve());
		FlowRun whole = FlowRun::onDouble(surface, target, p.options, progress);
		whole.goOnFrom(half, true);
		ASSERT_TRUE(whole.solve());
		const int steps = half.result().iterations;
		const FlowResult result = whole.result();
		EXPECT_TRUE(result.doubled);
		EXPECT_GE(result.iterations, steps);
		EXPECT_EQ(
			result.input.eulerCharacteristic(), 2 * surface.topology.type.eulerCharacteristic());
		const VertexArray<Vertex> mirror = doubleOf(surface.triangulation).mirror;
		for (const Vertex v : mirror.indices())
			EXPECT_EQ(result.start.radii[mirror[v]], result.start.radii[v]);
		EXPECT_LT(result.residual, 1e-8);
		for (const Vertex v : result.curvature.indices())
			if (!target.fixed[v]) {
				EXPECT_NEAR(result.curvature[v], target.curvature[v], 1e-8);
			}
	}
}

TEST(FlowRun, TellsWhyItStoppedEarly)
{
	Random random(210);
	const FlippedFlow flow(bumpyTorus(12, 8, random), requestOf(TargetCurvature::Flat));
	for (const Background background : {Background::EuclideanPlane, Background::HyperbolicPlane}) {
		FlowOptions options;
		options.epsilon = 1e-9;
		Target target = flow.result.target;
		target.background = background;
		if (background == Background::HyperbolicPlane)
			target.curvature[Vertex(0)] = 1.0;
		std::vector<FlowState> states;
		FlowProgress progress(options.epsilon, states);
		FlowRun run(
			flow.surface(), initialPacking(flow.surface(), options), target, options, progress);
		run.limitSteps(1);
		ASSERT_FALSE(run.solve());
		const NotConverged error = run.failure();
		EXPECT_EQ(error.problem, NotConverged::StepsUsedUp);
		EXPECT_EQ(error.iterations, 1);
		EXPECT_EQ(error.epsilon, options.epsilon);
		EXPECT_GT(error.residual, options.epsilon);
		EXPECT_GT(error.floor, 0.0);
		EXPECT_LT(error.floor, options.epsilon);
		EXPECT_NE(std::string(error.what()).find("after 1 Newton steps"), std::string::npos);
	}
}

} // namespace
} // namespace ricci::testing
