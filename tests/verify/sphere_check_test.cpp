// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shapes.h"

#include <ricci/verify/sphere_check.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace ricci::testing {
namespace {

SurfaceMesh octahedron()
{
	SurfaceMesh mesh;
	mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
	mesh.triangles = {
		{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
	return mesh;
}

TEST(SphereCheck, AcceptsASphere)
{
	const SurfaceMesh mesh = octahedron();
	const SphereCheck check = checkSphere(mesh.triangles, mesh.positions);
	EXPECT_EQ(check.radiusError, 0.0);
	EXPECT_NEAR(check.degree, 1.0, 1e-15);
	EXPECT_EQ(check.turned, 0);
}

TEST(SphereCheck, CountsHowOftenAndWhichWayTheSphereIsCovered)
{
	SurfaceMesh mesh = octahedron();
	for (Triangle& t : mesh.triangles)
		std::swap(t[1], t[2]);
	SphereCheck check = checkSphere(mesh.triangles, mesh.positions);
	EXPECT_NEAR(check.degree, -1.0, 1e-15);
	EXPECT_EQ(check.turned, 8);
	// Half of it missing.
	mesh = octahedron();
	mesh.triangles.resize(4);
	EXPECT_NEAR(checkSphere(mesh.triangles, mesh.positions).degree, 0.5, 1e-15);
	// A vertex inside the first face, drawn across the face's side on the equator: the sphere is still
	// covered once in all, but a part of it three times.
	mesh = octahedron();
	mesh.positions.push_back({0.6, 0.75, -std::sqrt(1.0 - 0.36 - 0.5625)});
	mesh.triangles[0] = {0, 2, 6};
	mesh.triangles.push_back({2, 4, 6});
	mesh.triangles.push_back({4, 0, 6});
	check = checkSphere(mesh.triangles, mesh.positions);
	EXPECT_NEAR(check.degree, 1.0, 1e-15);
	EXPECT_EQ(check.turned, 1);
}

TEST(SphereCheck, ATriangleOnAGreatCircleIsNotTurned)
{
	for (double angle : {0.1, 0.7, 1.3}) {
		const double c = std::cos(angle), s = std::sin(angle);
		const std::vector<Point3> points = {{1, 0, 0}, {c, s, 0}, {c * c - s * s, 2 * s * c, 0}};
		EXPECT_EQ(checkSphere({{0, 1, 2}}, points).turned, 0);
		EXPECT_EQ(checkSphere({{0, 2, 1}}, points).turned, 0);
	}
}

TEST(SphereCheck, MeasuresTheRadii)
{
	SurfaceMesh mesh = octahedron();
	mesh.positions[3] = {0.0, -1.0 - 1e-6, 0.0};
	EXPECT_NEAR(checkSphere(mesh.triangles, mesh.positions).radiusError, 1e-6, 1e-15);
	mesh.positions[3][0] = std::numeric_limits<double>::quiet_NaN();
	EXPECT_FALSE(std::isfinite(checkSphere(mesh.triangles, mesh.positions).radiusError));
}

} // namespace
} // namespace ricci::testing
