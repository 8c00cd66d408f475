// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_maps.h"

#include <ricci/finish/convex_layout.h>
#include <ricci/finish/repair.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

namespace ricci::testing {
namespace {

/// All triangles of a drawing.
Patch wholeOf(const FlatMesh& flat)
{
	std::vector<int> seeds;
	for (const int f : flat.points.indices())
		seeds.push_back(f);
	return PatchFinder(flat, allPoints(flat)).patches(seeds, 1).at(0);
}

/// The square without the cells of \p holes and without points that no triangle has.
FlatMesh squareWithout(const std::vector<std::array<int, 2>>& holes)
{
	const FlatMesh whole = square();
	FlatMesh flat;
	flat.place = whole.place;
	for (const int f : whole.points.indices()) {
		bool isOpen = false;
		for (const auto& [i, j] : holes)
			isOpen = isOpen || f / 2 == j * kSide + i;
		if (isOpen)
			continue;
		flat.vertices.push_back(whole.vertices[f]);
		flat.points.push_back(whole.points[f]);
		flat.lengths.push_back(whole.lengths[f]);
	}
	connect(flat);
	return flat;
}

void expectNoFold(const Patch& patch, const std::vector<Point2>& places)
{
	ASSERT_EQ(places.size(), patch.points.size());
	for (const Triangle& t : patch.corners)
		EXPECT_GT(
			orientation(
				places[positionOf(t[0])], places[positionOf(t[1])], places[positionOf(t[2])]),
			0);
}

TEST(ConvexLayout, TurnsNoTriangleRoundWithOrWithoutHoles)
{
	for (const auto& holes :
		 {std::vector<std::array<int, 2>>{},
		  std::vector<std::array<int, 2>>{{5, 5}},
		  std::vector<std::array<int, 2>>{{1, 1}, {8, 3}, {8, 4}, {9, 4}}}) {
		SCOPED_TRACE(holes.size());
		const FlatMesh flat = squareWithout(holes);
		const Patch patch = wholeOf(flat);
		expectNoFold(patch, convexLayout(patch));
	}
}

TEST(ConvexLayout, DrawsAStripWithoutPointsInside)
{
	for (int count = 1; count <= 5; ++count) {
		SCOPED_TRACE(count);
		Patch strip;
		for (int i = 0; i < count; ++i) {
			strip.triangles.push_back(i);
			strip.corners.push_back(
				i % 2 == 0 ? Triangle{i, i + 1, i + 2} : Triangle{i + 1, i, i + 2});
		}
		for (int p = 0; p < count + 2; ++p)
			strip.points.push_back(p);
		expectNoFold(strip, convexLayout(strip));
	}
}

TEST(ConvexLayout, PutsTheBorderOnTheCircleAndPointsInsideAtTheMeanOfTheirNeighbours)
{
	const FlatMesh flat = square();
	const Patch patch = wholeOf(flat);
	const std::vector<Point2> places = convexLayout(patch);
	ASSERT_EQ(places.size(), patch.points.size());
	std::vector<std::set<int>> neighbours(places.size());
	for (const Triangle& t : patch.corners)
		for (std::size_t k = 0; k < 3; ++k) {
			neighbours[positionOf(t[k])].insert(t[(k + 1) % 3]);
			neighbours[positionOf(t[k])].insert(t[(k + 2) % 3]);
		}
	for (std::size_t p = 0; p < places.size(); ++p) {
		Point2 mean{0.0, 0.0};
		for (const int q : neighbours[p])
			for (std::size_t i = 0; i < 2; ++i)
				mean[i] += places[positionOf(q)][i] / static_cast<double>(neighbours[p].size());
		if (isInside(patch.points[p]))
			EXPECT_LT(distance(places[p], mean), 1e-13);
		else
			EXPECT_NEAR(distance(places[p], {0.0, 0.0}), 1.0, 1e-15);
	}
}

TEST(ConvexLayout, IsEmptyForWhatIsNoDisk)
{
	// A torus of 3 by 3 cells; a tetrahedron; two triangles glued at two of their sides.
	Patch torus;
	const auto at = [](int i, int j) { return 3 * (j % 3) + i % 3; };
	for (int j = 0; j < 3; ++j)
		for (int i = 0; i < 3; ++i) {
			torus.corners.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
			torus.corners.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
		}
	torus.points.resize(9);
	torus.triangles.resize(18);
	EXPECT_TRUE(convexLayout(torus).empty());
	torus.corners = Array<Triangle>(std::vector<Triangle>(
		torus.corners.begin() + 1, torus.corners.end())); // of genus 1 with a border
	torus.triangles.resize(17);
	EXPECT_TRUE(convexLayout(torus).empty());
	Patch closed;
	for (const Triangle& t :
		 {Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 1}, Triangle{1, 3, 2}})
		closed.corners.push_back(t);
	closed.points.resize(4);
	closed.triangles.resize(4);
	EXPECT_TRUE(convexLayout(closed).empty());
	Patch folded;
	folded.corners.push_back({0, 1, 2});
	folded.corners.push_back({0, 1, 2});
	folded.points.resize(3);
	folded.triangles.resize(2);
	EXPECT_TRUE(convexLayout(folded).empty());
}

TEST(ConvexLayout, MendsADrawingWhosePointsAreAnywhere)
{
	const Validity wanted{1e-6, 2e-6, false};
	for (std::uint64_t seed = 0; seed < 10; ++seed) {
		SCOPED_TRACE(seed);
		FlatMesh flat = squareWithout({{5, 5}});
		Random random(seed);
		for (Point2& p : flat.place)
			p = {random.real(0.0, kSide), 1e-9 * random.real(0.0, kSide)};
		WorkLimit limit(flat.points.size());
		const Repair result = repairFreely(flat, {RestShapes::OfSurface, wanted}, limit);
		EXPECT_GT(result.bad, 100);
		EXPECT_EQ(result.left, 0);
		EXPECT_TRUE(badTriangles(flat, wanted).empty());
	}
}

/// A flat chart that may be in the plane only where its border is convex.
TEST(ConvexLayout, IsTakenWhereTheSearchLeadsToWhatIsRefused)
{
	const Validity wanted{1e-6, 2e-6, false};
	FlatMesh flat = square();
	for (Point2& p : flat.place)
		p = {p[0], 1e-9 * p[0]};
	int refused = 0;
	const PatchTest isRound = [&](const FlatMesh& d, const Patch& patch) {
		const std::vector<Point2> layout = convexLayout(patch);
		double scale = 0.0, error = 0.0;
		Point2 middle{0.0, 0.0};
		for (const int p : patch.points)
			for (std::size_t i = 0; i < 2; ++i)
				middle[i] += d.place[p][i] / static_cast<double>(patch.points.size());
		for (std::size_t p = 0; p < layout.size(); ++p)
			if (!isInside(patch.points[p])) {
				const double radius = distance(d.place[patch.points[p]], middle);
				error = std::max(error, scale > 0.0 ? std::abs(radius / scale - 1.0) : 0.0);
				scale = radius;
			}
		refused += error > 0.01;
		return patch.isFree() && error <= 0.01;
	};
	WorkLimit limit(flat.points.size());
	const Repair result = repairFreely(flat, {RestShapes::OfSurface, wanted, isRound}, limit);
	EXPECT_EQ(result.bad, 2 * kSide * kSide);
	EXPECT_GT(refused, 0);
	EXPECT_EQ(result.left, 0);
	EXPECT_TRUE(badTriangles(flat, wanted).empty());
}

} // namespace
} // namespace ricci::testing
