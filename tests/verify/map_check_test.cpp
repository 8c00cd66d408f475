// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/verify/map_check.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

/// A plane mesh as its own map.
struct Sheet
{
	SurfaceMesh mesh;
	std::vector<Triangle2> plane;

	Sheet()
	{
		Random random(610);
		mesh = randomPlanarDisk(5, random);
		plane = flatMesh(mesh).corners().values();
	}

	MapCheck check(double tolerance = 1e-9) const
	{
		return checkMap(flatMesh(mesh, plane), tolerance);
	}
};

TEST(MapCheck, AcceptsAMapWithAndWithoutSeams)
{
	Sheet s;
	MapCheck check = s.check();
	EXPECT_TRUE(check.finite);
	EXPECT_EQ(check.seamGap, 0.0);
	EXPECT_EQ(check.flipped, 0);
	// Cut apart by a motion of a half: all its border becomes a seam.
	for (std::size_t f = 0; f < s.plane.size() / 2; ++f)
		for (Point2& p : s.plane[f])
			p = {3.0 - p[1], p[0]};
	check = s.check();
	EXPECT_LT(check.seamGap, 1e-15);
	EXPECT_EQ(check.flipped, 0);
}

TEST(MapCheck, SeesSeamsOfDifferentLengths)
{
	Sheet s;
	for (Point2& p : s.plane[20])
		p = {1.001 * p[0], 1.001 * p[1]};
	Box2 box;
	for (const Point3& p : s.mesh.positions)
		box.add(Point2{p[0], p[1]});
	const Triangle2& p = s.plane[20]; // all of its sides are inside
	const double longest =
		std::max({distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])});
	EXPECT_NEAR(s.check().seamGap, longest * (1 - 1 / 1.001) / box.extent(), 1e-14);
}

TEST(MapCheck, SeesFlippedAndFlatFaces)
{
	Sheet s;
	for (const std::size_t f : {7u, 8u})
		std::swap(s.mesh.triangles[f][1], s.mesh.triangles[f][2]);
	for (const std::size_t f : {7u, 8u})
		std::swap(s.plane[f][1], s.plane[f][2]);
	EXPECT_EQ(s.check().flipped, 2);
	for (const std::size_t f : {7u, 8u}) {
		std::swap(s.mesh.triangles[f][1], s.mesh.triangles[f][2]);
		std::swap(s.plane[f][1], s.plane[f][2]);
	}
	// A face flipped by less than the tolerance is left to rounding.
	auto& p = s.plane[4];
	const double x = p[1][0] - p[0][0], y = p[1][1] - p[0][1], l = std::hypot(x, y);
	p[2] = {p[0][0] + 0.5 * x + 1e-10 * y / l, p[0][1] + 0.5 * y - 1e-10 * x / l};
	EXPECT_EQ(s.check(1e-9).flipped, 0);
	EXPECT_EQ(s.check(1e-11).flipped, 1);
}

TEST(MapCheck, SeesWhatIsNoNumber)
{
	Sheet s;
	s.plane[9][2][1] = std::numeric_limits<double>::quiet_NaN();
	EXPECT_FALSE(s.check().finite);
	s.plane[9][2][1] = std::numeric_limits<double>::infinity();
	EXPECT_FALSE(s.check().finite);
}

} // namespace
} // namespace ricci::testing
