// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/wide.h"

#include <ricci/measure/distortion.h>
#include <ricci/metric/area.h>

#include <gtest/gtest.h>

namespace ricci::testing {
namespace {

using Sides = std::array<double, 3>;

const Triangulation& oneTriangle()
{
	static const Triangulation t(3, {{0, 1, 2}});
	return t;
}

/// Lengths of the edges of one triangle, from sides between corners k and k + 1.
EdgeArray<double> ofSides(const Sides& side)
{
	EdgeArray<double> lengths(3, 0.0);
	for (const Halfedge h : oneTriangle().halfedges(Face(0)))
		lengths[h.edge()] = side[at(oneTriangle().origin(h))];
	return lengths;
}

TEST(Area, OfFlatTrianglesIsThatOfTheirPlacesInSpace)
{
	Random random(70);
	for (const SurfaceMesh& mesh :
		 {tetrahedron(), bumpyTorus(12, 8, random), sliverDisk(12, 2.0, random)}) {
		const IntrinsicMesh metric = intrinsicMesh(mesh);
		double area = 0.0;
		for (const Triangle& t : mesh.triangles)
			area += triangleArea(
				{mesh.positions[at(t[0])], mesh.positions[at(t[1])], mesh.positions[at(t[2])]});
		EXPECT_NEAR(euclideanArea(metric.triangulation, metric.lengths) / area, 1.0, 1e-12);
	}
	EXPECT_EQ(euclideanArea({3.0, 4.0, 5.0}), 6.0);
	EXPECT_EQ(euclideanArea({13.0, 14.0, 15.0}), 84.0);
	// A needle: half its perimeter is not a double, and Heron's formula as it stands gives 0.
	EXPECT_NEAR(
		euclideanArea({0x1p17, 0x1p17 - 0x1p-33, 0x1p-33 + 0x1p-35}) / (3.0 * 0x1p-19), 1.0, 1e-14);
}

TEST(Area, OfOneFlatTriangleGrowsWithTheSquareOfItsSidesInAnyOrder)
{
	Random random(72);
	for (int i = 0; i < 200; ++i) {
		Sides side{random.real(0.5, 1.0), random.real(0.5, 1.0), 0.0};
		side[2] = random.real(std::abs(side[0] - side[1]), side[0] + side[1]);
		const double area = euclideanArea(side);
		EXPECT_GT(area, 0.0);
		for (const double s : {0x1p-30, 0x1p30})
			EXPECT_EQ(euclideanArea({s * side[0], s * side[1], s * side[2]}), s * s * area);
		EXPECT_EQ(euclideanArea({side[1], side[2], side[0]}), area);
		EXPECT_EQ(euclideanArea({side[2], side[1], side[0]}), area);
		EXPECT_EQ(euclideanArea(oneTriangle(), ofSides(side)), area);
	}
}

TEST(Area, OfATriangleOfCurvatureMinusOneIsPiLessItsAngles)
{
	RICCI_NEEDS_WIDE_LONG_DOUBLE();
	Random random(71);
	for (int i = 0; i < 2000; ++i) {
		std::array<WideComplex, 3> p;
		for (WideComplex& z : p) {
			const long double r = std::sqrt(static_cast<long double>(random.real(0.0, 0.99)));
			z = std::polar(r, static_cast<long double>(random.real(0.0, 6.28)));
		}
		long double area = std::acos(-1.0L);
		Sides side;
		for (std::size_t k = 0; k < 3; ++k) {
			area -= angleInDisk(p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
			side[k] = static_cast<double>(distanceInDisk(p[k], p[(k + 1) % 3]));
		}
		// Rounding of a side by a unit changes half the slack of the flattest triangle by as much,
		// and the area by the root.
		const double perimeter = side[0] + side[1] + side[2];
		const double slack = perimeter - 2 * std::max({side[0], side[1], side[2]});
		const double found = hyperbolicArea(oneTriangle(), ofSides(side));
		EXPECT_NEAR(
			found, static_cast<double>(area), 1e-15 * (1 + perimeter / slack * found) + 1e-17);
	}
	for (const double s : {1e-2, 1e-3, 1e-6, 1e-9}) // small ones are flat
		EXPECT_NEAR(hyperbolicArea({3 * s, 4 * s, 5 * s}) / (6 * s * s), 1.0, 1e-14 + 25 * s * s);
}

TEST(Area, OfADegenerateTriangleIsZero)
{
	for (const Sides& side :
		 {Sides{1, 2, 3}, {0.25, 0.5, 0.75}, {1, 1, 0}, {0, 0, 0}, {1, 1, 3}, {3, 1, 1}}) {
		EXPECT_EQ(euclideanArea(side), 0.0);
		EXPECT_EQ(hyperbolicArea(oneTriangle(), ofSides(side)), 0.0);
	}
}

TEST(TriangleApex, LiesOnTheBaseWhereTheSidesMakeNoTriangle)
{
	for (const double gap : {0.0, 0.1, 1.0}) {
		const auto [x, height] = triangleApex(3.0 + gap, 1.0, 2.0);
		EXPECT_EQ(height, 0.0);
		// Where the powers of the points of the base to both circles are equal.
		EXPECT_NEAR(x * x - 1.0, (x - 3.0 - gap) * (x - 3.0 - gap) - 4.0, 1e-14);
		EXPECT_EQ(triangleApex(1.0, 2.0, 3.0 + gap)[1], 0.0);
	}
	EXPECT_EQ(triangleApex(3.0, 1.0, 2.0)[0], 1.0); // exactly between the ends
}

} // namespace
} // namespace ricci::testing
