// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_map.h"
#include "support/flat_meshes.h"
#include "support/listener.h"
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/charts/chart_division.h>
#include <ricci/charts/chart_overlap.h>
#include <ricci/charts/join_parts.h>
#include <ricci/charts/separate_charts.h>
#include <ricci/error.h>
#include <ricci/math/orientation.h>
#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

namespace ricci::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

std::vector<std::vector<int>> divided(const FlatMesh& chart)
{
	return divideChart(chart, OverlapSearch(chart.corners()));
}

/// What of a chart's joined edges lies between its parts.
Seams cutsBetween(const std::vector<std::vector<int>>& parts, const FlatMesh& chart)
{
	Array<int> partOf(chart.size(), -1);
	for (std::size_t i = 0; i < parts.size(); ++i)
		for (const int f : parts[i])
			partOf[f] = static_cast<int>(i);
	Seams cuts;
	for (const int f : chart.points.indices())
		for (const Corner side : cornersOf(f))
			if (const Corner other = chart.joined(side);
				other > side && partOf[other.face()] != partOf[f]) {
				cuts.edges.push_back(side);
				cuts.length += chart.lengths[side];
			}
	return cuts;
}

/// A ring between radii 1 and 2 that goes round by \p angle, along a screw in space.
SurfaceMesh sector(double angle, int around, int across)
{
	return grid(across, around, Ends::Open, Ends::Open, [=](int i, int j) {
		const double r = 1.0 + static_cast<double>(i) / across, a = angle * j / around;
		return Point3{r * std::cos(a), r * std::sin(a), 0.3 * a};
	});
}

/// How many triangles contain \p p in their inside.
int covers(const FlatMesh& chart, const Point2& p)
{
	int count = 0;
	for (const Triangle2& c : chart.corners())
		count += orientation(c[0], c[1], p) > 0 && orientation(c[1], c[2], p) > 0 &&
				 orientation(c[2], c[0], p) > 0;
	return count;
}

/// Parts of a divided chart must be free of overlaps and make up the whole.
void expectDivided(const FlatMesh& chart, const std::vector<std::vector<int>>& parts)
{
	std::vector<char> seen(at(chart.size()), 0);
	for (const std::vector<int>& part : parts) {
		for (int i : part) {
			EXPECT_FALSE(seen[at(i)]);
			seen[at(i)] = 1;
		}
		EXPECT_TRUE(overlappingPairs(chart.part(part)).empty());
	}
	EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<long>(seen.size()));
}

TEST(ChartOverlap, OfARingBeginsPastAFullTurn)
{
	for (const double turns : {0.3, 0.9, 0.999, 1.0})
		EXPECT_TRUE(overlappingPairs(flatMesh(sector(2 * kPi * turns, 60, 4))).empty()) << turns;
	for (const double turns : {1.001, 1.1, 1.5, 1.9})
		EXPECT_FALSE(overlappingPairs(flatMesh(sector(2 * kPi * turns, 60, 4))).empty()) << turns;
}

/// Triangles round a vertex that go round it by \p angle, to the distances \p radius(i).
template<class Radius>
SurfaceMesh fan(int n, double angle, const Radius& radius)
{
	SurfaceMesh mesh;
	mesh.positions.push_back({0, 0, 0});
	for (int i = 0; i <= n; ++i) {
		const double a = angle * i / n, r = radius(i);
		mesh.positions.push_back({r * std::cos(a), r * std::sin(a), 0});
		if (i < n)
			mesh.triangles.push_back({0, 1 + i, 2 + i});
	}
	return mesh;
}

/// All triangles of a fan have its apex in common, so that the boxes in a quarter meet in pairs. Those
/// that overlap are few.
TEST(ChartOverlap, OfAFanTakesHardlyMoreStepsThanItHasTriangles)
{
	Random random(403);
	std::vector<double> radii(16001);
	for (double& r : radii)
		r = random.real(0.1, 1.0);
	const auto round = [](int) { return 1.0; };
	const auto star = [&](int i) { return radii[at(i)]; };
	for (int kind = 0; kind < 4; ++kind) {
		std::array<double, 2> steps{};
		for (const int n : {4000, 16000}) {
			SurfaceMesh mesh = kind % 2 == 0 ? fan(n, 7.0, round) : fan(n, 7.0, star);
			if (kind > 1) // a triangle is flipped
				std::swap(mesh.triangles[at(n / 3)][1], mesh.triangles[at(n / 3)][2]);
			const FlatMesh chart = flatMesh(mesh);
			const OverlapSearch search(chart.corners());
			EXPECT_EQ(OverlapSearch(chart).pairs(), search.pairs()) << kind;
			// 7 - 2 pi of the angle is covered twice, where each triangle meets two others.
			const double twice = n * (1.0 - 2 * kPi / 7.0);
			EXPECT_NEAR(static_cast<double>(search.pairs().size()), 2 * twice, 4.0) << kind;
			steps[n == 4000 ? 0 : 1] = static_cast<double>(search.steps());
		}
		EXPECT_LT(steps[1], (kind % 2 == 0 ? 5.0 : 8.0) * steps[0]) << kind; // n^2: 16 times
	}
}

/// With the outlines of nodes, from which on none are compared.
TEST(ChartOverlap, OfFansIsWhatAllPairsGive)
{
	Random random(404);
	for (const double angle : {3.0, 6.2, 7.0, 20.0, 100.0}) {
		SurfaceMesh mesh = fan(700, angle, [&](int) { return random.real(0.05, 1.0); });
		const SurfaceMesh other = fan(300, 6.0, [&](int) { return random.real(0.05, 1.0); });
		const bool isStacked = angle > 50.0;
		mesh = sideBySide(mesh, other, isStacked ? 0.3 : 1.8);
		const FlatMesh chart = flatMesh(mesh);
		const double touching = 1e-9 * boxTreeOf(chart.corners()).extent();
		std::vector<TrianglePair> pairs;
		Array<char> isIn(chart.size(), 0);
		for (const int i : chart.points.indices())
			for (const int j : chart.points.indices())
				if (i < j && overlap(chart.at(i), chart.at(j), touching)) {
					pairs.push_back({i, j});
					isIn[i] = isIn[j] = 1;
				}
		const OverlapSearch search(chart.corners());
		EXPECT_EQ(search.isComplete(), !isStacked);
		EXPECT_EQ(search.overlapping(), isIn) << angle;
		if (!isStacked) {
			EXPECT_GT(search.steps(), 64 * chart.size());
			EXPECT_EQ(search.pairs(), pairs) << angle;
		}
		else {
			ASSERT_EQ(search.pairs().size(), 1u);
			EXPECT_EQ(std::count(pairs.begin(), pairs.end(), search.pairs().front()), 1);
			EXPECT_GT(pairs.size(), at(chart.size()));
		}
	}
}

/// Sheets of a screw, some of them with moved points so that the triangles are of many shapes and none is flipped.
/// What lies over itself far from the border is found by way of what lies between.
TEST(ChartOverlap, FollowedFromTheBorderIsWhatAllTrianglesGive)
{
	Random random(405);
	for (const double turns : {0.9, 1.02, 1.4, 2.7})
		for (const double wobble : {0.0, 0.3}) {
			const int around = static_cast<int>(200 * turns), across = 40;
			FlatMesh chart = flatMesh(sector(2 * kPi * turns, around, across));
			for (Point2& p : chart.place)
				for (double& x : p)
					x += wobble * random.real(-1.0, 1.0) / around;
			const OverlapSearch all(chart.corners()), followed(chart);
			EXPECT_EQ(followed.pairs(), all.pairs()) << turns;
			EXPECT_EQ(all.pairs().empty(), turns < 1.0) << turns;
			EXPECT_TRUE(followed.isComplete());
			// That all are not compared shows where few of them overlap.
			if (turns < 1.1) {
				EXPECT_LT(2 * followed.steps(), all.steps()) << turns;
			}
		}
}

TEST(ChartOverlap, ManySheetsThatOnlyTouchAreNotFollowedThroughAllTheirPairs)
{
	const int turns = 40, around = 50 * turns, across = 20;
	const SurfaceMesh strip = sector(2 * kPi * turns, around, across);
	// A corner is so far away that all sheets lie within the rounding of the chart.
	const FlatMesh chart =
		flatMesh(strip, static_cast<int>(strip.positions.size()) - 1, {1e12, 1e12});
	const OverlapSearch followed(chart);
	EXPECT_TRUE(followed.pairs().empty());
	EXPECT_TRUE(followed.isComplete());
	EXPECT_LT(followed.steps(), 250 * chart.size());
}

TEST(ChartOverlap, ALongSearchIsHeardAndCanBeEnded)
{
	const SurfaceMesh mesh = fan(60000, 2 * kPi, [](int) { return 1.0; });
	const FlatMesh chart = flatMesh(mesh);
	Listener ticks;
	EXPECT_TRUE(heard(ticks, [&] { return overlappingPairs(chart); }).empty());
	EXPECT_GE(ticks.calls(), 3);
	Listener impatient(2);
	EXPECT_THROW(heard(impatient, [&] { overlappingPairs(chart); }), Cancelled);
	EXPECT_EQ(impatient.calls(), 2);
}

/// Area that two counter-clockwise triangles have in common.
double commonArea(const Triangle2& a, const Triangle2& b)
{
	std::vector<Point2> part(a.begin(), a.end());
	for (std::size_t k = 0; k < 3; ++k) {
		const Point2 &p = b[k], &q = b[(k + 1) % 3];
		std::vector<Point2> next;
		for (std::size_t i = 0; i < part.size(); ++i) {
			const Point2 &x = part[i], &y = part[(i + 1) % part.size()];
			const double u = (q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0]);
			const double v = (q[0] - p[0]) * (y[1] - p[1]) - (q[1] - p[1]) * (y[0] - p[0]);
			if (u >= 0)
				next.push_back(x);
			if (u * v < 0)
				next.push_back(
					{x[0] + u / (u - v) * (y[0] - x[0]), x[1] + u / (u - v) * (y[1] - x[1])});
		}
		part = next;
	}
	double area = 0.0;
	for (std::size_t i = 0; i < part.size(); ++i) {
		const Point2 &x = part[i], &y = part[(i + 1) % part.size()];
		area += 0.5 * (x[0] * y[1] - x[1] * y[0]);
	}
	return area;
}

TEST(ChartOverlap, NamesExactlyThePairsWithCommonArea)
{
	for (const double turns : {0.8, 1.4, 2.7}) {
		const FlatMesh chart = flatMesh(sector(2 * kPi * turns, 50, 5));
		const auto pairs = overlappingPairs(chart);
		const std::set<TrianglePair> known(pairs.begin(), pairs.end());
		EXPECT_EQ(known.size(), pairs.size());
		for (int i = 0; i < chart.size(); ++i)
			for (int j = i + 1; j < chart.size(); ++j) {
				const double area = commonArea(chart.at(i), chart.at(j));
				if (area > 1e-12 || area < 1e-15) { // between: the width of a touch
					EXPECT_EQ(known.count({i, j}), area > 1e-12 ? 1u : 0u);
				}
			}
	}
}

TEST(ChartOverlap, TouchingIsNone)
{
	// Two sides of a slit from the centre of a square, which are different vertices at one place.
	SurfaceMesh slit = rectangle(4, 4, 1.0, 1.0);
	const int middle = 2 * 5 + 2; // vertices of the slit: (2..4, 2), the first one stays whole
	for (int f = 0; f < 32; ++f)
		for (int& v : slit.triangles[at(f)]) {
			const Point3& p = slit.positions[at(v)];
			double low = 1.0;
			for (int w : slit.triangles[at(f)])
				low = std::min(low, slit.positions[at(w)][1]);
			if (p[1] == 0.5 && p[0] > 0.6 && low < 0.5) {
				slit.positions.push_back({p[0], p[1], 0.0});
				v = static_cast<int>(slit.positions.size()) - 1;
			}
		}
	ASSERT_GT(slit.positions.size(), 25u);
	ASSERT_EQ(slit.positions[at(middle)][1], 0.5);
	EXPECT_TRUE(overlappingPairs(flatMesh(slit)).empty());
	// Rounding of the slit's sides is no overlap either, a visible one is.
	for (const double gap : {1e-12, 1e-3}) {
		SurfaceMesh closed = slit;
		for (std::size_t v = 25; v < closed.positions.size(); ++v)
			closed.positions[v][1] += gap;
		EXPECT_EQ(overlappingPairs(flatMesh(closed)).empty(), gap < 1e-9);
	}
	// Squares that meet in a corner, and along half a side.
	const SurfaceMesh square = rectangle(1, 1, 1.0, 1.0);
	for (const Point2& shift : {Point2{1.0, 1.0}, Point2{1.0, 0.5}, Point2{1.0, -1.0}}) {
		SurfaceMesh two = sideBySide(square, square, shift[0]);
		for (std::size_t v = 4; v < 8; ++v)
			two.positions[v][1] += shift[1];
		EXPECT_TRUE(overlappingPairs(flatMesh(two)).empty());
		for (std::size_t v = 4; v < 8; ++v)
			two.positions[v][0] -= 0.25;
		EXPECT_EQ(overlappingPairs(flatMesh(two)).empty(), std::abs(shift[1]) == 1.0);
	}
}

TEST(ChartOverlap, AroundAVertexIsFound)
{
	// The map z -> z^2 winds twice round the centre, z -> z^(1/2) on a slit disk only half.
	for (const double power : {0.5, 1.0, 2.0}) {
		SurfaceMesh disk = grid(3, 24, Ends::Open, Ends::Open, [&](int i, int j) {
			const double r = i / 3.0, a = power * 2 * kPi * j / 24.0;
			return Point3{r * std::cos(a), r * std::sin(a), 0.0};
		});
		const FlatMesh chart = flatMesh(disk);
		std::vector<int> proper;
		for (const int f : chart.points.indices())
			if (orientation(chart.at(f)[0], chart.at(f)[1], chart.at(f)[2]) > 0)
				proper.push_back(f);
		EXPECT_EQ(overlappingPairs(chart.part(proper)).empty(), power <= 1.0);
	}
}

TEST(ChartOverlap, AFoldInsideAChartIsNone)
{
	// An inner vertex is pulled across the opposite side of one of its triangles.
	SurfaceMesh mesh = rectangle(6, 6, 6.0, 6.0);
	mesh.positions[at(3 * 7 + 3)] = {4.4, 4.1, 0.0};
	const FlatMesh folded = flatMesh(mesh);
	int turned = 0, twice = 0;
	for (const auto& c : folded.corners())
		turned += orientation(c[0], c[1], c[2]) < 0;
	ASSERT_GT(turned, 0);
	Random random(402);
	for (int trial = 0; trial < 2000; ++trial)
		twice += covers(folded, {random.real(3, 5), random.real(3, 5)}) > 1;
	ASSERT_GT(twice, 0);
	EXPECT_TRUE(overlappingPairs(folded).empty());
	// The same fold in a chart that does cover itself changes nothing there.
	SurfaceMesh ring = sector(2 * kPi * 1.4, 60, 6);
	const std::size_t plain = overlappingPairs(flatMesh(ring)).size();
	const int inner = 30 * 7 + 3; // on the opposite side of the ring
	ring.positions[at(inner)] = {
		1.3 * ring.positions[at(inner)][0], 1.3 * ring.positions[at(inner)][1], 0.0};
	EXPECT_NEAR(
		static_cast<double>(overlappingPairs(flatMesh(ring)).size()),
		static_cast<double>(plain),
		12.0);
}

TEST(ChartDivision, OfRingsTakesAsManyPartsAsTurns)
{
	for (const double turns : {1.2, 1.7, 2.5, 3.3}) {
		const SurfaceMesh mesh = sector(2 * kPi * turns, static_cast<int>(40 * turns), 3);
		const FlatMesh chart = flatMesh(mesh);
		const auto parts = divided(chart);
		const Seams cuts = cutsBetween(parts, chart);
		expectDivided(chart, parts);
		EXPECT_GE(parts.size(), static_cast<std::size_t>(std::ceil(turns)));
		EXPECT_LE(parts.size(), static_cast<std::size_t>(std::ceil(turns)) + 1);
		EXPECT_EQ(cuts.edges.size(), 3 * (parts.size() - 1)); // each straight across
		EXPECT_GE(cuts.length, static_cast<double>(parts.size() - 1) - 1e-12); // the ring is 1 wide
	}
}

/// A staircase of so many turns that not all pairs are listed.
TEST(ChartDivision, OfManyTurnsTakesHardlyMoreStepsThanItHasTriangles)
{
	double before = 0.0;
	for (const int turns : {40, 160}) {
		FlatMesh chart = flatMesh(sector(2 * kPi * turns, 20 * turns, 2));
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

TEST(ChartDivision, CutsWhereItIsShortest)
{
	// Two turns that are joined by a narrow neck opposite to the place where they meet.
	const int around = 80, across = 6;
	SurfaceMesh mesh = sector(2 * kPi * 1.25, around, across), neck;
	neck.positions = mesh.positions;
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
		const int cell = static_cast<int>(f / 2), i = cell / around, j = cell % around;
		if (j != around / 2 || i == 0)
			neck.triangles.push_back(mesh.triangles[f]);
	}
	const FlatMesh chart = flatMesh(neck);
	const auto parts = divided(chart);
	const Seams cuts = cutsBetween(parts, chart);
	expectDivided(chart, parts);
	ASSERT_EQ(parts.size(), 2u);
	EXPECT_EQ(cuts.edges.size(), 1u);
	EXPECT_NEAR(cuts.length, 1.0 / across, 1e-12);
	EXPECT_NEAR(
		static_cast<double>(parts[0].size()) / static_cast<double>(parts[1].size()), 1.0, 0.05);
}

TEST(ChartDivision, LeavesAChartWithoutOverlapWhole)
{
	const SurfaceMesh mesh = sector(kPi, 20, 3);
	const FlatMesh chart = flatMesh(mesh);
	const auto parts = divided(chart);
	ASSERT_EQ(parts.size(), 1u);
	EXPECT_EQ(parts[0].size(), mesh.triangles.size());
}

/// Two corners of a square of 2 x 2 cells are drawn elsewhere, so that a face is flipped. It hides
/// an overlap of other faces until a cut takes it away from them.
TEST(SeparateCharts, FindsInAPartWhatAFoldHidInTheWhole)
{
	const SurfaceMesh square = rectangle(2, 2, 2.0, 2.0);
	SurfaceMesh picture = square;
	picture.positions[0] = {0, 3, 0};
	picture.positions[1] = {3, 0, 0};
	Parametrization map = mapWith(flatMesh(square, flatMesh(picture).corners().values()));
	separateCharts(true, map);
	for (const std::vector<int>& chart : map.mesh.trianglesByChart(map.charts.size()))
		for (const int f : chart)
			for (const int g : chart)
				if (f < g) { // none of them is flipped
					EXPECT_LT(commonArea(map.mesh.at(f), map.mesh.at(g)), 1e-12)
						<< f << " and " << g;
				}
	// The cuts are those between the charts: each is one unit long, or a diagonal.
	EXPECT_EQ(map.report.overlapCuts, 3);
	EXPECT_EQ(map.charts.size(), 3u);
	EXPECT_EQ(map.report.charts, 3);
}

TEST(SeparateCharts, OfAScrewSurfaceCoverNothingTwice)
{
	const SurfaceMesh mesh = sector(2 * kPi * 1.6, 70, 5);
	for (const OutputTriangulation output :
		 {OutputTriangulation::KeepMesh, OutputTriangulation::CommonRefinement}) {
		Options options;
		options.output = output;
		options.charts = Charts::OfTheFlow;
		const FlatResult whole = run(mesh, options);
		EXPECT_EQ(whole.charts.size(), 1u);
		EXPECT_GT(overlapsIn(whole.mesh), 0u);
		const Parametrization packed = parametrizeEuclidean(mesh, {}, options);
		EXPECT_EQ(packed.report.overlappingCharts, 1);
		EXPECT_GT(packed.report.overlappingFaces, 0);
		options.charts = Charts::WithoutOverlap;
		const FlatResult flat = run(mesh, options);
		EXPECT_EQ(overlapsIn(flat.mesh), 0u);
		EXPECT_EQ(parametrizeEuclidean(mesh, {}, options).report.overlappingFaces, 0);
		EXPECT_GT(flat.report.overlapCuts, 0);
		EXPECT_EQ(flat.charts.size(), 2u);
		EXPECT_NEAR(flat.report.qcAreaMean, whole.report.qcAreaMean, 1e-12); // charts have moved
		for (const std::vector<int>& chart : flat.mesh.trianglesByChart(2)) {
			const FlatMesh own = flat.mesh.part(chart);
			Box2 box;
			for (const Point2& p : own.place)
				box.add(p);
			EXPECT_TRUE(overlappingPairs(own).empty());
			EXPECT_NEAR(box.min[0], 0.0, 1e-12);
			EXPECT_NEAR(box.min[1], 0.0, 1e-12);
		}
		EXPECT_EQ(
			at(flat.mesh.size()),
			output == OutputTriangulation::KeepMesh ? mesh.triangles.size()
													: at(whole.mesh.size()));
	}
}

} // namespace
} // namespace ricci::testing
