// SPDX-License-Identifier: GPL-3.0-or-later
// Charts as texture coordinates: where they lie, how far apart, and what they leave free. Pieces of the plane are
// their own charts.
#include "support/expect.h"
#include "support/flat_map.h"
#include "support/random_surface.h"

#include <ricci/charts/separate_charts.h>
#include <ricci/error.h>
#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

/// Pieces over the plane as one mesh, one above the other.
SurfaceMesh together(const std::vector<SurfaceMesh>& pieces)
{
	SurfaceMesh all;
	for (SurfaceMesh piece : pieces) {
		for (Point3& p : piece.positions)
			p[2] = 0.01 * static_cast<double>(all.triangles.size());
		all = sideBySide(all, piece, 0.0);
	}
	return all;
}

SurfaceMesh boxes(const std::vector<Point2>& sizes)
{
	std::vector<SurfaceMesh> pieces;
	for (const auto& [x, y] : sizes)
		pieces.push_back(rectangle(1, 1, x, y));
	return together(pieces);
}

/// Fans of triangles, the next one smaller than the last.
SurfaceMesh stars(int n, double orders, Random& random)
{
	std::vector<SurfaceMesh> pieces;
	for (int i = 0; i < n; ++i) {
		const int corners = 3 + random.index(9);
		const double size = std::pow(10.0, -orders * i / n);
		SurfaceMesh star;
		star.positions.push_back({0, 0, 0});
		for (int k = 0; k < corners; ++k) {
			const double angle = 2 * kPi * k / corners, r = size * random.real(0.2, 1.0);
			star.positions.push_back({r * std::cos(angle), r * std::sin(angle), 0});
			star.triangles.push_back({0, 1 + k, 1 + (k + 1) % corners});
		}
		pieces.push_back(star);
	}
	return together(pieces);
}

Options packing(double margin, bool normalize = true)
{
	Options options;
	options.charts = Charts::OfTheFlow;
	options.holes = Holes::Boundaries;
	options.chartMargin = margin;
	options.normalizeUV = normalize;
	return options;
}

/// Least distance of two sides of the borders of different charts, and of all points from the border of the square
/// in which their chart lies.
double leastDistance(const Parametrization& map)
{
	FlatMesh mesh = map.mesh;
	connect(mesh);
	struct Side
	{
		int chart;
		Point2 from, to;
		Box2 box;
	};
	std::vector<Side> sides;
	double least = 1.0;
	for (const int f : mesh.points.indices())
		for (const Corner c : cornersOf(f)) {
			const auto [from, to] = mesh.ends(c);
			const Point2 middle = map.charts[at(mesh.chart[f])].box.centre();
			for (std::size_t k = 0; k < 2; ++k) {
				const double x = from[k] - std::floor(middle[k]);
				least = std::min({least, x, 1.0 - x});
			}
			if (mesh.joined(c).isValid())
				continue;
			sides.push_back({mesh.chart[f], from, to, {}});
			sides.back().box.add(from);
			sides.back().box.add(to);
		}
	for (const Side& s : sides)
		for (const Side& t : sides) {
			if (s.chart == t.chart)
				continue;
			double apart = 0.0; // of their boxes
			for (std::size_t k = 0; k < 2; ++k)
				apart = std::max({apart, s.box.min[k] - t.box.max[k], t.box.min[k] - s.box.max[k]});
			if (apart >= least)
				continue;
			const double share = nearestOnSegment(s.from, s.to, t.from);
			least = std::min(least, distance(t.from, between(s.from, s.to, share)));
		}
	return least;
}

/// Nothing lies on anything else, and charts lie in their boxes; all are similar to the pieces with one scale, which
/// is returned.
double expectPacked(const SurfaceMesh& mesh, const Parametrization& map, std::size_t charts)
{
	EXPECT_EQ(map.charts.size(), charts);
	EXPECT_EQ(map.report.overlappingFaces, 0);
	const CoveredTwice covered(mesh, map.mesh.corners().values());
	EXPECT_EQ(covered.charts, static_cast<int>(charts));
	EXPECT_EQ(covered.betweenCharts + covered.withinCharts, 0);
	const Triangle2 first = map.mesh.at(0);
	const double scale = sideLength(first, 0) / sideLength(mesh, 0, 0);
	double area = 0.0;
	for (const int f : map.mesh.points.indices()) {
		const Triangle2 t = map.mesh.at(f);
		area += 0.5 * doubledArea(t[0], t[1], t[2]);
		for (std::size_t k = 0; k < 3; ++k) {
			EXPECT_NEAR(sideLength(t, k), scale * sideLength(mesh, at(f), k), 1e-7 * scale);
			EXPECT_TRUE(map.charts[at(map.mesh.chart[f])].box.contains(t[k]));
		}
	}
	Box2 whole;
	for (const Chart& chart : map.charts)
		whole.add(chart.box);
	const double side = whole.extent();
	if (map.report.tiles > 1 || (whole.max[0] <= 1.0 && whole.max[1] <= 1.0)) {
		EXPECT_NEAR(map.report.occupancy, area / map.report.tiles, 1e-9);
	}
	else {
		EXPECT_LE(map.report.occupancy, area / (side * side) * (1.0 + 1e-9));
	}
	return scale;
}

TEST(Packing, KeepsTheMarginBetweenOutlinesInTheUnitSquare)
{
	Random random(372);
	for (int n : {1, 2, 5, 30, 100})
		for (double margin : {0.0, 0.0001, 0.002, 0.01}) {
			SCOPED_TRACE(std::to_string(n) + " charts with the margin " + std::to_string(margin));
			const SurfaceMesh mesh = stars(n, 1.5, random);
			const Parametrization map = parametrizeEuclidean(mesh, {}, packing(margin));
			expectPacked(mesh, map, at(n));
			EXPECT_GE(leastDistance(map), margin - 1e-7);
			Box2 whole;
			for (const Point2& p : map.mesh.place)
				whole.add(p);
			if (n < 30) {
				EXPECT_NEAR(whole.extent(), 1.0 - 2.0 * margin, 1e-5); // no smaller than it must
			}
			if (n == 30 && margin < 0.005) { // some of many fit between others
				EXPECT_GT(map.report.occupancy, 0.35);
			}
		}
}

/// Half a ring, which leaves most of its box free.
SurfaceMesh arch(double size)
{
	SurfaceMesh half = rectangle(8, 1, kPi, 1.0);
	for (Point3& p : half.positions) {
		const double r = size * (2.0 - p[1]);
		p = {r * std::cos(p[0]), r * std::sin(p[0]), 0.0};
	}
	return half;
}

/// Many small charts fill what few do, by their outlines too.
TEST(Packing, FillsAsMuchWithManyChartsAsWithFew)
{
	for (const double least : {1.0, 0.3}) {
		SCOPED_TRACE("sizes from " + std::to_string(least));
		Random random(393);
		std::vector<SurfaceMesh> pieces;
		double ofFew = 0.0;
		for (const int n : {150, 600, 2000}) {
			while (pieces.size() < at(n))
				pieces.push_back(arch(random.real(least, 1.0)));
			const SurfaceMesh mesh = together(pieces);
			const Parametrization map = parametrizeEuclidean(mesh, {}, packing(0.0));
			if (n == 150)
				ofFew = map.report.occupancy;
			EXPECT_GT(map.report.occupancy, ofFew - 0.02) << n;
			if (n == 600) {
				const Parametrization apart = parametrizeEuclidean(mesh, {}, packing(0.001));
				expectPacked(mesh, apart, at(n));
				EXPECT_GE(leastDistance(apart), 0.001 - 1e-7);
			}
		}
	}
}

/// The square stays that of the large chart, whose hole or bay the others have all of their room in.
TEST(Packing, UsesHolesAndBaysOfLargeCharts)
{
	for (const auto& [name, large] :
		 {std::pair("hole", ring(0.7, 1.0, 64, 2)), std::pair("bay", arch(0.5))}) {
		SCOPED_TRACE(name);
		const double alone = parametrizeEuclidean(large, {}, packing(0.0)).report.occupancy;
		std::vector<SurfaceMesh> pieces{large};
		for (const double size : {0.4, 0.2, 0.2, 0.05})
			pieces.push_back(rectangle(1, 1, size, size));
		const SurfaceMesh mesh = together(pieces);
		const Parametrization map = parametrizeEuclidean(mesh, {}, packing(0.0));
		expectPacked(mesh, map, pieces.size());
		const double area = areaOf(mesh) / areaOf(large);
		EXPECT_NEAR(map.report.occupancy, alone * area, 0.03 * alone * area);
	}
}

/// The scale stays, and nothing is turned.
TEST(Packing, WithoutTheUnitSquareKeepsTheScale)
{
	Random random(371);
	for (const int n : {1, 2, 3, 10}) {
		std::vector<Point2> sizes;
		for (int i = 0; i < n; ++i)
			sizes.push_back({random.real(0.1, 4.0), random.real(0.1, 4.0)});
		const SurfaceMesh mesh = boxes(sizes);
		Options options = packing(0.05, false);
		options.turns = ChartTurns::None;
		const Parametrization map = parametrizeEuclidean(mesh, {}, options);
		EXPECT_NEAR(expectPacked(mesh, map, at(n)), 1.0, 1e-12);
		Box2 whole;
		for (const Chart& chart : map.charts)
			whole.add(chart.box);
		for (const double x : whole.min)
			EXPECT_NEAR(x / (whole.extent() + 2.0 * x), 0.05, 1e-6);
		for (std::size_t i = 0; i < sizes.size(); ++i) {
			const double longer = std::max(sizes[i][0], sizes[i][1]);
			EXPECT_NEAR(map.charts[i].box.extent(), longer, 1e-9);
		}
	}
}

TEST(Packing, TurnsOneChartIntoTheSmallestSquare)
{
	const auto occupancy = [](double height, TargetCurvature target) {
		Options options = packing(0.0);
		options.target = target;
		return parametrizeEuclidean(rectangle(8, 4, 1.0, height), {}, options).report.occupancy;
	};
	// At half a right angle; no turn makes the square of the wide one smaller.
	EXPECT_NEAR(occupancy(0.1, TargetCurvature::Automatic), 0.1 / (0.5 * 1.1 * 1.1), 1e-3);
	EXPECT_NEAR(occupancy(0.5, TargetCurvature::Automatic), 0.5, 1e-9);
	EXPECT_NEAR(occupancy(0.1, TargetCurvature::Rectangle), 0.1, 1e-6);
}

TEST(Packing, PutsManySmallChartsIntoOneBox)
{
	std::vector<Point2> sizes(1000, {0.01, 0.01});
	for (const Point2& size : {Point2{1.0, 0.2}, Point2{0.2, 1.0}, Point2{0.5, 0.5}})
		sizes.push_back(size);
	const SurfaceMesh mesh = boxes(sizes);
	const Parametrization map = parametrizeEuclidean(mesh, {}, packing(0.001));
	expectPacked(mesh, map, sizes.size());
	EXPECT_GE(leastDistance(map), 0.001 - 1e-7);
	EXPECT_GT(map.report.occupancy, 0.4);
}

/// In squares of seven columns there are eight margins, which leave room for charts where all are less than 1.
TEST(Packing, HalvesMarginsThatLeaveNoRoom)
{
	const SurfaceMesh mesh = boxes(std::vector<Point2>(40, Point2{1.0, 1.0}));
	for (const auto& [asked, margin] :
		 {std::pair(0.25, 0.0625), std::pair(0.13, 0.065), std::pair(0.1, 0.1)}) {
		const Parametrization map = parametrizeEuclidean(mesh, {}, packing(asked));
		EXPECT_EQ(map.report.margin, margin);
		EXPECT_GE(leastDistance(map), margin - 1e-7);
		EXPECT_EQ(map.report.charts, 40);
	}
}

Parametrization cutForPacking(const SurfaceMesh& mesh, double margin, bool normalize = true)
{
	Options options = packing(margin, normalize);
	options.charts = Charts::CutForPacking;
	return parametrizeEuclidean(mesh, {}, options);
}

/// A strip of 20 by 2 is cut across, by edges of length 1; what fills its square is left whole, and what the margin
/// has no room for in two.
TEST(Packing, CutsChartsForPackingWhereThatWins)
{
	const SurfaceMesh strip = rectangle(20, 2, 20, 2);
	const Parametrization map = cutForPacking(strip, 0.01);
	const std::size_t cuts = map.charts.size() - 1;
	ASSERT_GE(cuts, 1u);
	expectPacked(strip, map, cuts + 1);
	EXPECT_GE(leastDistance(map), 0.01 - 1e-7);
	EXPECT_EQ(map.report.charts, static_cast<int>(cuts + 1));
	EXPECT_EQ(at(map.report.overlapCuts), 2 * cuts);
	EXPECT_NEAR(map.report.seamLength, 2.0 * static_cast<double>(cuts), 1e-9);
	const Report whole = parametrizeEuclidean(strip, {}, packing(0.01)).report;
	EXPECT_GT( // each cut is worth its seam
		map.report.occupancy,
		whole.occupancy * std::pow(1.0 + map.report.seamLength / std::sqrt(40.0), kPackingPrice));
	for (const auto& [mesh, margin] :
		 {std::pair(rectangle(8, 8, 8, 8), 0.0),
		  std::pair(rectangle(16, 10, 16, 10), 0.0),
		  std::pair(
			  together(
				  {rectangle(20, 10, 20, 10),
				   rectangle(12, 12, 12, 12),
				   rectangle(12, 12, 12, 12),
				   rectangle(12, 12, 12, 12)}),
			  0.25)}) {
		const Parametrization left = cutForPacking(mesh, margin);
		EXPECT_EQ(left.report.overlapCuts, 0);
		EXPECT_EQ(left.report.charts, left.report.components);
		EXPECT_EQ(
			left.mesh.corners(), parametrizeEuclidean(mesh, {}, packing(margin)).mesh.corners());
	}
}

/// Whoever chooses seams gets no further ones for the sake of packing.
TEST(Packing, CutsNothingForPackingWhereSeamsAreChosen)
{
	SurfaceMesh strip = rectangle(20, 2, 20, 2);
	strip.seam.assign(strip.triangles.size(), {0, 0, 0});
	strip.seam[at(17)] = {1, 1, 1};
	const Parametrization map = cutForPacking(strip, 0.01);
	EXPECT_GE(map.report.chosenSeamEdges, 2);
	EXPECT_EQ(map.report.overlapCuts, 0);
	EXPECT_EQ(map.report.seamLength, 0.0);
}

/// In the mesh's own size there are the same charts with the same seams, in the same square: of several all is larger by
/// one factor, and a single one is only turned.
TEST(Packing, KeepsTheChartsInTheSizeOfTheMesh)
{
	Random random(59);
	const std::vector<std::pair<SurfaceMesh, bool>> cases{
		{rectangle(20, 2, 20, 2), true},
		{rectangle(8, 8, 8, 8), false},
		{together({rectangle(20, 2, 20, 2), rectangle(5, 5, 3, 3)}), true},
		{stars(1, 0.0, random), false}};
	for (const auto& [mesh, isCut] : cases)
		for (const double margin : {0.0, 0.02}) {
			const Parametrization square = cutForPacking(mesh, margin);
			const Parametrization own = cutForPacking(mesh, margin, false);
			EXPECT_EQ(square.report.charts > square.report.components, isCut);
			EXPECT_EQ(own.mesh.chart, square.mesh.chart);
			EXPECT_EQ(own.mesh.points, square.mesh.points);
			EXPECT_EQ(own.report.overlapCuts, square.report.overlapCuts);
			EXPECT_EQ(own.report.seamLength, square.report.seamLength);
			EXPECT_EQ(own.report.margin, margin);
			double covered = 0.0;
			for (const Triangle2& t : square.mesh.corners())
				covered += 0.5 * std::abs(doubledArea(t));
			const double scale = std::sqrt(areaOf(mesh) / covered), side = own.mesh.box().extent();
			for (const int f : own.mesh.points.indices())
				for (std::size_t k = 0; k < 3; ++k) {
					const Triangle2 &a = own.mesh.at(f), &b = square.mesh.at(f);
					EXPECT_NEAR(
						distance(a[k], a[(k + 1) % 3]),
						scale * distance(b[k], b[(k + 1) % 3]),
						1e-6 * side);
					if (own.charts.size() > 1) {
						EXPECT_LT(distance(a[k], scale * b[k]), 1e-6 * side);
					}
				}
		}
}

/// Slivers lower than two thirds of a step of a float where the caller puts their boxes, which end between two floats:
/// none is flipped there.
TEST(Packing, MendsSliversThatAreChartsOfTheirOwn)
{
	int flipped = 0;
	for (const double begin : {8.01, 8.02, 8.03, 8.04, 8.05, 8.06, 8.07}) {
		std::vector<SurfaceMesh> pieces{rectangle(1, 1, begin, begin)};
		for (int i = 0; i < 7; ++i) {
			const double width = 1e-4 + 1e-5 * i;
			pieces.push_back(
				{{{0, 0, 0}, {width, 0, 0}, {0.5 * width, 4e-3 * width, 0}}, {{0, 1, 2}}});
		}
		const SurfaceMesh mesh = together(pieces);
		Options options = packing(0.0, false);
		options.turns = ChartTurns::None;
		options.finish = Finish::None;
		flipped += parametrizeEuclidean(mesh, {}, options).report.flippedByRounding;
		options.finish = Finish::Repair;
		const Parametrization map = parametrizeEuclidean(mesh, {}, options);
		EXPECT_EQ(map.report.flippedFaces + map.report.flippedByRounding, 0);
		EXPECT_EQ(map.report.overlappingFaces, 0);
		for (const int f : map.mesh.points.indices()) {
			Box2 box = map.charts[at(map.mesh.chart[f])].box;
			const Point2 step{0x1p-20, 0x1p-20}; // of a float
			box.min = box.min - step;
			box.max = box.max + step;
			for (const Point2& p : map.mesh.at(f))
				EXPECT_TRUE(box.contains(p));
		}
	}
	EXPECT_GT(flipped, 10);
}

/// Disks lie in equal squares, row by row.
TEST(Packing, GivesEachDiskASquareOfItsOwn)
{
	Random random(390);
	const SurfaceMesh one = shaken(perforatedSlab(2, 2), 0.05, random);
	SurfaceMesh mesh = one;
	for (const int n : {1, 2, 4, 5}) {
		while (mesh.triangles.size() < at(n) * one.triangles.size())
			mesh = sideBySide(mesh, one, 10.0 * n);
		const Parametrization map = parametrizeHyperbolic(mesh, {}, {});
		ASSERT_EQ(map.charts.size(), at(n));
		const double side = 1.0 / std::ceil(std::sqrt(n));
		for (std::size_t i = 0; i < map.charts.size(); ++i) {
			const Box2& box = map.charts[i].box;
			EXPECT_NEAR(box.width(), side, 1e-15);
			EXPECT_NEAR(box.height(), side, 1e-15);
			for (std::size_t k = 0; k < 2; ++k) {
				EXPECT_GE(box.min[k], 0.0);
				EXPECT_LE(box.max[k], 1.0 + 1e-15);
			}
			for (std::size_t j = 0; j < i; ++j)
				EXPECT_GE(distance(box.min, map.charts[j].box.min), side * (1 - 1e-14));
		}
		for (const int f : map.mesh.points.indices()) {
			const Box2& box = map.charts[at(map.mesh.chart[f])].box;
			for (const Point2& p : map.mesh.at(f))
				EXPECT_LT(distance(p, box.centre()), 0.5 * side);
		}
	}
}

/// Options with which charts lie in tiles.
Options inTiles(double side, double margin, Charts charts)
{
	Options options = packing(margin);
	options.charts = charts;
	options.tileSide = side;
	return options;
}

/// Every chart lies in one of the tiles, all of which are used, as far from its border as from others.
void expectInTiles(const Parametrization& map, double margin)
{
	std::vector<char> isUsed(at(map.report.tiles), 0);
	for (const Chart& chart : map.charts) {
		const Point2 middle = chart.box.centre();
		ASSERT_LT(middle[0], kTilesInRow);
		const double tile = std::floor(middle[0]) + kTilesInRow * std::floor(middle[1]);
		ASSERT_LT(tile, map.report.tiles);
		isUsed[at(static_cast<int>(tile))] = 1;
	}
	EXPECT_EQ(std::count(isUsed.begin(), isUsed.end(), 1), map.report.tiles);
	EXPECT_GE(leastDistance(map), margin - 1e-6); // floats of 8 and more differ by 1e-6
}

TEST(Tiles, HoldChartsAtTheScaleThatIsAskedFor)
{
	Random random(811);
	for (const int tiles : {1, 4, 25})
		for (const double margin : {0.0, 0.002, 0.02}) {
			SCOPED_TRACE(
				std::to_string(tiles) + " tiles with the margin " + std::to_string(margin));
			const SurfaceMesh mesh = stars(120, 1.0, random);
			const double area = areaOf(mesh);
			// The largest star, of radius 1, has to fit.
			const double side = std::max(2.2, std::sqrt(1.3 * area / tiles));
			const Parametrization map =
				parametrizeEuclidean(mesh, {}, inTiles(side, margin, Charts::OfTheFlow));
			EXPECT_NEAR(expectPacked(mesh, map, 120) * side, 1.0, 1e-6);
			expectInTiles(map, margin);
			EXPECT_GT(map.report.occupancy, 0.35);
			EXPECT_EQ(map.report.overlapCuts, 0);
		}
}

TEST(Tiles, TakeChartsInPiecesThatAreTooLong)
{
	const SurfaceMesh mesh = rectangle(48, 24, 9.6, 4.8);
	for (const double side : {1.7, 3.0, 6.0}) {
		SCOPED_TRACE(side);
		const Parametrization map =
			parametrizeEuclidean(mesh, {}, inTiles(side, 0.01, Charts::WithoutOverlap));
		EXPECT_NEAR(expectPacked(mesh, map, map.charts.size()) * side, 1.0, 1e-6);
		expectInTiles(map, 0.01);
		// Straight cuts into as few pieces as hold all of it.
		const double room = 0.98 * side, x = std::ceil(9.6 / room), y = std::ceil(4.8 / room);
		EXPECT_EQ(map.charts.size(), x * y);
		EXPECT_NEAR(map.report.seamLength, (x - 1) * 4.8 + (y - 1) * 9.6, 1e-9);
	}
}

/// Directions of the sides stay what they are in one square.
TEST(Tiles, TakeChartsAsTheyLieWhereTheseDoNotTurn)
{
	SurfaceMesh mesh = rectangle(48, 24, 9.6, 4.8);
	for (const double side : {0.0, 3.0}) {
		Options options = inTiles(side, 0.01, Charts::WithoutOverlap);
		options.turns = ChartTurns::None;
		const Parametrization map = parametrizeEuclidean(mesh, {}, options);
		const Triangle2 first = map.mesh.at(0);
		const std::complex<double> own = asComplex(first[1] - first[0]);
		for (int f = 0; f < map.mesh.size(); f += 2) { // the lower triangles of the cells
			const Triangle2 t = map.mesh.at(f);
			EXPECT_LT(std::abs(asComplex(t[1] - t[0]) / own - 1.0), 1e-5);
		}
	}
}

/// A chart of three turns that lie on each other has a larger area than the tile that holds it.
TEST(Tiles, HoldChartsThatCoverThemselves)
{
	const SurfaceMesh ramp = grid(90, 4, Ends::Open, Ends::Open, [](int i, int j) {
		const double angle = 6 * kPi * i / 90.0, r = 1.0 - 0.2 * j;
		return Point3{r * std::cos(angle), r * std::sin(angle), 0.02 * angle};
	});
	Options options = inTiles(2.3, 0.01, Charts::OfTheFlow);
	options.cones.onlyWhereNeeded = true;
	const Parametrization map = parametrizeEuclidean(ramp, {}, options);
	ASSERT_GT(areaOf(ramp), 2.3 * 2.3);
	EXPECT_EQ(map.charts.size(), 1u);
	EXPECT_EQ(map.report.tiles, 1);
	expectInTiles(map, 0.01);
}

TEST(Tiles, AreNotCutForWhereOneHoldsAll)
{
	const SurfaceMesh mesh = torus(2.0, 1.0, 24, 12);
	Options options;
	const Parametrization whole = parametrizeEuclidean(mesh, {}, options);
	options.tileSide = 100.0;
	const Parametrization map = parametrizeEuclidean(mesh, {}, options);
	EXPECT_EQ(map.report.tiles, 1);
	EXPECT_LE(map.charts.size(), whole.charts.size());
	EXPECT_NEAR(map.report.occupancy, areaOf(mesh) / 1e4, 1e-9);
}

/// The side that a refusal names will do.
TEST(Tiles, ThatAreTooSmallOrTooLargeAreRefusedWithASideThatWillDo)
{
	const SurfaceMesh mesh = rectangle(20, 20, 20.0, 20.0);
	Options disk = inTiles(5.0, 0.02, Charts::OfTheFlow);
	disk.target = TargetCurvature::Disk;
	for (Options options :
		 {disk,
		  inTiles(1.5, 0.02, Charts::WithoutOverlap),
		  inTiles(1e6, 0.02, Charts::OfTheFlow)}) {
		const auto refusal =
			refusalOf<InvalidOption>([&] { parametrizeEuclidean(mesh, {}, options); });
		EXPECT_EQ(refusal.problem, InvalidOption::TileSide);
		EXPECT_EQ(refusal.value, options.tileSide);
		const bool isTooLarge = options.tileSide > 100.0;
		ASSERT_EQ(refusal.bound < options.tileSide, isTooLarge);
		options.tileSide = refusal.bound * (isTooLarge ? 1.0 - 1e-9 : 1.0 + 1e-9);
		const Parametrization map = parametrizeEuclidean(mesh, {}, options);
		expectInTiles(map, 0.02);
		EXPECT_EQ(map.report.flippedFaces + map.report.flippedByRounding, 0);
		EXPECT_EQ(map.report.tiles > 1, options.tileSide < 5.0);
	}
}

} // namespace
} // namespace ricci::testing
