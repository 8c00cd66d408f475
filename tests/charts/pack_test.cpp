// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/flat_meshes.h"
#include "support/random.h"

#include <ricci/base/indexed.h>
#include <ricci/base/tolerances.h>
#include <ricci/charts/pack.h>
#include <ricci/charts/separate_charts.h>
#include <ricci/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

/// Meshes over the plane, each a chart.
Parametrization charts(const std::vector<SurfaceMesh>& meshes)
{
	SurfaceMesh all;
	std::vector<int> chart;
	for (std::size_t i = 0; i < meshes.size(); ++i) {
		const int first = static_cast<int>(all.positions.size());
		all.positions.insert(
			all.positions.end(), meshes[i].positions.begin(), meshes[i].positions.end());
		for (const Triangle& t : meshes[i].triangles)
			all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
		chart.resize(all.triangles.size(), static_cast<int>(i));
	}
	FlatMesh mesh = flatMesh(all);
	mesh.chart = Array<int>(chart);
	return mapWith(mesh);
}

/// Charts of two triangles each, which fill the boxes from the origin with these sizes.
Parametrization boxes(const std::vector<Point2>& sizes)
{
	std::vector<SurfaceMesh> meshes;
	for (const auto& [x, y] : sizes)
		meshes.push_back({{{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}}, {{0, 1, 2}, {0, 2, 3}}});
	return charts(meshes);
}

void packCharts(
	Parametrization& map,
	bool normalize,
	double margin,
	const PlaceBoxes& placeBoxes,
	ChartTurns turns = ChartTurns::None)
{
	ricci::packCharts(map, {normalize, margin, placeBoxes}, turns);
}

void packForRoom(
	Parametrization& map, double margin, const PlaceBoxes& placeBoxes, ChartTurns turns)
{
	ricci::packForRoom(map, {true, margin, placeBoxes}, turns);
}

/// In one row.
std::vector<Point2> inARow(const std::vector<Box2>& boxes, double padding)
{
	std::vector<Point2> shifts;
	double x = boxes.empty() ? 0.0 : boxes[0].min[0];
	for (const Box2& box : boxes) {
		shifts.push_back({x - box.min[0], 0.0});
		x += box.width() + padding;
	}
	return shifts;
}

/// In rows about as wide as high.
std::vector<Point2> inRows(const std::vector<Box2>& boxes, double padding)
{
	double area = 0.0;
	for (const Box2& box : boxes)
		area += (box.width() + padding) * (box.height() + padding);
	std::vector<Point2> shifts;
	double x = 0.0, y = 0.0, top = 0.0;
	for (const Box2& box : boxes) {
		if (x > std::sqrt(area)) {
			x = 0.0;
			y = top;
		}
		shifts.push_back({x - box.min[0], y - box.min[1]});
		x += box.width() + padding;
		top = std::max(top, y + box.height() + padding);
	}
	return shifts;
}

Box2 boxOf(const Parametrization& map, std::size_t chart)
{
	Box2 box;
	const auto triangles = map.mesh.trianglesByChart(map.charts.size());
	for (const int f : triangles[chart])
		for (const Point2& p : map.mesh.at(f))
			box.add(p);
	return box;
}

std::vector<Point2> randomSizes(int n, Random& random)
{
	std::vector<Point2> sizes;
	for (int i = 0; i < n; ++i)
		sizes.push_back({random.real(0.1, 4.0), random.real(0.1, 4.0)});
	return sizes;
}

TEST(PackCharts, LeavesTheMarginInTheUnitSquare)
{
	Random random(370);
	for (int n : {1, 2, 3, 5}) {
		for (double margin : {0.0, 0.01, 0.1}) {
			const std::vector<Point2> sizes = randomSizes(n, random);
			Parametrization map = boxes(sizes);
			packCharts(map, true, margin, inARow);
			Box2 whole;
			double scale = 0.0;
			for (std::size_t i = 0; i < sizes.size(); ++i) {
				const Box2 box = boxOf(map, i);
				whole.add(box);
				if (i == 0)
					scale = box.width() / sizes[i][0];
				EXPECT_NEAR(box.width(), scale * sizes[i][0], 1e-12); // one scale for all
				EXPECT_NEAR(box.height(), scale * sizes[i][1], 1e-12);
				if (i > 0) {
					EXPECT_GE(box.min[0] - boxOf(map, i - 1).max[0], margin - 1e-12);
				}
			}
			for (std::size_t k = 0; k < 2; ++k) {
				EXPECT_GE(whole.min[k], margin - 1e-12);
				EXPECT_LE(whole.max[k], 1.0 - margin + 1e-12);
			}
			EXPECT_NEAR(whole.extent(), 1.0 - 2.0 * margin, 1e-5); // and no smaller than it must
		}
	}
}

TEST(PackCharts, WithoutTheUnitSquareKeepsTheScale)
{
	Random random(371);
	const std::vector<Point2> sizes = randomSizes(3, random);
	Parametrization map = boxes(sizes);
	packCharts(map, false, 0.05, inARow);
	for (std::size_t i = 0; i < sizes.size(); ++i) {
		EXPECT_NEAR(boxOf(map, i).width(), sizes[i][0], 1e-14);
		EXPECT_NEAR(boxOf(map, i).height(), sizes[i][1], 1e-14);
	}
	EXPECT_GT(map.mesh.at(2)[0][0], sizes[0][0]);
	const Array<Triangle2> before = boxes({sizes[0]}).mesh.corners();
	Parametrization alone = boxes({sizes[0]});
	packCharts(alone, false, 0.05, inARow);
	EXPECT_EQ(alone.mesh.corners(), before);
}

TEST(PackCharts, RefusesMarginsThatLeaveNoRoom)
{
	Parametrization map = boxes(std::vector<Point2>(40, Point2{1.0, 1.0}));
	const auto refusal = [&](double margin) {
		return refusalOf<InvalidOption>([&] { packCharts(map, true, margin, inARow); });
	};
	for (double margin : {-0.01, 0.26, std::numeric_limits<double>::quiet_NaN()}) {
		EXPECT_EQ(refusal(margin).problem, InvalidOption::ChartMargin);
		EXPECT_EQ(refusal(margin).bound, kMaxChartMargin);
	}
	for (double margin : {0.25, 0.1}) { // by area alone, and in one row
		EXPECT_EQ(refusal(margin).problem, InvalidOption::ChartMarginTooWide);
		EXPECT_EQ(refusal(margin).value, margin);
		EXPECT_EQ(refusal(margin).count, 40u);
	}
}

/// Fans of triangles round the origin.
Parametrization stars(int n, double orders, Random& random)
{
	std::vector<SurfaceMesh> meshes;
	for (int i = 0; i < n; ++i) {
		const int corners = 3 + random.index(9);
		const double size = std::pow(10.0, -orders * i / n);
		SurfaceMesh star;
		star.positions.push_back({0, 0, 0});
		for (int k = 0; k < corners; ++k) {
			const auto p =
				std::polar(size * random.real(0.2, 1.0), 6.283185307179586 * k / corners);
			star.positions.push_back({p.real(), p.imag(), 0});
			star.triangles.push_back({0, 1 + k, 1 + (k + 1) % corners});
		}
		meshes.push_back(star);
	}
	return charts(meshes);
}

std::vector<Outline> outlinesOf(const Parametrization& map)
{
	std::vector<Outline> outlines;
	for (const std::vector<int>& chart : map.mesh.trianglesByChart(map.charts.size()))
		outlines.push_back(outlineOf(map.mesh, chart));
	return outlines;
}

double areaOf(const Array<Triangle2>& triangles)
{
	double doubled = 0.0;
	for (const Triangle2& t : triangles)
		doubled += doubledArea(t[0], t[1], t[2]);
	return 0.5 * doubled;
}

/// The margin is the distance of the outlines, for large and for small charts, turned or not; all are
/// scaled alike, and turning takes no more room.
TEST(PackCharts, KeepsTheMarginBetweenOutlines)
{
	Random random(372);
	for (int n : {1, 2, 5, 30, 300})
		for (double margin : {0.0001, 0.002, 0.01}) {
			Parametrization byBoxes = stars(n, 1.5, random);
			const Parametrization before = byBoxes;
			packCharts(byBoxes, true, margin, inRows);
			for (ChartTurns turns : {ChartTurns::Quarter, ChartTurns::Free}) {
				Parametrization map = before;
				packCharts(map, true, margin, inRows, turns);
				EXPECT_TRUE(keepApart(outlinesOf(map), margin * (1.0 - 1e-9)));
				for (const Point2& p : map.mesh.place)
					for (double x : p) {
						EXPECT_GE(x, margin - 1e-12);
						EXPECT_LE(x, 1.0 - margin + 1e-12);
					}
				for (std::size_t c = 0; c < map.charts.size(); ++c) {
					const Box2 box = boxOf(map, c);
					for (std::size_t k = 0; k < 2; ++k) {
						EXPECT_LE(map.charts[c].box.min[k], box.min[k] + 1e-15);
						EXPECT_GE(map.charts[c].box.max[k], box.max[k] - 1e-15);
					}
				}
				const auto lengthOf = [](const Parametrization& m, Corner side) {
					return distance(m.mesh.at(side), m.mesh.at(side.next()));
				};
				const double scale = lengthOf(map, Corner(0)) / lengthOf(before, Corner(0));
				for (int c = 0; c < 3 * map.mesh.size(); ++c)
					EXPECT_NEAR(
						lengthOf(map, Corner(c)), scale * lengthOf(before, Corner(c)), 1e-12);
				EXPECT_NEAR(map.report.occupancy, areaOf(map.mesh.corners()), 1e-12);
				EXPECT_GE(map.report.occupancy, byBoxes.report.occupancy * (1.0 - 1e-12));
				if (n == 30) { // of many some fit between others
					EXPECT_GT(map.report.occupancy, 1.1 * byBoxes.report.occupancy);
				}
			}
		}
}

TEST(PackCharts, TurnsOneChartIntoTheSmallestSquare)
{
	Parametrization map = boxes({{1.0, 0.1}});
	packCharts(map, true, 0.0, inARow, ChartTurns::Free);
	EXPECT_NEAR(map.report.occupancy, 0.1 / (0.5 * 1.1 * 1.1), 1e-3); // at half a right angle
	for (ChartTurns turns : {ChartTurns::None, ChartTurns::Free}) {
		Parametrization wide = boxes({{1.0, 0.5}}); // no turn makes its square smaller
		packCharts(wide, true, 0.0, inARow, turns);
		EXPECT_EQ(boxOf(wide, 0).height(), 0.5);
		EXPECT_NEAR(wide.report.occupancy, 0.5, 1e-15);
	}
	Parametrization upright = boxes({{1.0, 0.1}});
	packCharts(upright, true, 0.0, inARow);
	EXPECT_NEAR(upright.report.occupancy, 0.1, 1e-15);
}

TEST(PackCharts, WithoutTheUnitSquareTurnsNothing)
{
	Parametrization map = boxes({{1.0, 0.1}, {1.0, 0.1}}), turned = map;
	packCharts(map, false, 0.0, inARow);
	packCharts(turned, false, 0.0, inARow, ChartTurns::Free);
	EXPECT_EQ(turned.mesh.corners(), map.mesh.corners());
	EXPECT_NEAR(map.report.occupancy, 0.2 / 4.0, 1e-15);
}

TEST(PackCharts, PutsManySmallChartsIntoOneBox)
{
	std::vector<Point2> sizes(2000, {0.01, 0.01});
	for (const Point2& size : {Point2{1.0, 0.2}, Point2{0.2, 1.0}, Point2{0.5, 0.5}})
		sizes.push_back(size);
	Parametrization map = boxes(sizes), turned = map;
	packCharts(map, true, 0.001, inRows);
	packCharts(turned, true, 0.001, inRows, ChartTurns::Free);
	EXPECT_TRUE(keepApart(outlinesOf(turned), 0.001 * (1.0 - 1e-9)));
	EXPECT_GT(turned.report.occupancy, map.report.occupancy);
}

/// A chart that is thinner than what floats show keeps its box, upright.
TEST(PackCharts, ThinChartsStayUpright)
{
	for (const std::vector<Point2>& sizes :
		 {std::vector<Point2>{{1.0, 1e-9}},
		  std::vector<Point2>{{1.0, 1e-9}, {1.0, 0.1}, {0.5, 0.5}, {0.2, 0.9}}}) {
		Parametrization map = boxes(sizes);
		packCharts(map, true, 0.0, inRows, ChartTurns::Free);
		const Box2 box = boxOf(map, 0);
		EXPECT_LT(std::min(box.width(), box.height()), 1e-8);
		const Box2& room = map.charts[0].box;
		EXPECT_GE(std::min(room.width(), room.height()), 0.5 * kBoxRoom);
		EXPECT_TRUE(room.contains(box.min) && room.contains(box.max));
	}
}

/// Triangles at the border of a small chart may have to be pushed outward to be given a height.
TEST(PackCharts, SmallChartsHaveRoomOnAllSides)
{
	for (const bool normalize : {false, true}) {
		Parametrization map = boxes({{1.0, 1.0}, {2.0 * kBoxRoom, 3.0 * kBoxRoom}});
		packCharts(map, normalize, 0.0, inRows, ChartTurns::Free);
		const Box2 box = boxOf(map, 1), room = map.charts[1].box;
		for (std::size_t k = 0; k < 2; ++k) {
			EXPECT_GT(box.min[k] - room.min[k], 0.25 * kBoxRoom);
			EXPECT_GT(room.max[k] - box.max[k], 0.25 * kBoxRoom);
		}
	}
}

/// A grid of squares of two triangles over the plane, as one chart.
SurfaceMesh gridOf(int width, int height)
{
	return rectangle(width, height, width, height);
}

/// A strip of 20 by 2 is cut across, by edges of length 1, as long as each cut is worth its seam.
TEST(PackForRoom, CutsAcrossWhereThatWins)
{
	const Parametrization before = charts({gridOf(20, 2)});
	Parametrization whole = before, map = before;
	packCharts(whole, true, 0.01, inRows, ChartTurns::Free);
	packForRoom(map, 0.01, inRows, ChartTurns::Free);
	const std::size_t cuts = map.charts.size() - 1;
	ASSERT_GE(cuts, 1u);
	EXPECT_EQ(at(map.report.charts), cuts + 1);
	EXPECT_EQ(at(map.report.overlapCuts), 2 * cuts);
	const double length = 2.0 * static_cast<double>(cuts);
	EXPECT_NEAR(map.report.seamLength, length, 1e-12);
	EXPECT_GT(
		map.report.occupancy,
		whole.report.occupancy * std::pow(1.0 + length / std::sqrt(40.0), kRoomPrice));
	EXPECT_TRUE(keepApart(outlinesOf(map), 0.01 * (1.0 - 1e-9)));
	EXPECT_EQ(flippedIn(map.mesh), 0);
}

TEST(PackForRoom, LeavesWholeWhatWinsNothing)
{
	for (const ChartTurns turns : {ChartTurns::None, ChartTurns::Free})
		for (const std::array<int, 2> size : {std::array<int, 2>{8, 8}, {16, 10}, {30, 3}}) {
			if (turns == ChartTurns::Free && size[0] == 30)
				continue;
			const Parametrization before = charts({gridOf(size[0], size[1])});
			Parametrization whole = before, map = before;
			packCharts(whole, true, 0.0, inRows, turns);
			packForRoom(map, 0.0, inRows, turns);
			EXPECT_EQ(map.mesh.corners(), whole.mesh.corners());
			EXPECT_EQ(map.charts.size(), 1u);
			EXPECT_EQ(map.report.overlapCuts, 0);
		}
}

TEST(PackForRoom, LeaveWholeWhatTheMarginHasNoRoomForInTwo)
{
	const SurfaceMesh square = gridOf(12, 12);
	Parametrization whole = charts({gridOf(20, 10), square, square, square}), map = whole;
	packCharts(whole, true, 0.25, inRows, ChartTurns::Free);
	packForRoom(map, 0.25, inRows, ChartTurns::Free);
	EXPECT_EQ(map.mesh.corners(), whole.mesh.corners());
	EXPECT_EQ(map.charts.size(), 4u);
}

/// n squares of no extent with the margin m round each, side by side in a square of side 1: the
/// margins between them are shared, so sqrt(n) + 1 of them fit.
TEST(PackCharts, MarginsMayFitAgreesWithPointsOnAGrid)
{
	for (int k = 1; k < 60; ++k) {
		const double bound = 1.0 / (k + 1);
		EXPECT_TRUE(marginsMayFit(positionOf(k * k), 0.999999 * bound));
		EXPECT_FALSE(marginsMayFit(positionOf(k * k), 1.000001 * bound));
	}
}

TEST(PackCharts, RefusesCoordinatesBeyondFloatInTheirOwnScaleOnly)
{
	for (const double size : {1e39, 1e-39}) {
		Parametrization map = boxes({{size, 0.5 * size}});
		const auto error = refusalOf<InvalidMesh>([&] { packCharts(map, false, 0.0, inARow); });
		EXPECT_EQ(error.problem, InvalidMesh::BeyondFloats);
		packCharts(map, true, 0.0, inARow);
		EXPECT_EQ(boxOf(map, 0).max[0], 1.0);
	}
}

TEST(PackCharts, GivesThinChartsRoomOfTheirOwn)
{
	const std::vector<Point2> sizes = {{2.0, 1.0}, {1.5, 1e-9}, {1e-9, 1.2}, {1e-9, 1e-9}};
	constexpr double kMinHeightInText = 2e-6; // a height in six decimals, and as much again
	for (const double margin : {0.0, 0.05}) {
		Parametrization map = boxes(sizes);
		packCharts(map, true, margin, inARow);
		for (std::size_t i = 0; i < sizes.size(); ++i) {
			const Box2& room = map.charts[i].box;
			const Box2 own = boxOf(map, i);
			EXPECT_GE(std::min(room.width(), room.height()), kMinHeightInText);
			for (std::size_t k = 0; k < 2; ++k) {
				EXPECT_LE(room.min[k], own.min[k]);
				EXPECT_GE(room.max[k], own.max[k]);
				EXPECT_NEAR(room.min[k] + room.max[k], own.min[k] + own.max[k], 1e-15);
				EXPECT_GE(room.min[k], 0.0);
				EXPECT_LE(room.max[k], 1.0);
			}
			for (std::size_t j = 0; j < i; ++j)
				EXPECT_GE(room.min[0] - map.charts[j].box.max[0], margin - 1e-15);
		}
	}
	Parametrization map = boxes({sizes[0]}); // a wide one is its own box
	packCharts(map, false, 0.0, inARow);
	EXPECT_EQ(map.charts[0].box.min, (Point2{0.0, 0.0}));
	EXPECT_EQ(map.charts[0].box.max, sizes[0]);
}

TEST(PlaceDisks, GivesEachASquareOfItsOwn)
{
	for (int n : {1, 2, 4, 5, 10}) {
		const Triangle2 inscribed{Point2{1, 0}, Point2{0, 1}, Point2{-0.6, -0.8}};
		const SurfaceMesh triangle{{{1, 0, 0}, {0, 1, 0}, {-0.6, -0.8, 0}}, {{0, 1, 2}}};
		Parametrization map = charts(std::vector<SurfaceMesh>(positionOf(n), triangle));
		placeDisks(map);
		std::vector<Box2> squares;
		for (const Chart& chart : map.charts)
			squares.push_back(chart.box);
		const double side = 1.0 / std::ceil(std::sqrt(n));
		for (std::size_t i = 0; i < squares.size(); ++i) {
			EXPECT_NEAR(squares[i].width(), side, 1e-15);
			EXPECT_NEAR(squares[i].height(), side, 1e-15);
			for (std::size_t k = 0; k < 2; ++k) {
				EXPECT_GE(squares[i].min[k], 0.0);
				EXPECT_LE(squares[i].max[k], 1.0 + 1e-15);
			}
			for (std::size_t j = 0; j < i; ++j)
				EXPECT_GE(distance(squares[i].min, squares[j].min), side * (1 - 1e-14));
			for (std::size_t k = 0; k < 3; ++k)
				for (std::size_t l = 0; l < 2; ++l) {
					const double middle = 0.5 * (squares[i].min[l] + squares[i].max[l]);
					EXPECT_NEAR(
						map.mesh.at(static_cast<int>(i))[k][l],
						middle + 0.5 * side * inscribed[k][l],
						1e-15);
				}
		}
	}
}

} // namespace
} // namespace ricci::testing
