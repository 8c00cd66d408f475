// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/random_surface.h"

#include <ricci/base/numbers.h>
#include <ricci/base/task.h>
#include <ricci/edge_swap/swapped_flow.h>
#include <ricci/error.h>
#include <ricci/math/points.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

Component componentOf(const SurfaceMesh& mesh)
{
	std::vector<std::string> notes;
	std::vector<Component> components = splitIntoComponents(openMesh(mesh, notes));
	EXPECT_EQ(components.size(), 1u);
	return components.front();
}

/// Seven triangles round vertex 0, one of them far wider than the others: that of vertices 0, 7, 1.
SurfaceMesh fanWithAWideTriangle()
{
	SurfaceMesh fan;
	fan.positions.push_back({0, 0, 0});
	for (int i = 0; i < 7; ++i) {
		const double angle = (100 + 260 * i / 6.0) * kPi / 180;
		fan.positions.push_back({std::cos(angle), std::sin(angle), 0});
		fan.triangles.push_back({0, i + 1, (i + 1) % 7 + 1});
	}
	return fan;
}

/// Runs flowWithEdgeSwaps() with the boundary kept, and notes what it tells.
struct SwapRun : Progress
{
	Component component;
	VertexArray<double> curvature; ///< wanted at the component's inner vertices
	Options options;
	std::function<void()> atStep = [] {};

	int starts = 0, steps = 0;
	std::vector<int> splits;
	std::vector<int> startVertices; ///< [start] of the surface
	std::vector<FlowState> states;

	SwapRun(const SurfaceMesh& mesh, double everywhere) : component(componentOf(mesh))
	{
		curvature.assign(component.positions.size(), everywhere);
		options.method = Method::EdgeSwaps;
	}

	SwappedFlow operator()()
	{
		const Task task(*this);
		const auto choose = [&](const EmbeddedSurface& surface, const InitialPacking& start) {
			EXPECT_EQ(start.radii.size(), surface.positions.size());
			++starts;
			const int n = surface.triangulation.vertexCount();
			startVertices.push_back(n);
			Target target;
			target.curvature = VertexVector::Zero(n);
			for (const Vertex v : curvature.indices())
				target.curvature[v] = curvature[v];
			target.fixed = surface.topology.boundary;
			return target;
		};
		return flowWithEdgeSwaps(component, options, choose, states);
	}

	void log(const std::string& line) override
	{
		if (line.find("boundary edges split") != std::string::npos)
			splits.push_back(std::stoi(line));
		else if (line.find("Newton step") == 0) {
			++steps;
			atStep();
		}
	}
};

/// The number of steps never falls, and ends with that of the flow.
void expectCounted(const std::vector<FlowState>& states, const FlowResult& flow)
{
	EXPECT_TRUE(
		std::is_sorted(states.begin(), states.end(), [](const FlowState& a, const FlowState& b) {
			return a.step < b.step;
		}));
	EXPECT_EQ(states.back().step, flow.iterations);
}

/// The wanted curvature, by the lengths alone.
void expectCurvature(const SwappedFlow& swapped, const VertexArray<double>& wanted)
{
	const CurvatureMap& metric = *swapped.flow.metric;
	const MetricMeasure measure(metric.triangulation(), metric.lengths());
	EXPECT_EQ(measure.broken, 0);
	int checked = 0;
	for (const Vertex v : wanted.indices()) {
		if (swapped.domain.surface.topology.boundary[v])
			continue;
		++checked;
		EXPECT_NEAR(static_cast<double>(measure.curvature[v]), wanted[v], 1e-7);
	}
	EXPECT_GT(checked, 0);
}

TEST(SwappedFlow, ChangesNoEdgeWhereNothingBreaks)
{
	SwapRun run(fanWithAWideTriangle(), -1.0);
	const SwappedFlow swapped = run();
	EXPECT_EQ(run.starts, 1);
	EXPECT_TRUE(run.splits.empty());
	EXPECT_EQ(swapped.swaps, 0);
	EXPECT_EQ(swapped.splits, 0);
	EXPECT_TRUE(swapped.domain.isForeign.empty());
	expectCounted(run.states, swapped.flow);
	expectCurvature(swapped, run.curvature);
}

TEST(SwappedFlow, StartsAgainOnASplitBoundary)
{
	SwapRun run(fanWithAWideTriangle(), -3.0);
	const SwappedFlow swapped = run();
	EXPECT_EQ(run.starts, 2);
	EXPECT_EQ(run.splits, std::vector<int>{1});
	EXPECT_EQ(run.startVertices, (std::vector<int>{8, 9}));
	EXPECT_EQ(swapped.swaps, 0);
	EXPECT_EQ(swapped.splits, 1);
	expectCurvature(swapped, run.curvature);
	expectCounted(run.states, swapped.flow); // the steps of both starts in one row
	EXPECT_EQ(swapped.domain.corners.size(), 7);
	// The new vertex is the middle of the edge between vertices 7 and 1 of the mesh.
	const Triangulation& t = swapped.domain.surface.triangulation;
	ASSERT_EQ(t.vertexCount(), 9);
	const Point3 &a = run.component.positions[Vertex(7)], &b = run.component.positions[Vertex(1)];
	EXPECT_LT(
		distance(
			swapped.domain.surface.positions[Vertex(8)],
			Point3{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.0}),
		1e-15);
	ASSERT_EQ(swapped.domain.isForeign.size(), t.edgeCount());
	for (const Edge e : t.edges()) {
		const auto [i, j] = t.ends(e);
		EXPECT_EQ(swapped.domain.isForeign[e], i == Vertex(8) || j == Vertex(8));
	}
}

TEST(SwappedFlow, EndsInAMetricOrWithAReason)
{
	int swappedOnly = 0, both = 0, broken = 0;
	for (std::uint64_t seed = 1; seed <= 400; ++seed) {
		SCOPED_TRACE("seed " + std::to_string(seed));
		Random random(seed);
		SwapRun run(randomPlanarDisk(3 + random.index(3), random), 0.0);
		for (double& K : run.curvature)
			K = random.real(-7.0, 5.0);
		try {
			const SwappedFlow swapped = run();
			EXPECT_EQ(static_cast<int>(run.splits.size()), run.starts - 1);
			EXPECT_EQ(swapped.splits, run.splits.empty() ? 0 : run.splits.back());
			expectCounted(run.states, swapped.flow);
			expectCurvature(swapped, run.curvature);
			if (swapped.swaps == 0) {
				EXPECT_EQ(swapped.domain.isForeign.empty(), swapped.splits == 0);
				continue;
			}
			++(swapped.splits == 0 ? swappedOnly : both);
			// A cut may run on the component's own edges alone.
			const Triangulation& before = swapped.domain.surface.triangulation;
			const Triangulation& after = swapped.flow.metric->triangulation();
			ASSERT_EQ(swapped.domain.isForeign.size(), before.edgeCount());
			int forbidden = 0;
			for (const Edge e : before.edges()) {
				forbidden += swapped.domain.isForeign[e];
				if (swapped.domain.isForeign[e])
					continue;
				const auto [i, j] = after.ends(e);
				EXPECT_EQ(after.ends(e), before.ends(e));
				EXPECT_LT(std::max(i, j).number(), run.curvature.size());
			}
			if (swapped.splits == 0) {
				EXPECT_GT(forbidden, 0);
				EXPECT_LE(forbidden, swapped.swaps); // an edge may be swapped again
			}
		}
		catch (const NotConverged& error) {
			++broken;
			EXPECT_EQ(error.problem, NotConverged::BrokenTriangles) << error.what();
			EXPECT_GT(error.count, 0u);
			EXPECT_EQ(error.method, Method::EdgeSwaps);
			EXPECT_GE(error.swaps, 0);
		}
	}
	EXPECT_GT(swappedOnly, 20);
	EXPECT_GT(both, 20);
	EXPECT_GT(broken, 5);
}

TEST(SwappedFlow, GivesUpAfterTwentyStarts)
{
	SwapRun run(fanWithAWideTriangle(), -1e4);
	try {
		run();
		ADD_FAILURE() << "no error";
	}
	catch (const NotConverged& error) {
		EXPECT_EQ(error.problem, NotConverged::SplitsUsedUp);
		EXPECT_EQ(run.starts, 20);
		ASSERT_EQ(run.splits.size(), 20u);
		EXPECT_EQ(error.count, static_cast<std::size_t>(run.splits.back()));
		expectWords(error.what(), {"kept breaking", std::to_string(run.splits.back())});
	}
}

/// Ends the first start at step \p last with \p error.
template<class E>
SwapRun stoppedAt(int last, const E& error)
{
	SwapRun run(fanWithAWideTriangle(), -3.0);
	run.atStep = [last, error, calls = 0]() mutable {
		if (calls++ == last)
			throw error;
	};
	return run;
}

TEST(SwappedFlow, ACircleThatDoesNotSettleIsNotSplit)
{
	// The error of a circular boundary may come while a triangle on the boundary is broken. Others
	// that come then lead to a split.
	SwapRun patient(fanWithAWideTriangle(), -3.0);
	int stepsOfFirst = 0, atABrokenTriangle = 0;
	patient.atStep = [&] { stepsOfFirst += patient.starts == 1; };
	patient();
	for (int last = 0; last < stepsOfFirst; ++last) {
		SCOPED_TRACE("step " + std::to_string(last));
		SwapRun circle = stoppedAt(last, NotConverged(NotConverged::CircleUnsettled, 0, 0.25));
		try {
			circle();
			ADD_FAILURE() << "no error";
		}
		catch (const NotConverged& error) {
			EXPECT_EQ(error.problem, NotConverged::CircleUnsettled);
			EXPECT_EQ(error.value, 0.25);
		}
		EXPECT_TRUE(circle.splits.empty());
		EXPECT_EQ(circle.starts, 1);

		SwapRun other = stoppedAt(last, NotConverged(NotConverged::BrokenTriangles, 1));
		try {
			other();
		}
		catch (const NotConverged& error) {
			EXPECT_EQ(error.problem, NotConverged::BrokenTriangles);
			EXPECT_TRUE(other.splits.empty());
		}
		atABrokenTriangle += !other.splits.empty();
	}
	EXPECT_GT(atABrokenTriangle, 0);
}

TEST(SwappedFlow, CanBeCancelledAtEveryStep)
{
	SwapRun patient(fanWithAWideTriangle(), -3.0);
	patient();
	ASSERT_GT(patient.steps, 5);
	for (int last = 0; last < patient.steps; ++last) {
		SwapRun impatient = stoppedAt(last, Cancelled());
		EXPECT_THROW(impatient(), Cancelled);
		EXPECT_EQ(impatient.steps, last + 1);
	}
}

TEST(SwappedFlow, ErrorsOfTheTargetPassThrough)
{
	SwapRun run(fanWithAWideTriangle(), -1.0);
	const auto choose = [](const EmbeddedSurface&, const InitialPacking&) -> Target {
		throw InvalidOption(InvalidOption::NothingSelected);
	};
	EXPECT_THROW(flowWithEdgeSwaps(run.component, run.options, choose, run.states), InvalidOption);
}

} // namespace
} // namespace ricci::testing
