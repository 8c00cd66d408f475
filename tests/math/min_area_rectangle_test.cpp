// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/base/numbers.h>
#include <ricci/math/convex_hull.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

double area(const OrientedRectangle& r)
{
	return r.width() * r.height();
}

TEST(MinAreaRectangle, FindsATurnedRectangle)
{
	Random random(120);
	for (int trial = 0; trial < 100; ++trial) {
		const double angle = random.real(-3, 3), w = random.real(2, 5), h = random.real(0.5, 1.5);
		std::vector<Point2> points;
		const auto add = [&](double x, double y) {
			points.push_back(
				{3 + std::cos(angle) * x - std::sin(angle) * y,
				 std::sin(angle) * x + std::cos(angle) * y - 7});
		};
		for (double x : {0.0, w})
			for (double y : {0.0, h})
				add(x, y);
		for (int i = 0; i < 50; ++i)
			add(random.real(0, w), random.real(0, h));
		random.shuffle(points);
		const OrientedRectangle r = minAreaRectangle(points);
		EXPECT_NEAR(r.width(), w, 1e-12);
		EXPECT_NEAR(r.height(), h, 1e-12);
		EXPECT_NEAR(r.cosine * r.cosine + r.sine * r.sine, 1.0, 1e-15);
	}
}

TEST(MinAreaRectangle, ContainsItsPointsAndNoTurnedOneIsSmaller)
{
	Random random(121);
	for (int trial = 0; trial < 50; ++trial) {
		std::vector<Point2> points;
		for (int i = 0; i < 3 + trial; ++i)
			points.push_back({random.real(-1, 1), random.real(-2, 2)});
		const OrientedRectangle r = minAreaRectangle(points);
		for (const Point2& p : points)
			for (std::size_t k = 0; k < 2; ++k) {
				EXPECT_GE(r.inFrame(p)[k], r.min[k] - 1e-14);
				EXPECT_LE(r.inFrame(p)[k], r.max[k] + 1e-14);
			}
		EXPECT_GE(r.width(), r.height());
		for (int i = 0; i < 200; ++i) {
			OrientedRectangle other;
			other.cosine = std::cos(i * 0.01), other.sine = std::sin(i * 0.01);
			other.min = other.max = other.inFrame(points[0]);
			for (const Point2& p : points)
				for (std::size_t k = 0; k < 2; ++k) {
					other.min[k] = std::min(other.min[k], other.inFrame(p)[k]);
					other.max[k] = std::max(other.max[k], other.inFrame(p)[k]);
				}
			EXPECT_LE(area(r), area(other) * (1 + 1e-12));
		}
	}
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
		const double least = minArea(hull);
		EXPECT_NEAR(area(minAreaRectangle(hull)), least, 1e-12) << trial;
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
