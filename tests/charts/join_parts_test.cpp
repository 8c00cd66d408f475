// SPDX-License-Identifier: GPL-3.0-or-later
// How charts are divided, and parts joined. chart_division_test.cpp has what becomes of whole maps.
#include "support/flat_meshes.h"
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/charts/chart_overlap.h>
#include <ricci/charts/dual_graph.h>
#include <ricci/charts/separate_charts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace ricci::testing {
namespace {

using Parts = std::vector<std::vector<int>>;

/// Parts of a divided chart must be free of overlaps and make up the whole.
void expectDivided(const FlatMesh& chart, const Parts& parts)
{
	std::vector<int> all;
	for (const std::vector<int>& part : parts) {
		all.insert(all.end(), part.begin(), part.end());
		EXPECT_TRUE(OverlapSearch(chart.part(part)).pairs().empty());
	}
	std::sort(all.begin(), all.end());
	std::vector<int> wanted(at(chart.size()));
	std::iota(wanted.begin(), wanted.end(), 0);
	EXPECT_EQ(all, wanted);
}

/// A staircase of so many turns that not all pairs are listed.
TEST(ChartDivision, OfManyTurnsTakesHardlyMoreStepsThanItHasTriangles)
{
	double before = 0.0;
	for (const int turns : {40, 160}) {
		FlatMesh chart = flatMesh(screw(turns, 20 * turns, 2));
		const OverlapSearch overlaps(chart.corners());
		EXPECT_FALSE(overlaps.isComplete());
		EXPECT_EQ(overlaps.pairs().size(), 1u);
		EXPECT_LT(overlaps.steps(), chart.size()); // the areas tell that there are too many
		const Array<char> isIn = overlaps.overlapping();
		EXPECT_EQ(std::count(isIn.begin(), isIn.end(), 0), 0);
		const auto steps = static_cast<double>(overlaps.steps());
		if (before > 0.0) {
			EXPECT_LT(steps, 5.0 * before); // of all pairs: 16 times
		}
		before = steps;
		const auto parts = divideChart(chart, overlaps);
		expectDivided(chart, parts);
		EXPECT_GE(parts.size(), at(turns));
		const auto joined = joinParts(chart, parts);
		expectDivided(chart, joined);
		EXPECT_GE(joined.size(), at(turns));
		EXPECT_LE(joined.size(), at(turns + turns / 4));
	}
}

/// The least cut round a sheet that is far from what it covers is looked for near them: where the waist of the strip
/// between both is there, it is as cheap as that of the whole chart.
TEST(ChartDivision, NearASheetThereIsNoDearerCutThanInTheWholeChart)
{
	Random random(923);
	const int around = 1000, across = 6, sheet = around / 11; // columns that are covered twice
	for (const int waist : {sheet + 20, around - sheet - 20}) {
		SurfaceMesh strip = screw(1.1, around, across);
		for (int j = 0; j <= around; ++j) {
			const double width = std::abs(j - waist) < 3 ? 0.3 : random.real(0.5, 1.0);
			for (int i = 0; i <= across; ++i) {
				Point3& p = strip.positions[at(i * (around + 1) + j)];
				const double r = length(p);
				p = (1.0 + (r - 1.0) * width) / r * p;
			}
		}
		const FlatMesh chart = flatMesh(strip);
		const OverlapSearch overlaps(chart.corners());
		std::vector<int> ends[2]; // what lies over itself, by its column
		const Array<char> isIn = overlaps.overlapping();
		for (const int f : isIn.indices())
			if (isIn[f])
				ends[f / 2 % around < around / 2 ? 0 : 1].push_back(f);
		DualGraph whole(chart), divided(chart);
		whole.part = leastCut(whole, ends[0], ends[1]);
		const Parts parts = divideChart(chart, overlaps);
		ASSERT_EQ(parts.size(), 2u);
		for (const int f : parts[1])
			divided.part[f] = 1;
		const auto priceOf = [&](const DualGraph& graph) {
			std::int64_t price = 0;
			for (const int f : chart.points.indices())
				for (const Corner side : cornersOf(f))
					if (graph.joined(side).isValid() && !graph.neighbour(side).isValid())
						price += graph.weight(side);
			return price;
		};
		EXPECT_GT(priceOf(whole), 0);
		EXPECT_LE(priceOf(divided), priceOf(whole));
	}
}

/// A mesh over the plane, of which each part lies elsewhere.
struct Scattered
{
	FlatMesh flat;
	Parts parts;
	int edgesJoined = 0;
	double lengthJoined = 0.0;

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
		parts.erase(
			std::remove_if(parts.begin(), parts.end(), [](const auto& p) { return p.empty(); }),
			parts.end());
		flat = flatMesh(mesh, plane);
	}

	Parts join()
	{
		const EdgeSet before = seams(flat);
		Parts joined = joinParts(flat, parts);
		const EdgeSet after = seams(flat);
		edgesJoined = static_cast<int>(before.sides.size() - after.sides.size());
		lengthJoined = before.length - after.length;
		expectDivided(flat, joined);
		return joined;
	}
};

Point2 centreOf(const SurfaceMesh& mesh, const Triangle& t)
{
	Point2 centre{0, 0};
	for (const int v : t)
		for (std::size_t k = 0; k < 2; ++k)
			centre[k] += mesh.positions[at(v)][k] / 3;
	return centre;
}

/// In blocks of two by two, or Voronoi cells of a few triangles: every cut of a picture into connected parts is
/// undone, whatever their shapes.
TEST(JoinParts, PutsAPictureTogether)
{
	Random random(920);
	for (int round = 0; round < 20; ++round) {
		const SurfaceMesh mesh = rectangle(8, 8, 8.0, 8.0);
		std::vector<Point2> seeds;
		for (int i = 0; i < (round == 0 ? 16 : random.index(6) + 2); ++i)
			seeds.push_back(
				round == 0 ? Point2{2.0 * (i % 4) + 1, 2.0 * (i / 4) + 1}
						   : Point2{random.real(0, 8), random.real(0, 8)});
		Array<int> part;
		for (const Triangle& t : mesh.triangles) {
			const Point2 centre = centreOf(mesh, t);
			const auto nearest =
				std::min_element(seeds.begin(), seeds.end(), [&](auto& a, auto& b) {
					return distance(centre, a) < distance(centre, b);
				});
			part.push_back(static_cast<int>(nearest - seeds.begin()));
		}
		Scattered s(mesh, part, random);
		EXPECT_EQ(s.join().size(), 1u) << "round " << round;
		if (round == 0) { // six lines of 8 edges of length 1 between the blocks
			EXPECT_EQ(s.edgesJoined, 48);
			EXPECT_NEAR(s.lengthJoined, 48.0, 1e-12);
		}
		// The picture is the square again, up to one motion.
		ASSERT_EQ(at(s.flat.place.size()), mesh.positions.size());
		std::vector<Point2> place(mesh.positions.size());
		for (int c = 0; c < 3 * s.flat.size(); ++c)
			place[at(s.flat.vertices[Corner(c)])] = s.flat.at(Corner(c));
		for (std::size_t a = 0; a < place.size(); ++a)
			for (std::size_t b = 0; b < a; ++b)
				EXPECT_NEAR(
					distance(place[a], place[b]),
					distance(mesh.positions[a], mesh.positions[b]),
					1e-11);
	}
}

/// Parts of a ring of \p turns, one cell wide, which begin at these cells.
Scattered arcs(int around, double turns, const std::vector<int>& begins, Random& random)
{
	Array<int> part;
	for (int j = 0; j < around; ++j)
		for (int k = 0; k < 2; ++k)
			part.push_back(static_cast<int>(
				std::upper_bound(begins.begin(), begins.end(), j) - begins.begin() - 1));
	return {screw(turns, around, 1), part, random};
}

TEST(JoinParts, LeavesWhatHasNoRoomAndDividesCrumbs)
{
	Random random(921);
	// Together the two parts would cover a part of the plane twice.
	Scattered two = arcs(24, 1.5, {0, 12}, random);
	const Array<Triangle2> before = two.flat.corners();
	EXPECT_EQ(two.join().size(), 2u);
	EXPECT_EQ(two.edgesJoined, 0);
	EXPECT_EQ(two.flat.corners(), before);
	// Two full turns in arcs of 398, 6 and 396 cells. The short one fits to neither of its neighbours as
	// a whole: the first has room for two of its cells, the last for four.
	Scattered crumb = arcs(800, 2.0, {0, 398, 404}, random);
	const Parts joined = crumb.join();
	ASSERT_EQ(joined.size(), 2u);
	EXPECT_EQ(joined[0].size(), 800u);
	EXPECT_EQ(joined[1].size(), 800u);
	EXPECT_EQ(crumb.edgesJoined, 1);
	EXPECT_NEAR(crumb.lengthJoined, 1.0, 1e-12);
	// With three cells more neither has room for all of it, and the crumb stays.
	Scattered stays = arcs(803, 803.0 / 400.0, {0, 400, 403}, random);
	const Parts left = stays.join();
	ASSERT_EQ(left.size(), 3u);
	EXPECT_EQ(left[1].size(), 6u);
	EXPECT_EQ(stays.edgesJoined, 0);
}

/// The flat faces of \p mesh, whose normals are axes: each a part that lies elsewhere.
Parts flatFaces(const SurfaceMesh& mesh, Random& random, std::vector<Triangle2>& plane)
{
	Parts parts;
	std::vector<Point3> normals;
	const auto numberOf = [&](int f) {
		return std::find_if(parts.begin(), parts.end(), [&](const std::vector<int>& part) {
			return std::any_of(part.begin(), part.end(), [&](int g) {
				const Triangle &s = mesh.triangles[at(f)], &t = mesh.triangles[at(g)];
				const auto isCommon = [&](int v) { return std::count(t.begin(), t.end(), v) > 0; };
				return normals[at(f)] == normals[at(g)] &&
					   std::count_if(s.begin(), s.end(), isCommon) == 2;
			});
		});
	};
	for (const Triangle& t : mesh.triangles) {
		const auto corner = [&](std::size_t k) { return mesh.positions[at(t[k])]; };
		const Point3 n = cross(corner(1) - corner(0), corner(2) - corner(0)),
					 normal = n / length(n);
		const Point3 u = std::abs(normal[0]) < 0.5 ? Point3{1, 0, 0} : Point3{0, 1, 0};
		const Point3 v = cross(normal, u);
		normals.push_back(normal);
		plane.emplace_back();
		for (std::size_t k = 0; k < 3; ++k)
			plane.back()[k] = {dot(corner(k), u), dot(corner(k), v)};
		const int f = static_cast<int>(plane.size()) - 1;
		std::vector<int> own{f};
		for (auto other = numberOf(f); other != parts.end(); other = numberOf(f)) {
			own.insert(own.end(), other->begin(), other->end());
			parts.erase(other);
		}
		parts.push_back(own);
	}
	for (const std::vector<int>& part : parts) {
		const Motion motion{
			std::polar(1.0, random.real(0, 2 * kPi)), {random.real(-20, 20), random.real(-20, 20)}};
		for (const int f : part)
			plane[at(f)] = motion(plane[at(f)]);
	}
	return parts;
}

/// The walls of the holes in slabs are crumbs where there are many holes. Joined as wholes, the faces of a slab of any
/// genus keep 11 of 20 of their seams; a crumb that finds room beside others only where those give way leaves no more.
TEST(JoinParts, CrumbsLengthenNoSeams)
{
	Random random(922);
	for (int genus = 4; genus < 30; ++genus) {
		const SurfaceMesh mesh = perforatedSlab(genus, 1);
		std::vector<Triangle2> plane;
		Parts faces = flatFaces(mesh, random, plane);
		for (std::size_t i = faces.size() - 1; i > 0; --i)
			std::swap(faces[i], faces[at(random.index(static_cast<int>(i) + 1))]);
		EXPECT_EQ(faces.size(), at(4 * genus + 6));
		FlatMesh flat = flatMesh(mesh, plane);
		const double before = seams(flat).length;
		const Parts joined = joinParts(flat, faces);
		EXPECT_LE(seams(flat).length, (0.55 + 1e-9) * before);
		expectDivided(flat, joined);
	}
}

/// Of random graphs all pieces with one of the starts are returned but one, which is none of the smaller.
TEST(ConnectedPieces, AreTheSmallerOnesWithAStart)
{
	Random random(1210);
	int several = 0;
	for (int trial = 0; trial < 2000; ++trial) {
		const int n = 1 + random.index(40);
		Parts neighbours(at(n));
		DisjointSets sets(n);
		for (int i = random.index(n + 1); i > 0; --i) {
			const int a = random.index(n), b = random.index(n);
			neighbours[at(a)].push_back(b);
			neighbours[at(b)].push_back(a);
			sets.merge(a, b);
		}
		std::vector<int> starts;
		std::map<int, std::vector<int>> wanted; // by root
		for (int i = random.index(n + 1); i > 0; --i) {
			starts.push_back(random.index(n));
			wanted[sets.find(starts.back())];
		}
		for (int i = 0; i < n; ++i)
			if (const auto piece = wanted.find(sets.find(i)); piece != wanted.end())
				piece->second.push_back(i);
		Array<int> scratch(n, -1);
		Parts found = smallerPieces(
			starts,
			[&](int i, const auto& visit) {
				for (const int j : neighbours[at(i)])
					visit(j);
			},
			scratch);
		EXPECT_EQ(std::count(scratch.begin(), scratch.end(), -1), n);
		std::size_t largestFound = 0;
		for (std::vector<int>& piece : found) {
			std::sort(piece.begin(), piece.end());
			const auto known = wanted.find(sets.find(piece.front()));
			ASSERT_NE(known, wanted.end());
			EXPECT_EQ(piece, known->second);
			largestFound = std::max(largestFound, piece.size());
			wanted.erase(known);
		}
		ASSERT_EQ(wanted.size(), starts.empty() ? 0u : 1u);
		if (!starts.empty()) {
			EXPECT_GE(wanted.begin()->second.size(), largestFound);
		}
		several += found.size() > 1;
	}
	EXPECT_GT(several, 300);
}

} // namespace
} // namespace ricci::testing
