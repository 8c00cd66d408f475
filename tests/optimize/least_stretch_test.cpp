// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_maps.h"

#include <ricci/measure/distortion.h>
#include <ricci/optimize/least_distortion.h>
#include <ricci/optimize/patch_energy.h>
#include <ricci/optimize/patches.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ricci::testing {
namespace {

/// Part of a cylinder, mapped with sheared and uneven cells.
FlatMesh cylinder()
{
	std::vector<Point2> places;
	for (int i = 0; i <= kSide; ++i)
		for (int j = 0; j <= kSide; ++j)
			places.push_back({std::pow(i, 1.4) + 0.5 * j, 2.0 * j + 0.05 * j * j});
	const SurfaceMesh mesh = grid(kSide, kSide, Ends::Open, Ends::Open, [](int i, int j) {
		return Point3{2.0 * std::cos(0.3 * i), 2.0 * std::sin(0.3 * i), 0.7 * j};
	});
	return flatDisk(mesh, places);
}

TEST(SymmetricDirichlet, IsInfiniteWhereATriangleIsFlippedUnlessItDoesNotCount)
{
	FlatMesh flat = square();
	const Triangle t = flat.points[40];
	Patch patch; // all of it
	for (const int f : flat.points.indices())
		patch.triangles.push_back(f);
	for (const int p : flat.place.indices())
		patch.points.push_back(p);
	patch.corners = flat.points;
	patch.variable = Array<int>(patch.points);
	patch.variables = flat.place.size();
	PatchEnergy energy(
		flat,
		allPoints(flat),
		patch,
		restShapes(flat, patch, RestShapes::OfSurfaceEvenly, {}),
		PatchCost::SymmetricDirichlet);
	Eigen::VectorXd x = Eigen::VectorXd::Zero(energy.size());
	EXPECT_NEAR(energy.value(x, 0.0), 4.0, 1e-12);
	x[2 * t[0]] += 3.0;
	EXPECT_EQ(energy.value(x, 0.0), std::numeric_limits<double>::infinity());
	for (const int f : flat.points.indices())
		energy.stress(f, 0.0);
	EXPECT_EQ(energy.value(x, 0.0), 0.0);
}

/// Whatever the size of the map that it starts from.
TEST(LeastStretch, OfADevelopableSurfaceIsAnIsometry)
{
	for (const double size : {1.0, 1e-3}) {
		FlatMesh flat = cylinder();
		for (Point2& p : flat.place)
			p = size * p;
		ASSERT_EQ(notCounterClockwise(flat), 0);
		EXPECT_GT(stretchEnergy(flat), 4.5);
		scaleToSurface(flat);
		EXPECT_FALSE(leastStretch(flat, allPoints(flat)));
		EXPECT_NEAR(stretchEnergy(flat), 4.0, 1e-10);
		for (const int f : flat.points.indices())
			for (const Corner side : cornersOf(f)) {
				const auto ends = flat.ends(side);
				EXPECT_NEAR(distance(ends[0], ends[1]), flat.lengths[side], 1e-5);
			}
	}
}

} // namespace
} // namespace ricci::testing
