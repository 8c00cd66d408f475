// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"

#include <ricci/base/numbers.h>
#include <ricci/verify/chart_check.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

/// Crossings of a strip of a ring that turns by \p angle and moves outwards by \p rise in a turn.
int crossingsOfAStrip(double angle, double rise, double depth)
{
	const int n = 40;
	const SurfaceMesh strip = grid(n, 2, Ends::Open, Ends::Open, [&](int i, int j) {
		const double a = angle * i / n, r = 2.0 - 0.5 * j + rise * a / (2 * kPi);
		return Point3{r * std::cos(a), r * std::sin(a), 0.0};
	});
	return borderCrossings(flatMesh(strip), depth);
}

TEST(ChartCheck, ABorderThatDoesNotCrossItself)
{
	EXPECT_EQ(crossingsOfAStrip(1.5 * kPi, 0.0, 1e-9), 0);
	EXPECT_EQ(crossingsOfAStrip(2.0 * kPi, 0.0, 1e-9), 0); // the ends touch
	EXPECT_EQ(crossingsOfAStrip(3.0 * kPi, 1.5, 1e-9), 0); // a spiral with room between its turns
}

TEST(ChartCheck, ASideMayEndOnAnother)
{
	// A second triangle's corner lies on a side of the first, or past it by less than is allowed.
	for (double past : {0.0, 1e-9, 1e-3})
		for (double up : {1.0, -1.0})
			for (const Triangle& second : {Triangle{3, 4, 5}, Triangle{5, 4, 3}}) {
				const std::vector<Triangle2> plane = {
					{{{-2.0, 0.0}, {2.0, 0.0}, {0.0, -3.0 * up}}},
					{{{0.1, -past * up}, {0.6, up}, {-0.4, up}}}};
				const SurfaceMesh two{std::vector<Point3>(6), {{0, 1, 2}, second}};
				const int crossings = borderCrossings(flatMesh(two, plane), 1e-6);
				EXPECT_EQ(crossings, past > 1e-6 ? 2 : 0);
			}
}

TEST(ChartCheck, ABorderThatCrossesItself)
{
	// The last end lies across the outer border of the first turn, the first end across the inner
	// border of the last one.
	EXPECT_EQ(crossingsOfAStrip(2.3 * kPi, 0.5, 1e-9), 2);
	EXPECT_EQ(crossingsOfAStrip(3.9 * kPi, 0.6, 1e-9), 2);
	// The sides that cross are half a unit long.
	EXPECT_EQ(crossingsOfAStrip(2.3 * kPi, 0.5, 0.5), 0);
}

} // namespace
} // namespace ricci::testing
