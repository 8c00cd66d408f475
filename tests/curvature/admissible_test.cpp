// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/intrinsic.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/curvature/admissible.h>
#include <ricci/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

TEST(Admissible, ZeroTargetIsFlatAndFixesNothing)
{
	const Topology topology = topologyOf(glued(ring(1, 2, 8, 3)));
	const Target target = zeroTarget(topology);
	EXPECT_EQ(target.curvature, VertexVector::Zero(topology.boundary.size()));
	EXPECT_FALSE(target.hasFixed());
	EXPECT_NO_THROW(checkVertexBounds(topology, target));
	EXPECT_NO_THROW(checkFreeBoundary(topology, target));
}

TEST(Admissible, SelectedVerticesComeInOrder)
{
	EXPECT_EQ(
		selectedCones({0, 1, 0, 1, 1}), (std::vector<Vertex>{Vertex(1), Vertex(3), Vertex(4)}));
	EXPECT_TRUE(selectedVertices({0, 0, 0}).empty());
	const auto error = errorOf<InvalidOption>([] { selectedCones({0, 0, 0}); });
	ASSERT_TRUE(error);
	EXPECT_EQ(error->problem, InvalidOption::NothingSelected);
}

TEST(Admissible, PrescribedValuesOfTheSizeOfRoundingAreZero)
{
	const Topology topology = topologyOf(glued(tetrahedron()));
	Target target = zeroTarget(topology);
	const double precision = std::numeric_limits<float>::epsilon();
	const double small = kPrescribedRounding * precision;
	setPrescribed({{}, {1.0, small, -2 * precision, -1e-6}, precision}, target);
	EXPECT_EQ(target.curvature[Vertex(0)], 1.0);
	EXPECT_EQ(target.curvature[Vertex(1)], 0.0);
	EXPECT_EQ(target.curvature[Vertex(2)], 0.0);
	EXPECT_EQ(target.curvature[Vertex(3)], -1e-6);
	setPrescribed({{}, {1e-300, 0.0, 0.0, 0.0}, 0.0}, target);
	EXPECT_EQ(target.curvature[Vertex(0)], 1e-300);
}

/// The angles at a vertex are positive: less than 2 pi is left inside, less than pi on the boundary.
TEST(Admissible, VertexBoundsAreThoseOfPositiveAngles)
{
	const Topology topology = topologyOf(glued(rectangle(3, 3, 1, 1)));
	for (const Vertex v : topology.boundary.indices()) {
		const double bound = topology.boundary[v] ? kPi : 2 * kPi;
		Target target = zeroTarget(topology);
		target.curvature[v] = bound * (1 - 1e-15);
		EXPECT_NO_THROW(checkVertexBounds(topology, target));
		target.curvature[v] = bound;
		const auto error =
			errorOf<InadmissibleCurvature>([&] { checkVertexBounds(topology, target); });
		ASSERT_TRUE(error);
		EXPECT_EQ(
			error->problem,
			topology.boundary[v] ? InadmissibleCurvature::TooLargeOnBoundary
								 : InadmissibleCurvature::TooLargeInside);
		target.fixed[v] = 1;
		EXPECT_NO_THROW(checkVertexBounds(topology, target));
	}
}

/// A disk of n boundary vertices whose inside adds up to K leaves 2 pi - K for them, of which each
/// takes less than pi: K = 2 pi - pi n is the first that is too little.
TEST(Admissible, AFreeBoundaryTakesLessThanPiAtEachVertex)
{
	for (const SurfaceMesh& mesh : {rectangle(3, 3, 1, 1), ring(1, 2, 8, 3)}) {
		const Topology topology = topologyOf(glued(mesh));
		const auto count = std::count(topology.boundary.begin(), topology.boundary.end(), 1);
		Target target = zeroTarget(topology);
		target.fixed = topology.boundary;
		const auto inside = std::find(topology.boundary.begin(), topology.boundary.end(), 0) -
							topology.boundary.begin();
		const double bound =
			2 * kPi * topology.type.eulerCharacteristic() - kPi * static_cast<double>(count);
		double& K = target.curvature[Vertex(static_cast<int>(inside))];
		K = bound + 1e-9;
		EXPECT_NO_THROW(checkFreeBoundary(topology, target));
		K = bound - 1e-9;
		const auto error =
			errorOf<InadmissibleCurvature>([&] { checkFreeBoundary(topology, target); });
		ASSERT_TRUE(error);
		EXPECT_EQ(error->problem, InadmissibleCurvature::FreeBoundary);
		EXPECT_EQ(error->count, static_cast<std::size_t>(count));
		EXPECT_NEAR(error->bound, bound, 1e-12);
	}
}

} // namespace
} // namespace ricci::testing
