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

/// No side of a triangle or a parallelogram can be left out.
TEST(EnclosingPolygon, KeepsWhatCannotBeSimpler)
{
	const std::vector<Point2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}},
		triangle{{0, 0}, {1, 0}, {0, 1}};
	EXPECT_EQ(enclosingPolygon(square, 3), square);
	EXPECT_EQ(enclosingPolygon(triangle, 2), triangle);
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

/// The least area of the rectangles along the sides of a convex polygon, side by side.
double minArea(const std::vector<Point2>& hull)
{
	double least = std::numeric_limits<double>::infinity();
	for (std::size_t i = 0; i < hull.size(); ++i) {
		const Point2 &p = hull[i], &q = hull[(i + 1) % hull.size()];
		OrientedRectangle r;
		r.cosine = (q[0] - p[0]) / distance(p, q);
		r.sine = (q[1] - p[1]) / distance(p, q);
		r.min = r.max = r.inFrame(p);
		for (const Point2& other : hull)
			for (std::size_t k = 0; k < 2; ++k) {
				r.min[k] = std::min(r.min[k], r.inFrame(other)[k]);
				r.max[k] = std::max(r.max[k], r.inFrame(other)[k]);
			}
		least = std::min(least, area(r));
	}
	return least;
}

TEST(MinAreaRectangle, IsTheLeastOfAllAlongSidesOfTheHull)
{
	Random random(122);
	for (int trial = 0; trial < 200; ++trial) {
		// Corners of an ellipse at random angles, turned: a convex polygon.
		std::vector<double> angles;
		for (int i = 0; i < 3 + trial % 40; ++i)
			angles.push_back(random.real(0.0, trial % 3 == 0 ? 2.0 : 6.28));
		std::sort(angles.begin(), angles.end());
		const double height = random.real(0.05, 1.0), turn = random.real(0.0, 6.28);
		std::vector<Point2> hull;
		for (const double a : angles) {
			const double x = std::cos(a), y = height * std::sin(a);
			hull.push_back(
				{std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y});
		}
		std::vector<Point2> points = hull;
		const auto corner = [&] {
			return hull[positionOf(random.index(static_cast<int>(hull.size())))];
		};
		for (int i = 0; i < trial; ++i)
			points.push_back(between(corner(), corner(), random.real(0.0, 1.0)));
		random.shuffle(points);
		const OrientedRectangle r = minAreaRectangle(points);
		EXPECT_NEAR(area(r), minArea(hull), 1e-12) << trial;
		EXPECT_NEAR(r.cosine * r.cosine + r.sine * r.sine, 1.0, 1e-15);
		EXPECT_GE(r.width(), r.height());
		for (const Point2& p : points)
			for (std::size_t k = 0; k < 2; ++k) {
				EXPECT_GE(r.inFrame(p)[k], r.min[k] - 1e-14);
				EXPECT_LE(r.inFrame(p)[k], r.max[k] + 1e-14);
			}
	}
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

/// Half a right angle is best for a strip of 1 by h if h < sqrt(2) - 1, else none.
TEST(MinExtentRectangle, OfAStrip)
{
	Random random(122);
	for (double h : {0.0, 0.1, 0.3, 0.41, 0.42, 0.7, 1.0}) {
		const double angle = random.real(-3, 3), c = std::cos(angle), s = std::sin(angle);
		std::vector<Point2> points;
		for (double x : {0.0, 1.0})
			for (double y : {0.0, h})
				points.push_back({c * x - s * y + 2.0, s * x + c * y - 1.0});
		const OrientedRectangle r = minExtentRectangle(points);
		const double least = std::min(1.0, (1.0 + h) * std::sqrt(0.5));
		EXPECT_GE(std::max(r.width(), r.height()), least - 1e-12);
		EXPECT_LE(std::max(r.width(), r.height()), least * (1 + kSquareAccuracy));
	}
}

TEST(MinExtentRectangle, ContainsItsPointsAndNoTurnedOneIsShorter)
{
	Random random(123);
	for (int trial = 0; trial < 50; ++trial) {
		std::vector<Point2> points;
		for (int i = 0; i < 3 + trial; ++i)
			points.push_back({random.real(-1, 1), random.real(-2, 2)});
		const OrientedRectangle r = minExtentRectangle(points);
		EXPECT_NEAR(r.cosine * r.cosine + r.sine * r.sine, 1.0, 1e-15);
		for (int i = 0; i < 1000; ++i) {
			OrientedRectangle other;
			other.cosine = std::cos(i * 0.0017), other.sine = std::sin(i * 0.0017);
			Box2 box;
			for (const Point2& p : points) {
				box.add(other.inFrame(p));
				for (std::size_t k = 0; k < 2; ++k) {
					EXPECT_GE(r.inFrame(p)[k], r.min[k] - 1e-14);
					EXPECT_LE(r.inFrame(p)[k], r.max[k] + 1e-14);
				}
			}
			EXPECT_LE(std::max(r.width(), r.height()), box.extent() * (1 + kSquareAccuracy));
		}
	}
}

} // namespace
} // namespace ricci::testing
