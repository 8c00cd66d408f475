// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"
#include "support/listener.h"
#include "support/random.h"

#include <ricci/base/numbers.h>
#include <ricci/charts/outline.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

Outline outlineOf(const FlatMesh& chart)
{
	return outlineOf(chart, chart.trianglesByChart(1).front());
}

Outline square(const Point2& corner, double side)
{
	FlatMesh mesh = flatMesh(rectangle(1, 1, side, side));
	for (Point2& p : mesh.place)
		p += corner;
	return outlineOf(mesh);
}

/// The unit square without the middle one of nine, in squares of two triangles.
SurfaceMesh frame()
{
	SurfaceMesh mesh = rectangle(3, 3, 1.0, 1.0);
	mesh.triangles.erase(mesh.triangles.begin() + 8, mesh.triangles.begin() + 10);
	return mesh;
}

TEST(OutlineOf, HasTheBorderOnItsLeftWhateverTheTrianglesOrder)
{
	SurfaceMesh mesh = frame();
	const Outline outline = outlineOf(flatMesh(mesh));
	EXPECT_EQ(outline.size(), 12u + 4u);
	double doubled = 0.0;
	for (const auto& side : outline)
		doubled += doubledArea({0.0, 0.0}, side[0], side[1]);
	EXPECT_NEAR(doubled, 2.0 * 8.0 / 9.0, 1e-14);
	std::reverse(mesh.triangles.begin(), mesh.triangles.end());
	EXPECT_EQ(outlineOf(flatMesh(mesh)), outline);
}

/// A flipped triangle covers its points as often less: both sides of its edges go round them.
TEST(OutlineOf, OfAFoldHasItsSidesTwice)
{
	const SurfaceMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
	const FlatMesh mesh = flatMesh(square), folded = flatMesh(square, 3, {0.9, 0.1});
	const auto diagonals = [](const FlatMesh& chart) {
		const Outline outline = outlineOf(chart);
		return std::count_if(outline.begin(), outline.end(), [](const auto& s) {
			return s[0][0] != s[1][0] && s[0][1] != s[1][1] && distance(s[0], s[1]) > 1.4 &&
				   distance(s[0], s[1]) < 1.42;
		});
	};
	EXPECT_EQ(flippedIn(mesh), 0);
	ASSERT_EQ(flippedIn(folded), 1);
	EXPECT_EQ(diagonals(mesh), 0);
	EXPECT_EQ(diagonals(folded), 2);
}

TEST(OutlineOf, OfNothing)
{
	const SurfaceMesh point{{{1, 2, 0}, {1, 2, 0}, {1, 2, 0}}, {{0, 1, 2}}};
	EXPECT_TRUE(outlineOf(flatMesh(point)).empty());
}

TEST(KeepApart, AgreesWithDistancesThatAreKnown)
{
	const double root = std::sqrt(0.5);
	struct Case
	{
		Point2 corner;
		double distance; // of [0, 1]^2 from the unit square there
	};
	for (const Case& c :
		 {Case{{1.25, 0.5}, 0.25},
		  Case{{0.3, -1.125}, 0.125},
		  Case{{1.5, 1.5}, root},
		  Case{{-1.5, 1.5}, root}}) {
		const std::vector<Outline> outlines{square({0.0, 0.0}, 1.0), square(c.corner, 1.0)};
		EXPECT_TRUE(keepApart(outlines, 0.999999 * c.distance));
		EXPECT_FALSE(keepApart(outlines, 1.000001 * c.distance));
	}
}

/// A circle of n sides.
Outline circle(const Point2& centre, double radius, int n)
{
	Outline outline;
	const auto at = [&](int i) {
		const double angle = 2.0 * kPi * (i % n) / n;
		return Point2{centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)};
	};
	for (int i = 0; i < n; ++i)
		outline.push_back({at(i), at(i + 1)});
	return outline;
}

TEST(KeepApart, AgreesWithEveryPairOfCornersOfRoundCharts)
{
	Random random(362);
	int apart = 0;
	for (int trial = 0; trial < 200; ++trial) {
		std::vector<Outline> outlines;
		for (int i = 0; i < 5; ++i)
			outlines.push_back(circle({3.0 * i, random.real(-2.0, 2.0)}, 1.0, 20 + 30 * (i % 2)));
		double nearest = HUGE_VAL;
		for (std::size_t i = 0; i < outlines.size(); ++i)
			for (std::size_t j = 0; j < i; ++j)
				for (const auto& s : outlines[i])
					for (const auto& t : outlines[j])
						for (const std::size_t k : {0u, 1u}) {
							const double to = nearestOnSegment(s[0], s[1], t[k]);
							const double back = nearestOnSegment(t[0], t[1], s[k]);
							nearest = std::min(
								{nearest,
								 distance(t[k], between(s[0], s[1], to)),
								 distance(s[k], between(t[0], t[1], back))});
						}
		for (const double padding : {0.5 * nearest, 0.999999 * nearest, 1.000001 * nearest, 3.0}) {
			EXPECT_EQ(keepApart(outlines, padding), padding < nearest);
			apart += padding < nearest;
		}
	}
	EXPECT_EQ(apart, 400);
}

TEST(KeepApart, EndsAtTheFirstPairAndWhenTickThrows)
{
	// Room for thousands of their sides.
	std::vector<Outline> outlines{circle({0.0, 0.0}, 1.0, 20000), circle({1.8, 1.8}, 1.0, 20000)};
	Listener ticks;
	EXPECT_TRUE(heard(ticks, [&] { return keepApart(outlines, 0.54); }));
	EXPECT_GE(ticks.calls(), 20000 / 64);
	outlines[1] = circle({2.5, 0.0}, 1.5, 30000);
	Listener again;
	EXPECT_FALSE(heard(again, [&] { return keepApart(outlines, 0.54); }));
	EXPECT_EQ(again.calls(), 1); // the first side of the smaller one is its rightmost
	Listener impatient(1);
	EXPECT_THROW(heard(impatient, [&] { keepApart(outlines, 0.54); }), Cancelled);
}

TEST(KeepApart, FindsChartsThatCrossOrHoldEachOther)
{
	const Outline outer = square({0.0, 0.0}, 1.0);
	EXPECT_FALSE(keepApart({outer, square({0.5, 0.5}, 1.0)}, 1e-9));
	EXPECT_FALSE(keepApart({outer, square({0.4, 0.4}, 0.2)}, 1e-9));
	EXPECT_FALSE(keepApart({square({0.4, 0.4}, 0.2), outer}, 1e-9));
	// In the hole of a frame there is room.
	const Outline ring = outlineOf(flatMesh(frame()));
	EXPECT_TRUE(keepApart({ring, square({0.4, 0.4}, 0.2)}, 0.06));
	EXPECT_FALSE(keepApart({ring, square({0.4, 0.4}, 0.2)}, 0.07));
}

} // namespace
} // namespace ricci::testing
