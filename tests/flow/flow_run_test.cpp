// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flipped_flow.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/flow/flow_run.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

/// A surface with boundary and a target on it.
struct Problem
{
	FlippedFlow flow; // for its surface and its admissible target
	FlowOptions options;

	Problem(const SurfaceMesh& mesh, const TargetRequest& request) : flow(mesh, request) {}

	FlowProblem onDouble() const
	{
		return flowProblemOnDouble(flow.surface(), flow.result.target, options);
	}
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
TEST(FlowProblem, TheDoubleIsSymmetricAndHasTwiceTheCurvature)
{
	for (const Problem& p : problems()) {
		const FlowProblem d = p.onDouble();
		const Topology& topology = p.flow.surface().topology;
		ASSERT_TRUE(d.isDoubled());
		EXPECT_EQ(d.input.eulerCharacteristic(), 2 * topology.type.eulerCharacteristic());
		EXPECT_TRUE(d.input.boundaryLoops().empty());
		EXPECT_EQ(d.vertexCount, topology.boundary.size());
		int onAxis = 0;
		for (const Vertex v : d.mirror.indices()) {
			EXPECT_EQ(d.mirror[d.mirror[v]], v);
			EXPECT_EQ(d.target.curvature[d.mirror[v]], d.target.curvature[v]);
			EXPECT_EQ(d.target.fixed[d.mirror[v]], d.target.fixed[v]);
			EXPECT_EQ(d.start.radii[d.mirror[v]], d.start.radii[v]);
			onAxis += d.mirror[v] == v;
			if (v.number() < d.vertexCount) {
				EXPECT_EQ(d.mirror[v] == v, topology.boundary[v] == 1);
			}
		}
		EXPECT_EQ(d.mirror.size() + onAxis, 2 * d.vertexCount);
		if (!d.target.hasFixed()) {
			EXPECT_NEAR(
				d.target.curvature.sum(), 4 * kPi * topology.type.eulerCharacteristic(), 1e-11);
		}
	}
}

/// A run on the surface and one on its double, which goes on from there, find one metric.
TEST(FlowRun, GoesOnFromTheHalfOnTheDouble)
{
	for (const Problem& p : problems()) {
		const FlowListener silent = [](int, double) {};
		FlowRun half(
			Background::EuclideanPlane,
			flowProblem(
				p.flow.surface(), initialPacking(p.flow.surface(), p.options), p.flow.result.target),
			p.options,
			0,
			silent);
		ASSERT_TRUE(half.solve());
		FlowRun whole(
			Background::EuclideanPlane, p.onDouble(), p.options, half.iterations(), silent);
		whole.startFrom(half.factor(), half.arcs());
		ASSERT_TRUE(whole.solve());
		EXPECT_GE(whole.iterations(), half.iterations());
		const FlowResult result = whole.result();
		EXPECT_TRUE(result.doubled);
		EXPECT_LT(result.residual, 1e-8);
		const Target& target = p.flow.result.target;
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
		if (background == Background::HyperbolicPlane)
			target.curvature[Vertex(0)] = 1.0;
		FlowProblem problem =
			flowProblem(flow.surface(), initialPacking(flow.surface(), options), target);
		problem.maxSteps = 1;
		const FlowListener silent = [](int, double) {};
		FlowRun run(background, std::move(problem), options, 0, silent, {});
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
