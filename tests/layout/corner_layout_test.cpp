// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/closed_flows.h"
#include "support/complex.h"
#include "support/flipped_flow.h"
#include "support/implicit_surface.h"
#include "support/listener.h"
#include "support/random.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/layout/common_refinement.h>
#include <ricci/layout/corner_layout.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <vector>

namespace ricci::testing {
namespace {

using Complex = std::complex<double>;

/// The layout on the overlay, which is another way to the same points.
PlanarLayout onOverlay(const FlippedFlow& flow, const EdgeArray<char>& isCut)
{
	return layOutRefinement(flow.domain, flow.result, flow.pieces(), isCut).corners;
}

/// Both are one figure, but for a motion without reflection.
void expectCongruent(const PlanarLayout& a, const PlanarLayout& b)
{
	ASSERT_EQ(a.points.size(), b.points.size());
	EXPECT_EQ(a.wedge, b.wedge);
	const auto at = [](const PlanarLayout& layout, int i) {
		return Complex(layout.points[i][0], layout.points[i][1]);
	};
	int far = 0;
	for (const int i : a.points.indices())
		if (std::abs(at(a, i) - at(a, 0)) > std::abs(at(a, far) - at(a, 0)))
			far = i;
	const Complex side = at(a, far) - at(a, 0), turn = (at(b, far) - at(b, 0)) / side;
	EXPECT_NEAR(std::abs(turn), 1.0, 1e-9);
	for (const int i : a.points.indices())
		EXPECT_LT(
			std::abs(at(b, 0) + turn * (at(a, i) - at(a, 0)) - at(b, i)), 1e-9 * std::abs(side));
}

void expectTheLayoutOnTheOverlay(const FlippedFlow& flow, Random& random)
{
	EXPECT_GT(flow.result.flipCount(), 0);
	const CutGraph ways[] = {flow.cut(), flow.cutAnywhere(random), flow.cutAnywhere(random)};
	for (const CutGraph& cut : ways) {
		Listener ticks;
		const PlanarLayout layout = heard(
			ticks, [&] { return layOutCorners(flow.domain, flow.result, cut.isCut).corners; });
		expectCongruent(layout, onOverlay(flow, cut.isCut));
		EXPECT_GT(ticks.calls(), 0);
	}
}

TEST(CornerLayout, IsTheLayoutOnTheOverlayOnClosedSurfaces)
{
	for (const std::uint64_t seed : {610u, 611u}) {
		Random random(seed);
		for (const FlippedFlow& flow : closedFlows(random))
			expectTheLayoutOnTheOverlay(flow, random);
	}
}

/// The flow may have run on the double: then the cut ends at the boundary, across which its triangles lie.
TEST(CornerLayout, IsTheLayoutOnTheOverlayOnSurfacesWithBoundary)
{
	Random random(612);
	int doubled = 0;
	for (const std::uint64_t seed : {1u, 2u}) {
		const SurfaceMesh annulus = implicitAnnulus(14, seed), disk = implicitDisk(14, seed);
		const SurfaceMesh sliver = sliverDisk(9, 1.5, random);
		const std::vector<FlippedFlow> flows{
			{annulus, requestOf(TargetCurvature::Flat, false)},
			{annulus, requestOf(TargetCurvature::Automatic)},
			{disk, requestOf(TargetCurvature::Disk)},
			{disk, requestOf(TargetCurvature::Rectangle)},
			{disk, requestOf(TargetCurvature::Automatic)},
			{sliver, requestOf(TargetCurvature::Disk)},
			{sliver, requestOf(TargetCurvature::Rectangle)}};
		for (const FlippedFlow& flow : flows) {
			expectTheLayoutOnTheOverlay(flow, random);
			doubled += flow.result.doubled;
		}
	}
	EXPECT_GT(doubled, 1);
}

} // namespace
} // namespace ricci::testing
