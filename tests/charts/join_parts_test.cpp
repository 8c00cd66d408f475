// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"
#include "support/random.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/charts/chart_overlap.h>
#include <ricci/charts/join_parts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace ricci::testing {
namespace {

/// A mesh over the plane, of which each part lies elsewhere.
struct Scattered
{
	FlatMesh flat;
	std::vector<std::vector<int>> parts;

	/// \param partOf [triangle]
	Scattered(const SurfaceMesh& mesh, const Array<int>& partOf, Random& random) :
			parts(at(*std::max_element(partOf.begin(), partOf.end()) + 1))
	{
		std::vector<Motion> motions;
		for (std::size_t i = 0; i < parts.size(); ++i)
			motions.push_back(
				{std::polar(1.0, random.real(0, 2 * kPi)),
				 {random.real(-20, 20), random.real(-20, 20)}});
		std::vector<Triangle2> plane = flatMesh(mesh).corners().values();
		for (const int f : partOf.indices()) {
			plane[at(f)] = motions[at(partOf[f])](plane[at(f)]);
			parts[at(partOf[f])].push_back(f);
		}
		flat = flatMesh(mesh, plane);
	}

	std::vector<std::vector<int>> join()
	{
		const Seams before = seams(flat);
		auto joined = joinParts(flat, parts);
		const Seams after = seams(flat);
		edgesJoined = static_cast<int>(before.edges.size() - after.edges.size());
		lengthJoined = before.length - after.length;
		return joined;
	}

	int edgesJoined = 0;
	double lengthJoined = 0.0;
};

Point2 centreOf(const SurfaceMesh& mesh, const Triangle& t)
{
	Point2 centre{0, 0};
	for (const int v : t)
		for (std::size_t k = 0; k < 2; ++k)
			centre[k] += mesh.positions[at(v)][k] / 3;
	return centre;
}

/// Triangles of one part must not cover each other.
void expectNothingCoveredTwice(const FlatMesh& flat, const std::vector<std::vector<int>>& parts)
{
	for (const std::vector<int>& part : parts)
		EXPECT_TRUE(overlappingPairs(flat.part(part)).empty());
}

TEST(JoinParts, PutsAPictureTogether)
{
	Random random(920);
	const SurfaceMesh mesh = rectangle(6, 4, 6.0, 4.0);
	Array<int> block; // two by two
	for (const Triangle& t : mesh.triangles) {
		const Point2 p = centreOf(mesh, t);
		block.push_back(3 * static_cast<int>(p[1] / 2) + static_cast<int>(p[0] / 2));
	}
	Scattered s(mesh, block, random);
	ASSERT_EQ(s.parts.size(), 6u);
	const auto joined = s.join();
	ASSERT_EQ(joined.size(), 1u);
	EXPECT_EQ(joined[0].size(), mesh.triangles.size());
	// Three lines between the blocks: two of 4 and one of 6, in edges of length 1.
	EXPECT_EQ(s.edgesJoined, 14);
	EXPECT_NEAR(s.lengthJoined, 14.0, 1e-12);
	// The picture is the rectangle again, up to one motion.
	ASSERT_EQ(at(s.flat.place.size()), mesh.positions.size());
	std::vector<Point2> place(mesh.positions.size());
	for (const int f : s.flat.points.indices())
		for (const Corner c : cornersOf(f))
			place[at(s.flat.vertices[c])] = s.flat.at(c);
	for (std::size_t a = 0; a < place.size(); ++a)
		for (std::size_t b = 0; b < a; ++b)
			EXPECT_NEAR(
				distance(place[a], place[b]),
				distance(mesh.positions[a], mesh.positions[b]),
				1e-11);
}

/// A ring that goes round by \p turns, over the plane.
SurfaceMesh manyTurns(int around, double turns)
{
	return grid(1, around, Ends::Open, Ends::Open, [=](int i, int j) {
		const double r = 1.0 + i, a = 2 * kPi * turns * j / around;
		return Point3{r * std::cos(a), r * std::sin(a), 0.0};
	});
}

/// Parts of a ring, which begin at these cells.
Array<int> arcs(int around, const std::vector<int>& begins)
{
	Array<int> part;
	for (int j = 0; j < around; ++j)
		for (int k = 0; k < 2; ++k)
			part.push_back(static_cast<int>(
				std::upper_bound(begins.begin(), begins.end(), j) - begins.begin() - 1));
	return part;
}

/// Together the two parts would cover a part of the plane twice.
TEST(JoinParts, LeavesWhatHasNoRoom)
{
	Random random(921);
	Scattered s(manyTurns(24, 1.5), arcs(24, {0, 12}), random);
	const FlatMesh before = s.flat;
	const auto joined = s.join();
	EXPECT_EQ(joined.size(), 2u);
	EXPECT_EQ(s.edgesJoined, 0);
	EXPECT_TRUE(s.flat.corners() == before.corners());
}

/// Two full turns in arcs of 398, 6 and 396 cells. The short one fits to neither of its neighbours as
/// a whole: the first has room for two of its cells, the last for four.
TEST(JoinParts, ACrumbIsDividedAmongItsNeighbours)
{
	Random random(922);
	Scattered s(manyTurns(800, 2.0), arcs(800, {0, 398, 404}), random);
	const auto joined = s.join();
	expectNothingCoveredTwice(s.flat, joined);
	ASSERT_EQ(joined.size(), 2u);
	EXPECT_EQ(joined[0].size(), 800u);
	EXPECT_EQ(joined[1].size(), 800u);
	EXPECT_EQ(s.edgesJoined, 1);
	EXPECT_NEAR(s.lengthJoined, 1.0, 1e-12);
}

/// With three cells more neither has room for all of it, and the crumb stays.
TEST(JoinParts, ACrumbWithoutRoomStays)
{
	Random random(924);
	Scattered s(manyTurns(803, 803.0 / 400.0), arcs(803, {0, 400, 403}), random);
	const auto joined = s.join();
	expectNothingCoveredTwice(s.flat, joined);
	ASSERT_EQ(joined.size(), 3u);
	EXPECT_EQ(joined[1].size(), 6u);
	EXPECT_EQ(s.edgesJoined, 0);
}

/// Each second arc is a sixtieth of the strip or less, has no room as a whole, and both its neighbours have room
/// for a half of it: it is a crumb if it is much smaller than they are.
TEST(JoinParts, AmongManySmallPartsOnlyTheSmallestAreCrumbs)
{
	constexpr int around = 40, pairs = 60;
	for (const bool isCrumb : {true, false}) {
		const int large = isCrumb ? 37 : 30, small = isCrumb ? 6 : 20;
		std::vector<int> begins;
		for (int i = 0; i < pairs; ++i) {
			begins.push_back(i * (large + small));
			begins.push_back(i * (large + small) + large);
		}
		const int cells = pairs * (large + small);
		Random random(925);
		Scattered s(
			manyTurns(cells, static_cast<double>(cells) / around), arcs(cells, begins), random);
		const auto joined = s.join();
		expectNothingCoveredTwice(s.flat, joined);
		if (isCrumb) {
			EXPECT_LT(joined.size(), at(2 * pairs - 5));
			EXPECT_GT(s.edgesJoined, 5);
		}
		else {
			EXPECT_EQ(joined.size(), at(2 * pairs));
			EXPECT_EQ(s.edgesJoined, 0);
		}
	}
}

/// Every cut of a picture into parts is undone, whatever their shapes.
TEST(JoinParts, RandomParts)
{
	Random random(923);
	for (int round = 0; round < 20; ++round) {
		const SurfaceMesh mesh = rectangle(8, 8, 8.0, 8.0);
		// Voronoi cells of a few triangles, as connected parts of the mesh.
		Array<int> part(mesh.triangles.size(), -1);
		const int count = random.index(6) + 2;
		std::vector<Point2> seeds;
		for (int i = 0; i < count; ++i)
			seeds.push_back({random.real(0, 8), random.real(0, 8)});
		for (const int f : part.indices()) {
			const Point2 centre = centreOf(mesh, mesh.triangles[at(f)]);
			part[f] = 0;
			for (int i = 1; i < count; ++i)
				if (distance(centre, seeds[at(i)]) < distance(centre, seeds[at(part[f])]))
					part[f] = i;
		}
		Scattered s(mesh, part, random);
		s.parts.erase(
			std::remove_if(s.parts.begin(), s.parts.end(), [](const auto& p) { return p.empty(); }),
			s.parts.end());
		const auto joined = s.join();
		EXPECT_EQ(joined.size(), 1u) << "round " << round;
		expectNothingCoveredTwice(s.flat, joined);
	}
}

} // namespace
} // namespace ricci::testing
