// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/flipped_flow.h"
#include "support/random_surface.h"

#include <ricci/error.h>
#include <ricci/verify/flow_check.h>

#include <gtest/gtest.h>

#include <vector>

namespace ricci::testing {
namespace {

TEST(FlowCheck, OpenCurvatureIsTheSumOfWhatTheFreeVerticesMiss)
{
	FlowResult flow;
	flow.curvature = VertexVector::LinSpaced(4, 1.0, 4.0);
	flow.target.curvature = VertexVector::Zero(4);
	flow.target.curvature << 1.5, 1.75, 3.0, -100.0;
	flow.target.fixed = {0, 0, 0, 1};
	EXPECT_EQ(openCurvature(flow), 0.5 + 0.25);
}

TEST(FlowCheck, RequiresTheTargetThatTheFlowSaysItHasReached)
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

TEST(FlowCheck, FailsWithWhatWasFound)
{
	const auto error = refusalOf<NotConverged>([] { failCheck("2 points lie outside the disk"); });
	EXPECT_EQ(error.problem, NotConverged::CheckFailed);
	EXPECT_EQ(error.finding, "2 points lie outside the disk");
}

} // namespace
} // namespace ricci::testing
