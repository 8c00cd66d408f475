// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas at their limits. report_numbers_test.cpp has the numbers of whole maps.
#include "support/complex.h"
#include "support/flat_meshes.h"
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/measure/distortion.h>

#include <Eigen/SVD>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace ricci::testing {
namespace {

using Plane = Triangle2;
using Space = std::array<Point3, 3>;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Where the triangle lies in space, how large it is and how it is turned does not matter, nor which corner comes
/// first.
TEST(Distortion, OfLinearMapsIsTheQuotientOfTheirSingularValues)
{
	Random random(110);
	int seen = 0;
	for (int trial = 0; trial < 200; ++trial) {
		Eigen::Matrix2d A;
		for (double& x : A.reshaped())
			x = random.real(-1, 1);
		const Eigen::JacobiSVD<Eigen::Matrix2d> svd(A);
		const double expected = svd.singularValues()[0] / svd.singularValues()[1];
		Space surface;
		Plane plane;
		for (std::size_t k = 0; k < 3; ++k) {
			surface[k] = {random.real(-1, 1), random.real(-1, 1), 0.0};
			const Eigen::Vector2d q = A * Eigen::Vector2d(surface[k][0], surface[k][1]);
			plane[k] = {q[0], q[1]};
		}
		if (expected > 1e6 || triangleArea(surface) < 0.01)
			continue;
		const SurfaceMesh mesh{{surface[0], surface[1], surface[2]}, {{0, 1, 2}}};
		const std::vector<Point3> other = turned(scaled(mesh, 1e7), {1.0, -2.0, 0.5}).positions;
		for (const double found :
			 {quasiConformalDistortion(surface, plane),
			  quasiConformalDistortion({other[0], other[1], other[2]}, plane),
			  quasiConformalDistortion(
				  {surface[1], surface[2], surface[0]}, {plane[1], plane[2], plane[0]})})
			EXPECT_NEAR(found, expected, 1e-12 * expected * expected);
		++seen;
	}
	EXPECT_GT(seen, 150);
	const Space right{{{1, 1, 1}, {4, 1, 1}, {1, 5, 1}}};
	for (const double scale : {1e-8, 1e8}) // a reflection
		EXPECT_NEAR(
			quasiConformalDistortion(right, {{{0, 0}, {0, 3 * scale}, {4 * scale, 0}}}),
			1.0,
			1e-13);
	EXPECT_NEAR(triangleArea(right), 6.0, 1e-14);
}

TEST(Distortion, OfTrianglesWithoutArea)
{
	const Space good{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
	const Plane unit{{{0, 0}, {1, 0}, {0, 1}}};
	for (const Space& flat :
		 {Space{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}},
		  Space{{{1, 2, 3}, {1, 2, 3}, {0, 0, 0}}},
		  Space{{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}}}) {
		EXPECT_TRUE(std::isnan(quasiConformalDistortion(flat, unit)));
		EXPECT_EQ(triangleArea(flat), 0.0);
	}
	for (const Plane& flat :
		 {Plane{{{0, 0}, {1, 0}, {3, 0}}},
		  Plane{{{0, 0}, {0, 0}, {1, 1}}},
		  Plane{{{0, 0}, {0, 0}, {0, 0}}}})
		EXPECT_EQ(quasiConformalDistortion(good, flat), kInfinite);
	// One of them is kept out of the means.
	const SurfaceMesh mesh = rectangle(2, 1, 2, 1);
	std::vector<Plane> plane = flatMesh(mesh).corners().values();
	plane[2][1] = plane[2][0];
	const DistortionReport report = measured(mesh, plane);
	EXPECT_NEAR(report.qcMax, 1.0, 1e-14);
	EXPECT_NEAR(report.qcMean, 1.0, 1e-14);
	const FlatMesh whole = flatMesh(rectangle(4, 3, 1.0, 1.0));
	EXPECT_NEAR(stretchEnergy(whole), 4.0, 1e-13);
	for (const std::size_t corners : {2U, 3U}) { // a line, a point
		FlatMesh flat = whole;
		for (std::size_t k = 0; k < corners; ++k)
			flat.place[flat.points[5][k]] = whole.at(5)[0];
		EXPECT_EQ(stretchEnergy(flat), kInfinite);
	}
}

/// Needles that no texel shows do not count. Where they are so many that they are seen together, the lowest do not.
TEST(Distortion, OfUnseenNeedlesIsNotInTheEnergy)
{
	for (const int needles : {0, 1, 40, 400}) {
		// A unit square, and above it strips so low that their triangles are needles, the last one the lowest.
		SurfaceMesh mesh = rectangle(1, 1, 1.0, 1.0);
		std::vector<Plane> plane = flatMesh(mesh).corners().values();
		std::vector<double> areas;
		double y = 1.0, area = 1.0;
		for (int i = 0; i < needles; ++i) {
			const double low = 0x1p-16 * (1.0 - 0x1p-10 * i);
			const int n = static_cast<int>(mesh.positions.size());
			mesh.positions.insert(mesh.positions.end(), {{0, y, 0}, {1, y, 0}, {0.5, y + low, 0}});
			mesh.triangles.push_back({n, n + 1, n + 2});
			plane.push_back({{{0, y}, {1, y}, {0.5, y + 100 * low}}}); // stretched a hundredfold
			areas.push_back(0.5 * low);
			y += low;
			area += 0.5 * low;
		}
		double hidden = 0.0;
		std::size_t unseen = 0;
		while (unseen < areas.size() && hidden + areas[areas.size() - 1 - unseen] < 0x1p-14 * area)
			hidden += areas[areas.size() - 1 - unseen++];
		const FlatMesh flat = flatMesh(mesh, plane);
		const std::vector<int> found = unseenTriangles(flat);
		ASSERT_EQ(found.size(), unseen);
		for (std::size_t i = 0; i < unseen; ++i)
			EXPECT_EQ(at(found[i]), 2 + areas.size() - unseen + i);
		const double strips = area - 1.0 - hidden;
		const double forth = 2.0 + strips * (1.0 + 1e4), back = 2.0 + strips * (1.0 + 1e-4);
		EXPECT_NEAR(stretchEnergy(flat) * (1.0 + strips) / std::sqrt(forth * back), 2.0, 1e-9);
	}
}

TEST(Distortion, ThePercentileLeavesItsShareOfTheValuesBelow)
{
	std::vector<double> values(1000);
	std::iota(values.begin(), values.end(), 1.0);
	std::reverse(values.begin(), values.end());
	EXPECT_EQ(percentile(values, 0.99), 990.0);
	EXPECT_EQ(percentile(values, 1.0), 1000.0);
	EXPECT_EQ(percentile({7.0}, 0.01), 7.0);
	EXPECT_TRUE(std::isnan(percentile({}, 0.5)));
}

/// Two corners near the circle and one between their geodesic, which bends towards 0, and their
/// straight line: the two pictures have opposite orientations. The geodesic crosses the real axis before that of the
/// ends of their radii, which does at 1/cos - tan.
TEST(HyperbolicDistortion, CountsGeodesicTrianglesOfTheWrongOrientation)
{
	const double angle = 0.6, crossing = 1.0 / std::cos(angle) - std::tan(angle);
	const Complex p = std::polar(0.99, -angle), q = std::polar(0.99, angle);
	const Complex r(0.5 * (p.real() + crossing), 0.0);
	ASSERT_TRUE(r.real() < p.real() && r.real() > crossing);
	ASSERT_GT(doubledArea(asPoint(p), asPoint(q), asPoint(r)), 0.0); // straight: counter-clockwise
	const SurfaceMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
	const auto flipped = [&](Complex a, Complex b, Complex c) {
		return flippedInDisk(flatMesh(mesh, {{asPoint(a), asPoint(b), asPoint(c)}}));
	};
	EXPECT_EQ(flipped(p, q, r), 1);
	EXPECT_EQ(flipped(q, p, r), 0);
	EXPECT_EQ(flipped(p, p, r), 1); // without area it is neither
}

} // namespace
} // namespace ricci::testing
