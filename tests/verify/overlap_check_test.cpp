// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/verify/overlap_check.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

/// The strip of a ring, turning by \p angle: it overlaps itself where that is more than 2 pi, but for its
/// ends, which lie beside each other.
FlatMesh strip(double angle)
{
	return flatMesh(grid(40, 2, Ends::Open, Ends::Open, [&](int i, int j) {
		const double a = angle * i / 40, r = 2.0 - 0.5 * j + 0.5 * a / (2 * kPi);
		return Point3{r * std::cos(a), r * std::sin(a), 0.0};
	}));
}

/// Unit squares of two triangles with these lower left corners, one chart each.
Parametrization squares(const std::vector<Point2>& corners)
{
	SurfaceMesh mesh;
	for (const Point2& c : corners) {
		const int first = static_cast<int>(mesh.positions.size());
		for (const Point2& p : {Point2{0, 0}, {1, 0}, {1, 1}, {0, 1}})
			mesh.positions.push_back({c[0] + p[0], c[1] + p[1], 0.0});
		mesh.triangles.push_back({first, first + 1, first + 2});
		mesh.triangles.push_back({first, first + 2, first + 3});
	}
	FlatMesh flat = flatMesh(mesh);
	for (const int f : flat.chart.indices())
		flat.chart[f] = f / 2;
	Parametrization map = mapWith(flat);
	map.charts.resize(corners.size());
	return map;
}

std::array<int, 2> facesAndCharts(Parametrization map)
{
	countOverlaps(map);
	return {map.report.overlappingFaces, map.report.overlappingCharts};
}

using Counts = std::array<int, 2>;

TEST(CountOverlaps, FindsThoseOfAChartWithItself)
{
	EXPECT_EQ(facesAndCharts(mapWith(strip(1.5 * kPi))), (Counts{0, 0}));
	// The strip is as wide as it moves out in a turn. What lies beyond that touches what it passes; each of
	// the triangles at an end that goes on lies on one of the beginning, and a ring has straight sides.
	const Counts counts = facesAndCharts(mapWith(strip(2.3 * kPi)));
	EXPECT_GT(counts[0], 0);
	EXPECT_EQ(counts[1], 1);
}

TEST(CountOverlaps, FindsThoseOfTwoCharts)
{
	EXPECT_EQ(facesAndCharts(squares({{0, 0}, {1, 0}, {0, 1}})), (Counts{0, 0})); // they touch
	EXPECT_EQ(facesAndCharts(squares({{0, 0}, {2, 0}})), (Counts{0, 0}));
	// The lower right triangle of the first, and the upper left one of the second.
	EXPECT_EQ(facesAndCharts(squares({{0, 0}, {0.9, -0.8}, {5, 5}})), (Counts{2, 2}));
	EXPECT_EQ(facesAndCharts(squares({{0, 0}, {0, 0}})), (Counts{4, 2})); // one on the other
}

/// Charts that are a step of a double apart may be stored at one place, and overlap by what is stored.
TEST(CountOverlaps, GoesByTheCoordinatesAsFloats)
{
	const double step = std::ldexp(1.0, -23); // of a float above 1
	EXPECT_EQ(facesAndCharts(squares({{0, 0}, {1 - 2 * step, 0}})), (Counts{0, 0}));
	EXPECT_GT(facesAndCharts(squares({{0, 0}, {1 - 40 * step, 0}}))[0], 0);
	EXPECT_EQ(facesAndCharts(squares({{1e6, 0}, {1e6 + 0.999, 0}})), (Counts{0, 0}));
	EXPECT_GT(facesAndCharts(squares({{1e3, 0}, {1e3 + 0.99, 0}}))[0], 0);
}

/// Two squares whose common side is a seam, the right one wider and higher by the factor \p scale.
int unequalSeams(double scale)
{
	const SurfaceMesh mesh{
		{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}},
		{{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}};
	FlatMesh flat = flatMesh(mesh);
	flat.chart = Array<int>(std::vector<int>{0, 0, 1, 1});
	splitPoints(flat);
	const Array<int> chart = flat.chartOfPoints();
	for (const int p : chart.indices())
		if (chart[p] == 1)
			for (double& x : flat.place[p])
				x *= scale;
	Parametrization map = mapWith(flat);
	map.charts.resize(2);
	countUnequalSeams(map);
	return map.report.unequalSeams;
}

TEST(CountUnequalSeams, ComparesTheSidesOfEachEdge)
{
	EXPECT_EQ(unequalSeams(1.0), 0);
	EXPECT_EQ(unequalSeams(1.0 + 0.9 * kUnequalShare), 0);
	EXPECT_EQ(unequalSeams(1.0 + 1.1 * kUnequalShare), 1);
	EXPECT_EQ(unequalSeams(1.0 / (1.0 + 1.1 * kUnequalShare)), 1);
}

TEST(CountUnequalSeams, CountsNoEdgeInsideAndNoBoundary)
{
	Parametrization map = mapWith(strip(1.5 * kPi));
	countUnequalSeams(map);
	EXPECT_EQ(map.report.unequalSeams, 0);
}

} // namespace
} // namespace ricci::testing
