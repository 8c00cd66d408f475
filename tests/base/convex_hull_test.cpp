// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/base/convex_hull.h>
#include <ricci/base/indexed.h>
#include <ricci/base/numbers.h>
#include <ricci/base/points.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

/// In a disk, in a thin one, on a lattice, and on a circle, where all are corners.
std::vector<Point2> randomPoints(int n, int kind, Random& random)
{
	std::vector<Point2> points;
	while (points.size() < positionOf(n)) {
		const double x = random.real(-1, 1), y = random.real(-1, 1), r = std::hypot(x, y);
		if (kind == 2)
			points.push_back({random.index(5) * 1.0, random.index(5) * 1.0});
		else if (r <= 1.0 && r > 0.0)
			points.push_back(
				kind == 3 ? Point2{x / r, y / r} : Point2{x, (kind == 1 ? 1e-6 : 1.0) * y});
	}
	return points;
}

/// The least distance of \p p from the lines of the sides, positive inside.
double depthIn(const std::vector<Point2>& polygon, const Point2& p)
{
	double least = std::numeric_limits<double>::infinity();
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		const Point2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
		least = std::min(least, doubledArea(a, b, p) / distance(a, b));
	}
	return least;
}

bool isStrictlyConvex(const std::vector<Point2>& polygon)
{
	const std::size_t n = polygon.size();
	for (std::size_t i = 0; i < n; ++i)
		if (orientation(polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n]) <= 0)
			return false;
	return true;
}

TEST(ConvexHull, HasPointsAsCornersAndNoneOutside)
{
	Random random(640);
	for (int kind = 0; kind < 4; ++kind)
		for (int n : {3, 4, 7, 30, 200}) {
			const std::vector<Point2> points = randomPoints(n, kind, random);
			const std::vector<Point2> hull = convexHull(points);
			for (const Point2& corner : hull)
				EXPECT_EQ(std::count(hull.begin(), hull.end(), corner), 1);
			for (const Point2& corner : hull)
				EXPECT_NE(std::find(points.begin(), points.end(), corner), points.end());
			if (hull.size() < 3) // three points of the lattice may lie on a line
				continue;
			EXPECT_TRUE(isStrictlyConvex(hull));
			for (std::size_t i = 0; i < hull.size(); ++i)
				for (const Point2& p : points)
					EXPECT_GE(orientation(hull[i], hull[(i + 1) % hull.size()], p), 0);
		}
}

TEST(ConvexHull, OfPointsOnALineOrAtOnePlace)
{
	EXPECT_TRUE(convexHull({}).empty());
	EXPECT_EQ(convexHull({{2, 1}, {2, 1}}), (std::vector<Point2>{{2, 1}}));
	EXPECT_EQ(convexHull({{1, 1}, {3, 3}, {2, 2}, {0, 0}}), (std::vector<Point2>{{0, 0}, {3, 3}}));
}

TEST(EnclosingPolygon, LiesRoundThePolygonAndHasFewCorners)
{
	Random random(641);
	for (int kind = 0; kind < 4; ++kind)
		for (int n : {5, 12, 100}) {
			const std::vector<Point2> hull = convexHull(randomPoints(n, kind, random));
			if (hull.size() < 3)
				continue;
			for (std::size_t maxCorners : {4u, 6u, 8u}) {
				const std::vector<Point2> outline = enclosingPolygon(hull, maxCorners);
				EXPECT_LE(outline.size(), maxCorners);
				for (const Point2& p : hull)
					EXPECT_GE(depthIn(outline, p), -1e-14);
				if (hull.size() <= maxCorners) {
					EXPECT_EQ(outline, hull);
				}
			}
		}
}

/// Four sides are prolonged past the other two, which adds two triangles as large as one of the six.
TEST(EnclosingPolygon, OfAHexagonAddsTwoTriangles)
{
	const double h = std::sqrt(0.75);
	const std::vector<Point2> hexagon{{1, 0}, {0.5, h}, {-0.5, h}, {-1, 0}, {-0.5, -h}, {0.5, -h}};
	const std::vector<Point2> four = enclosingPolygon(hexagon, 4);
	ASSERT_EQ(four.size(), 4u);
	const double area =
		doubledArea(four[0], four[1], four[2]) + doubledArea(four[0], four[2], four[3]);
	EXPECT_NEAR(0.5 * area, (6 + 2) * std::sqrt(3.0) / 4, 1e-14);
}

double area(const OrientedRectangle& r)
{
	return r.width() * r.height();
}

TEST(MinAreaRectangle, OfPointsWithoutAnArea)
{
	EXPECT_EQ(area(minAreaRectangle({{2, 3}})), 0.0);
	EXPECT_EQ(area(minAreaRectangle({{2, 3}, {2, 3}, {2, 3}})), 0.0);
	const OrientedRectangle r = minAreaRectangle({{0, 0}, {3, 4}, {1.5, 2}});
	EXPECT_NEAR(r.width(), 5.0, 1e-14);
	EXPECT_NEAR(r.height(), 0.0, 1e-14);
}

TEST(MinAreaRectangle, TakesTimeInProportionToTheCorners)
{
	// With the square of their number this would take minutes.
	constexpr int kCorners = 400000;
	std::vector<Point2> circle;
	for (int i = 0; i < kCorners; ++i)
		circle.push_back({std::cos(2 * kPi * i / kCorners), std::sin(2 * kPi * i / kCorners)});
	const OrientedRectangle r = minAreaRectangle(circle);
	EXPECT_NEAR(r.width(), 2.0, 1e-9);
	EXPECT_NEAR(r.height(), 2.0, 1e-9);
}

} // namespace
} // namespace ricci::testing
