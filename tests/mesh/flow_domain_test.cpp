// SPDX-License-Identifier: GPL-3.0-or-later
// The surfaces that the flow runs on: their topology, and creases.
#include "support/expect.h"
#include "support/intrinsic.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/mesh/sides.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

namespace ricci::testing {
namespace {

TEST(Triangulation, RefusesAnEdgeOfTwoTrianglesThatDisagree)
{
	const struct
	{
		int vertexCount;
		std::vector<Triangle> triangles;
		std::size_t sides;
		std::array<int, 2> ends;
	} cases[] = {
		{4, {{0, 1, 2}, {0, 1, 3}}, 2, {0, 1}},
		{5, {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}, 3, {0, 1}},
		{5, {{0, 3, 1}, {1, 2, 4}, {3, 0, 2}, {4, 1, 2}}, 2, {1, 2}}};
	for (const auto& c : cases) {
		const auto error = refusalFor<InvalidMesh>(
			InvalidMesh::IncoherentEdge,
			{"between vertices " + std::to_string(c.ends[0]) + " and " + std::to_string(c.ends[1])},
			[&] { Triangulation(c.vertexCount, c.triangles); });
		EXPECT_EQ(error.count, c.sides);
		EXPECT_EQ(error.vertices, c.ends);
	}
}

TEST(Topology, HasANameForEveryType)
{
	const std::pair<SurfaceMesh, const char*> cases[] = {
		{perforatedSlab(0, 2), "a closed surface of genus 0 (a sphere)"},
		{torus(3, 1, 9, 7), "a closed surface of genus 1 (a torus)"},
		{perforatedSlab(2, 1), "a closed surface of genus 2"},
		{rectangle(5, 4, 5, 4), "a disk"},
		{ring(1, 2, 9, 3), "an annulus"},
		{withoutStars(torus(3, 1, 9, 9), {0}), "a surface of genus 1 with 1 boundary loop"}};
	for (const auto& [mesh, name] : cases)
		EXPECT_EQ(topologyOf(glued(mesh)).type.name(), name);
}

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

/// Two tips of curvature 2 pi less their angles, the rest at the rim.
TEST(Creases, ADoubleConeKeepsItsTipsBetweenThem)
{
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
