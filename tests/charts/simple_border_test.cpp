// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/charts/chart_overlap.h>
#include <ricci/charts/simple_border.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

bool isSimple(const FlatMesh& chart)
{
	return hasSimpleBorder(chart, chart.trianglesByChart(1).front());
}

/// A ring that goes round by \p turns, with a border that is shifted at random.
SurfaceMesh ring(double turns, double shift, Ends ends, Random& random)
{
	const int around = 40;
	return grid(2, around, Ends::Open, ends, [&](int i, int j) {
		const double r = 1.0 + i + random.real(-shift, shift), a = 2 * kPi * turns * j / around;
		return Point3{r * std::cos(a), r * std::sin(a), 0.0};
	});
}

TEST(SimpleBorder, OfDisksAndRings)
{
	Random random(1240);
	EXPECT_TRUE(isSimple(flatMesh(rectangle(5, 4, 3.0, 2.0))));
	EXPECT_TRUE(isSimple(flatMesh(ring(0.9, 0.0, Ends::Open, random))));
	EXPECT_TRUE(isSimple(flatMesh(ring(1.0, 0.0, Ends::Joined, random)))); // with a hole
	EXPECT_FALSE(isSimple(flatMesh(ring(1.1, 0.0, Ends::Open, random))));
}

/// Holes that meet in a point, or a slit, are left to another test.
TEST(SimpleBorder, TouchesNothing)
{
	SurfaceMesh mesh = rectangle(6, 6, 6.0, 6.0);
	const auto cell = [](int x, int y) { return 2 * (6 * y + x); }; // or of x and y exchanged
	const auto without = [&](std::vector<int> faces) {
		SurfaceMesh rest = mesh;
		std::sort(faces.rbegin(), faces.rend());
		for (const int f : faces)
			rest.triangles.erase(rest.triangles.begin() + f);
		return flatMesh(rest);
	};
	const int a = cell(2, 2), b = cell(3, 3), c = cell(4, 4);
	EXPECT_TRUE(isSimple(without({a, a + 1})));
	EXPECT_TRUE(isSimple(without({a, a + 1, c, c + 1})));
	EXPECT_FALSE(isSimple(without({a, a + 1, b, b + 1})));
	// The sides of one cell are drawn apart: the slit has two sides at one place.
	SurfaceMesh slit = mesh;
	for (const int f : {a, a + 1})
		for (int& v : slit.triangles[at(f)]) {
			slit.positions.push_back(slit.positions[at(v)]);
			v = static_cast<int>(slit.positions.size()) - 1;
		}
	EXPECT_FALSE(isSimple(flatMesh(slit)));
}

TEST(SimpleBorder, HasOneOuterPolygon)
{
	const SurfaceMesh large = rectangle(2, 2, 4.0, 4.0), small = rectangle(1, 1, 0.5, 0.5);
	for (const double shift : {0.7, 9.0}) // inside the other one, and beside it
		EXPECT_FALSE(isSimple(flatMesh(sideBySide(large, small, shift))));
}

TEST(SimpleBorder, HasNoFold)
{
	SurfaceMesh mesh = rectangle(6, 6, 6.0, 6.0);
	mesh.positions[at(3 * 7 + 3)] = {4.4, 4.1, 0.0};
	EXPECT_FALSE(isSimple(flatMesh(mesh)));
}

/// Where it is simple, the search finds nothing; and where the search finds something, it is not.
TEST(SimpleBorder, AgreesWithTheSearch)
{
	Random random(1241);
	int simple = 0, overlapping = 0;
	for (int trial = 0; trial < 400; ++trial) {
		const FlatMesh chart =
			flatMesh(ring(random.real(0.9, 1.06), trial % 2 == 0 ? 0.0 : 0.3, Ends::Open, random));
		const bool isFree = overlappingPairs(chart).empty();
		if (isSimple(chart)) {
			EXPECT_TRUE(isFree);
			++simple;
		}
		overlapping += !isFree;
	}
	EXPECT_GT(simple, 100);
	EXPECT_GT(overlapping, 100);
}

} // namespace
} // namespace ricci::testing
