// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"
#include "support/random.h"

#include <ricci/layout/flat_mesh.h>
#include <ricci/surface/sides.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace ricci::testing {
namespace {

constexpr int kSide = 4;

/// A square whose upper half lies elsewhere.
FlatMesh withSeam(const Point2& shift)
{
	const SurfaceMesh mesh = rectangle(kSide, kSide, 1.0, 1.0);
	std::vector<Triangle2> plane = flatMesh(mesh).corners().values();
	for (std::size_t f = 0; f < plane.size(); ++f)
		if (std::any_of(
				plane[f].begin(), plane[f].end(), [](const Point2& p) { return p[1] > 0.5; }))
			for (Point2& p : plane[f])
				p += shift;
	return flatMesh(mesh, plane);
}

int seamsOf(const FlatMesh& mesh)
{
	const Sides sides(mesh.vertices.values());
	int seams = 0;
	for (const Corner side : mesh.across.indices()) {
		const Corner other = mesh.across[side], joined = mesh.joined(side);
		EXPECT_EQ(other, sides.across(side));
		if (!other.isValid()) {
			EXPECT_FALSE(joined.isValid());
			continue;
		}
		EXPECT_EQ(mesh.joined(other), joined.isValid() ? side : Corner());
		seams += other > side && joined != other;
	}
	return seams;
}

TEST(FlatMesh, IsJoinedWhereSidesLieOnEachOther)
{
	const FlatMesh whole = withSeam({0.0, 0.0}), apart = withSeam({2.0, 0.0});
	EXPECT_EQ(whole.place.size(), (kSide + 1) * (kSide + 1));
	EXPECT_EQ(seamsOf(whole), 0);
	EXPECT_EQ(apart.place.size(), (kSide + 1) * (kSide + 2));
	EXPECT_EQ(seamsOf(apart), kSide);
}

TEST(FlatMesh, SplitPointsBelongToOneChartAndOneFan)
{
	FlatMesh mesh = withSeam({0.0, 0.0});
	const Array<Triangle2> before = mesh.corners();
	for (const int f : mesh.chart.indices())
		mesh.chart[f] = f % 2;
	splitPoints(mesh);
	EXPECT_EQ(mesh.corners(), before);
	// Triangles of one kind meet in points alone.
	EXPECT_EQ(mesh.place.size(), 3 * mesh.size());
	const Array<int> chart = mesh.chartOfPoints();
	for (const int f : mesh.points.indices())
		for (const int p : mesh.points[f])
			EXPECT_EQ(chart[p], mesh.chart[f]);
}

/// A chart that is cut in two: the points of the other stay, those along the cut are two.
TEST(FlatMesh, PointsOfSomeTrianglesAreSplitAsThoseOfAll)
{
	Random random(77);
	for (int trial = 0; trial < 50; ++trial) {
		FlatMesh mesh = withSeam({2.0, 0.0});
		mesh.chart.assign(mesh.size(), random.index(2));
		std::vector<int> all(at(mesh.size()));
		std::iota(all.begin(), all.end(), 0);
		for (const int f : all)
			if (random.index(4) == 0)
				mesh.chart[f] = 2;
		FlatMesh some = mesh;
		splitPoints(mesh);
		splitPoints(all, some);
		EXPECT_EQ(some.corners(), mesh.corners());
		ASSERT_EQ(some.place.size(), mesh.place.size());
		Array<int> pointOf(mesh.place.size(), -1);
		for (const int f : all)
			for (const Corner c : cornersOf(f)) {
				int& point = pointOf[mesh.points[c]];
				EXPECT_TRUE(point < 0 || point == some.points[c]);
				point = some.points[c];
			}
	}
}

TEST(FlatMesh, PartsKeepTheirTrianglesAndShareNoIndices)
{
	const FlatMesh mesh = withSeam({2.0, 0.0});
	const std::vector<int> some = {17, 2, 3, 4, 5, 30};
	const FlatMesh part = mesh.part(some);
	ASSERT_EQ(at(part.size()), some.size());
	for (std::size_t i = 0; i < some.size(); ++i) {
		const int own = static_cast<int>(i);
		EXPECT_EQ(part.at(own), mesh.at(some[i]));
		EXPECT_EQ(part.vertices[own], mesh.vertices[some[i]]);
		EXPECT_EQ(part.lengths[own], mesh.lengths[some[i]]);
		EXPECT_EQ(part.face[own], mesh.face[some[i]]);
	}
	const Sides sides(part.vertices.values());
	for (const Corner side : part.across.indices())
		EXPECT_EQ(part.across[side], sides.across(side));
	FlatMesh result = mesh;
	result.across.clear(); // as in results
	EXPECT_EQ(result.part(some).points, part.points);
	EXPECT_TRUE(result.part(some).across.empty());
	EXPECT_EQ(at(part.place.size()), part.pointsByChart(1).front().size());
	EXPECT_EQ(mesh.trianglesByChart(1).front().size(), at(mesh.size()));
}

} // namespace
} // namespace ricci::testing
