// SPDX-License-Identifier: GPL-3.0-or-later
#include "../support/random_surface.h"
#include "../support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/surface/creases.h>

#include <gtest/gtest.h>

#include <cmath>

namespace ricci::testing {
namespace {

Creases creasesOf(const SurfaceMesh& mesh, double degrees)
{
	return creases(mesh.positions, mesh.triangles, Sides(mesh.triangles), degrees * kPi / 180.0);
}

/// The faces of a cylinder with n sides meet at 360 / n degrees along its length, and at a right angle along its
/// two rims.
TEST(Creases, OfACylinder)
{
	constexpr int kSides = 12;
	const SurfaceMesh mesh =
		revolved({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}, {0.0, 2.0}}, kSides);
	EXPECT_EQ(creasesOf(mesh, 29.0).edges, 2 * kSides + 2 * kSides);
	EXPECT_EQ(creasesOf(mesh, 31.0).edges, 2 * kSides);
	EXPECT_EQ(creasesOf(mesh, 89.0).edges, 2 * kSides);
	EXPECT_EQ(creasesOf(mesh, 91.0).edges, 0);
	const Creases rims = creasesOf(mesh, 60.0);
	int marks = 0;
	for (const auto& sides : rims.sides)
		marks += sides[0] + sides[1] + sides[2];
	EXPECT_EQ(marks, rims.edges); // one side each
	// All curvature is at the rims.
	EXPECT_NEAR(rims.curvatureBetween, 0.0, 1e-12);
	EXPECT_NEAR(creasesOf(mesh, 91.0).curvatureBetween, 1.0, 1e-12);
}

TEST(Creases, ACoarseConeKeepsItsTipBetweenThem)
{
	// A double cone: two tips of curvature 2 pi - 2 pi sin(1/2 the opening), the rest at the rim.
	constexpr int kSides = 60;
	const SurfaceMesh mesh = revolved({{0.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}}, kSides);
	const Creases rim = creasesOf(mesh, 60.0);
	EXPECT_EQ(rim.edges, kSides);
	const double side = std::sqrt(2.0), base = 2.0 * std::sin(kPi / kSides);
	const double tip = 2.0 * kPi - kSides * 2.0 * std::asin(0.5 * base / side);
	EXPECT_NEAR(rim.curvatureBetween, 2.0 * tip / (4.0 * kPi), 1e-12);
}

} // namespace
} // namespace ricci::testing
