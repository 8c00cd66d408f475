// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flipped_flow.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/math/disk_isometry.h>
#include <ricci/measure/fuchsian_group.h>
#include <ricci/verify/holonomy_check.h>

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

/// A hyperbolic surface laid out in the disk, with its group.
struct LaidOut
{
	FlippedFlow flow;
	PlanarLayout layout;
	FuchsianGroup group;

	LaidOut(const SurfaceMesh& mesh, const HyperbolicRequest& request) : flow(mesh, request)
	{
		const CutGraph cut = flow.cut();
		CommonRefinement refinement = flow.refinement(cut);
		group = fuchsianGroup(flow.base(), cut, refinement.pairing, flow.cones());
		layout = std::move(refinement.inputLayout);
	}

	double error() const
	{
		return boundaryHolonomyError(
			group, flow.base(), flow.surface().topology, layout, flow.result.target);
	}
};

/// Of genus 1 with two geodesic boundary loops.
SurfaceMesh pierced(Random& random)
{
	return withoutStars(shaken(perforatedSlab(1, 3), 0.03, random), {0, 70});
}

TEST(HolonomyCheck, AGeodesicBoundaryIsAsLongAsItsGeneratorMovesItsAxis)
{
	Random random(790);
	LaidOut surface(pierced(random), hyperbolicMetric());
	ASSERT_EQ(surface.group.peripheral.size(), 2u);
	EXPECT_LT(surface.error(), 1e-9);
	for (std::size_t i = 0; i < 2; ++i) {
		// Another isometry, which moves its axis by a known amount more.
		const DiskIsometry right = surface.group.peripheral[i];
		const double length = 2 * std::acosh(0.5 * std::abs(right.trace()));
		EXPECT_GT(length, 0.1);
		surface.group.peripheral[i] = DiskIsometry::translation(length + 0.01);
		EXPECT_NEAR(surface.error(), 0.01, 1e-9);
		// A rotation moves no point along an axis.
		surface.group.peripheral[i] = DiskIsometry::rotation(1.0);
		EXPECT_NEAR(surface.error(), length, 1e-9);
		surface.group.peripheral[i] = right;
	}
}

TEST(HolonomyCheck, BoundariesThatAreNotGeodesicAreLeftOut)
{
	Random random(791);
	// Free, with curvature at one vertex of each loop, or of cones that are no boundary.
	const SurfaceMesh mesh = pierced(random);
	const Topology topology =
		topologyOf(Triangulation(static_cast<int>(mesh.positions.size()), mesh.triangles));
	std::vector<double> curvature(mesh.positions.size(), 0.0);
	for (const std::vector<Vertex>& loop : topology.loops)
		curvature[at(loop.front())] = 0.3;
	const SurfaceMesh closed = shaken(perforatedSlab(1, 3), 0.03, random);
	std::vector<double> cone(closed.positions.size(), 0.0);
	cone[20] = 1.0;
	for (LaidOut surface :
		 {LaidOut(mesh, hyperbolicMetric(true)),
		  LaidOut(mesh, hyperbolicPrescribed(curvature)),
		  LaidOut(closed, hyperbolicPrescribed(cone))}) {
		EXPECT_GE(surface.group.peripheral.size(), 1u);
		for (DiskIsometry& generator : surface.group.peripheral)
			generator = DiskIsometry::translation(50.0);
		EXPECT_EQ(surface.error(), 0.0);
	}
}

} // namespace
} // namespace ricci::testing
