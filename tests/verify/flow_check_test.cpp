// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flipped_flow.h"
#include "support/random_surface.h"

#include <ricci/error.h>
#include <ricci/verify/flow_check.h>

#include <gtest/gtest.h>

namespace ricci::testing {
namespace {

TEST(FlowCheck, OpenCurvatureIsTheSumOfWhatTheFreeVerticesMiss)
{
	FlowResult flow;
	flow.curvature = Eigen::VectorXd::LinSpaced(4, 1.0, 4.0);
	flow.target.curvature = Eigen::VectorXd::Zero(4);
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
	const std::vector<char> closed(mesh.positions.size(), 0);
	EXPECT_NO_THROW(requireMetric(Background::EuclideanPlane, flow.result, closed));
	flow.result.target.curvature[3] += 1e-6;
	EXPECT_THROW(requireMetric(Background::EuclideanPlane, flow.result, closed), NotConverged);
	flow.result.target.fixed[3] = 1; // nothing is prescribed there
	EXPECT_NO_THROW(requireMetric(Background::EuclideanPlane, flow.result, closed));
}

} // namespace
} // namespace ricci::testing
