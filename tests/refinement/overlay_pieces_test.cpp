// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles of the pieces of an overlay. common_refinement_test.cpp and corner_layout_test.cpp have the pieces.
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/refinement/overlay_pieces.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

using Corners = std::array<std::size_t, 3>;

/// A convex polygon in the plane and in space.
struct Polygon
{
	std::vector<Point2> plane;
	std::vector<Point3> space;

	/// Corners on an ellipse, some of the sides divided, and their image by a projective map.
	Polygon(int corners, int onSides, Random& random)
	{
		const double stretch = random.real(0.05, 1.0);
		for (int k = 0; k < corners; ++k) {
			const double angle = 2 * kPi * (k + random.real(0.0, 0.9)) / corners;
			plane.push_back({std::cos(angle), stretch * std::sin(angle)});
		}
		for (int i = 0; i < onSides; ++i) {
			const int k = random.index(static_cast<int>(plane.size()));
			const Point2 next = plane[(at(k) + 1) % plane.size()];
			plane.insert(plane.begin() + k + 1, between(plane[at(k)], next, random.real(0.1, 0.9)));
		}
		std::array<double, 9> m;
		for (double& x : m)
			x = random.real(-1.0, 1.0);
		const double bend = random.real(-0.4, 0.4), tilt = random.real(-0.4, 0.4);
		for (const Point2& p : plane) {
			const double w = 1.0 + bend * p[0] + tilt * p[1];
			Point3 q;
			for (std::size_t k = 0; k < 3; ++k)
				q[k] = (m[3 * k] * p[0] + m[3 * k + 1] * p[1] + m[3 * k + 2]) / w;
			space.push_back(q);
		}
	}

	/// Twice the area over the square of the longest side, in the plane or in space, by Heron's formula.
	double quality(const Corners& t) const { return std::min(shape(plane, t), shape(space, t)); }

private:
	template<class Point>
	static double shape(const std::vector<Point>& points, const Corners& t)
	{
		const double a = distance(points[t[0]], points[t[1]]),
					 b = distance(points[t[1]], points[t[2]]),
					 c = distance(points[t[2]], points[t[0]]), longest = std::max({a, b, c});
		const double product = (a + b + c) * (a + b - c) * (a - b + c) * (-a + b + c);
		return std::sqrt(std::max(0.0, product)) / (2 * longest * longest);
	}
};

/// All ways to divide corners i .. j into triangles: each has one triangle at the side from i to j.
std::vector<std::vector<Corners>> allTriangulations(std::size_t i, std::size_t j)
{
	if (j - i < 2)
		return {{}};
	std::vector<std::vector<Corners>> all;
	for (std::size_t k = i + 1; k < j; ++k)
		for (const auto& left : allTriangulations(i, k))
			for (const auto& right : allTriangulations(k, j)) {
				std::vector<Corners> triangles{{i, k, j}};
				triangles.insert(triangles.end(), left.begin(), left.end());
				triangles.insert(triangles.end(), right.begin(), right.end());
				all.push_back(triangles);
			}
	return all;
}

double worst(const Polygon& polygon, const std::vector<Corners>& triangles)
{
	double quality = 1.0;
	for (const Corners& t : triangles)
		quality = std::min(quality, polygon.quality(t));
	return quality;
}

TEST(PieceTriangulation, IsTheBestOfAll)
{
	EXPECT_EQ(allTriangulations(0, 7).size(), 132u); // Catalan's number for 8 corners
	Random random(830);
	for (int trial = 0; trial < 300; ++trial) {
		const Polygon polygon(3 + random.index(4), random.index(3), random);
		double best = 0.0;
		for (const auto& triangles : allTriangulations(0, polygon.plane.size() - 1))
			best = std::max(best, worst(polygon, triangles));
		const auto triangles = triangulatePiece(polygon.plane, polygon.space);
		// Heron's formula knows the square of the area to rounding of the longest side's fourth power.
		EXPECT_NEAR(std::pow(worst(polygon, triangles), 2), best * best, 1e-13);
	}
	EXPECT_EQ(
		triangulatePiece(
			{{0, 0}, {1, 0}, {0, 1}}, {Point3{0, 0, 0}, Point3{1, 0, 0}, Point3{2, 0, 0}}),
		(std::vector<Corners>{{0, 1, 2}}));
}

} // namespace
} // namespace ricci::testing
