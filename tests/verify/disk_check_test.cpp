// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/math/disk_isometry.h>
#include <ricci/verify/disk_check.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

/// Straight triangles of the Klein model, which are the geodesic ones of the Poincaré disk at
/// k / (1 + sqrt(1 - |k|^2)).
struct Sheet
{
	SurfaceMesh mesh;
	std::vector<Triangle2> plane;

	Sheet()
	{
		Random random(620);
		mesh = randomPlanarDisk(5, random);
		double largest = 0.0;
		Point2 middle{0.0, 0.0};
		for (const Point3& p : mesh.positions)
			for (std::size_t k = 0; k < 2; ++k)
				middle[k] += p[k] / static_cast<double>(mesh.positions.size());
		for (const Point3& p : mesh.positions)
			largest = std::max(largest, std::hypot(p[0] - middle[0], p[1] - middle[1]));
		for (const Triangle& t : mesh.triangles) {
			Triangle2 corners;
			for (std::size_t k = 0; k < 3; ++k) {
				const Point3& p = mesh.positions[at(t[k])];
				const double x = 0.99 * (p[0] - middle[0]) / largest;
				const double y = 0.99 * (p[1] - middle[1]) / largest;
				const double scale = 1.0 / (1.0 + std::sqrt(1.0 - x * x - y * y));
				corners[k] = {scale * x, scale * y};
			}
			plane.push_back(corners);
		}
	}

	/// Moves the first half of the triangles.
	template<class Map>
	void moveHalf(Map map)
	{
		for (std::size_t f = 0; f < plane.size() / 2; ++f)
			for (Point2& p : plane[f])
				p = asPoint(map(asComplex(p)));
	}

	DiskCheck check(double tolerance = 1e-9) const
	{
		return checkDisk(flatMesh(mesh, plane), tolerance);
	}
};

TEST(DiskCheck, AcceptsAMapWithAndWithoutSeams)
{
	Sheet s;
	DiskCheck check = s.check();
	EXPECT_EQ(check.outside, 0u);
	EXPECT_LE(check.seamGap, 0.0);
	EXPECT_EQ(check.flipped, 0);
	// Cut apart by an isometry, all of the border between the halves becomes a seam.
	s.moveHalf(DiskIsometry::translationTo({0.3, -0.4}) * DiskIsometry::rotation(2.0));
	check = s.check();
	EXPECT_LT(check.seamGap, 1e-13);
	EXPECT_EQ(check.flipped, 0);
}

const SurfaceMesh kTwoTriangles{std::vector<Point3>(4), {{0, 1, 2}, {1, 0, 3}}};

TEST(DiskCheck, SeesASeamThatDoesNotFit)
{
	// Two triangles on one diameter: their common sides have the lengths 1 and 1.01.
	const auto on = [](double distance) { return std::tanh(0.5 * distance); };
	const Point2 origin{0.0, 0.0};
	const DiskCheck check = checkDisk(
		flatMesh(
			kTwoTriangles,
			{{{origin, {on(1.0), 0.0}, {0.0, 0.5}}}, {{{on(1.01), 0.0}, origin, {0.0, -0.5}}}}),
		1e-9);
	EXPECT_NEAR(check.seamGap, 0.01, 1e-13);
	EXPECT_NEAR(check.radius, 2.0 * std::atanh(0.5), 1e-14);
	EXPECT_EQ(check.flipped, 0);
	// A similarity of the plane is no isometry of the disk.
	Sheet s;
	s.moveHalf([](std::complex<double> z) { return 0.9 * z; });
	EXPECT_GT(s.check().seamGap, 0.01);
}

TEST(DiskCheck, AllowsForTheRoundingOfBothSidesOfASeam)
{
	// The same side twice, at 0 and where one unit in the last place is a distance of 1e-11: what the
	// sides differ by there is rounding, whichever triangle comes first.
	Random random(621);
	double largest = 0.0;
	for (int trial = 0; trial < 200; ++trial) {
		const DiskIsometry away =
			DiskIsometry::rotation(random.real(-3.0, 3.0)) * DiskIsometry::translation(12.0);
		const std::complex<double> p(random.real(-0.4, 0.4), random.real(-0.4, 0.4)),
			q(random.real(-0.4, 0.4), random.real(-0.4, 0.4));
		const std::complex<double> x = away(p), y = away(q);
		const Point2 near[] = {asPoint(p), asPoint(q)};
		const Point2 far[] = {asPoint(x), asPoint(y)};
		const Point2 apex{0.0, 0.0};
		const bool swapped = trial % 2 == 1;
		const auto& first = swapped ? far : near;
		const auto& second = swapped ? near : far;
		const DiskCheck check = checkDisk(
			flatMesh(kTwoTriangles, {{{first[0], first[1], apex}}, {{second[1], second[0], apex}}}),
			1.0);
		EXPECT_LE(check.seamGap, 0.0);
		largest = std::max(largest, std::abs(chordLength(x, y) - chordLength(p, q)));
	}
	EXPECT_GT(largest, 1e-12); // or there is nothing to allow for
}

TEST(DiskCheck, CountsFlippedTrianglesByTheirHeight)
{
	// The third corner lies at the distance 0.25 from a diameter, on the wrong side, anywhere in
	// the disk.
	const double height = 0.25, y = -std::tanh(0.5 * height);
	const SurfaceMesh triangle{std::vector<Point3>(3), {{0, 1, 2}}};
	for (double place : {0.0, 0.9, 0.999}) {
		const DiskIsometry move =
			DiskIsometry::translationTo({place, 0.0}) * DiskIsometry::rotation(0.7);
		Triangle2 p = {Point2{-0.5, 0.0}, Point2{0.5, 0.0}, Point2{0.0, y}};
		for (Point2& q : p)
			q = asPoint(move(asComplex(q)));
		EXPECT_EQ(checkDisk(flatMesh(triangle, {p}), 0.9 * height).flipped, 1) << place;
		EXPECT_EQ(checkDisk(flatMesh(triangle, {p}), 1.1 * height).flipped, 0) << place;
		std::swap(p[0], p[1]);
		EXPECT_EQ(checkDisk(flatMesh(triangle, {p}), 0.0).flipped, 0) << place;
	}
}

TEST(DiskCheck, CountsPointsThatAreNotInTheDisk)
{
	const double nan = std::numeric_limits<double>::quiet_NaN();
	for (const Point2& bad : {Point2{1.0, 0.0}, Point2{0.8, 0.8}, Point2{nan, 0.0}}) {
		Sheet s;
		s.plane[3][1] = bad;
		EXPECT_EQ(s.check().outside, 1u);
	}
}

} // namespace
} // namespace ricci::testing
