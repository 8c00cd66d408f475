// SPDX-License-Identifier: GPL-3.0-or-later
#include <ricci/optimize/patches.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace ricci::testing {
namespace {

constexpr Validity kValid{1e-6, 2e-6, false};

/// Three triangles round a point inside the triangle of three others, and the shapes that they get
/// where the four points lie at \p places in space.
std::vector<RestShape> shapesOf(const std::vector<Point2>& places)
{
	FlatMesh flat;
	flat.place = Array<Point2>(std::vector<Point2>{{0.0, 0.0}, {4.0, 0.0}, {2.0, 3.0}, {2.0, 1.0}});
	Patch patch;
	for (const Triangle& t : {Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{2, 0, 3}}) {
		const auto side = [&](std::size_t i, std::size_t j) {
			return distance(places[positionOf(t[i])], places[positionOf(t[j])]);
		};
		patch.triangles.push_back(flat.points.size());
		patch.corners.push_back(t);
		flat.vertices.push_back(t);
		flat.points.push_back(t);
		flat.lengths.push_back({side(0, 1), side(1, 2), side(2, 0)});
	}
	patch.points = {0, 1, 2, 3};
	patch.variable = Array<int>(4, -1);
	return restShapes(flat, patch, RestShapes::OfSurface, kValid);
}

double longest(const RestShape& s)
{
	return std::max({s.base, std::abs(s.apex), std::abs(s.apex - s.base)});
}

TEST(RestShapes, HaveTheScaleOfTheDrawing)
{
	// The drawing is a quarter of the surface.
	for (const RestShape& s : shapesOf({{0.0, 0.0}, {16.0, 0.0}, {8.0, 12.0}, {8.0, 4.0}})) {
		EXPECT_GE(longest(s), 3.0 - 1e-9);
		EXPECT_LE(longest(s), 4.0 + 1e-9);
	}
}

TEST(RestShapes, TrianglesWithoutAreaHaveTheScaleOfTheirSides)
{
	// All on a line, of lengths near to those in the drawing: areas would tell a scale of hundreds.
	for (const double height : {0.0, 1e-18, 1e-9}) {
		SCOPED_TRACE(height);
		for (const RestShape& s : shapesOf({{0.0, 0.0}, {4.0, 0.0}, {2.5, height}, {1.5, 0.0}})) {
			EXPECT_GE(longest(s), 1.0);
			EXPECT_LE(longest(s), 6.0);
			EXPECT_GE(s.apex.imag() * s.base, kValid.wanted * (1.0 - 1e-9) * longest(s));
		}
	}
}

} // namespace
} // namespace ricci::testing
