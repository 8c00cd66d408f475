// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/base/indexed.h>
#include <ricci/base/tolerances.h>
#include <ricci/charts/pack.h>
#include <ricci/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

/// Charts of two triangles each, which fill the boxes from the origin with these sizes.
Parametrization boxes(const std::vector<Point2>& sizes)
{
	Parametrization map;
	for (const Point2& size : sizes) {
		Chart chart;
		const Point2 a{0.0, 0.0}, b{size[0], 0.0}, c{size[0], size[1]}, d{0.0, size[1]};
		for (const Triangle2& triangle : {Triangle2{a, b, c}, Triangle2{a, c, d}}) {
			chart.faces.push_back(static_cast<int>(map.uv.size()));
			map.uv.push_back(triangle);
			map.reversed.push_back(0);
		}
		map.charts.push_back(chart);
	}
	return map;
}

/// In one row.
std::vector<Point2> inARow(const std::vector<Box2>& boxes, double room)
{
	std::vector<Point2> shifts;
	double x = boxes.empty() ? 0.0 : boxes[0].min[0];
	for (const Box2& box : boxes) {
		shifts.push_back({x - box.min[0], 0.0});
		x += box.width() + room;
	}
	return shifts;
}

/// In rows about as wide as high.
std::vector<Point2> inRows(const std::vector<Box2>& boxes, double room)
{
	double area = 0.0;
	for (const Box2& box : boxes)
		area += (box.width() + room) * (box.height() + room);
	std::vector<Point2> shifts;
	double x = 0.0, y = 0.0, top = 0.0;
	for (const Box2& box : boxes) {
		if (x > std::sqrt(area)) {
			x = 0.0;
			y = top;
		}
		shifts.push_back({x - box.min[0], y - box.min[1]});
		x += box.width() + room;
		top = std::max(top, y + box.height() + room);
	}
	return shifts;
}

Box2 boxOf(const Parametrization& map, const Chart& chart)
{
	Box2 box;
	for (int f : chart.faces)
		for (const Point2& p : map.uv[positionOf(f)])
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
				const Box2 box = boxOf(map, map.charts[i]);
				whole.add(box);
				if (i == 0)
					scale = box.width() / sizes[i][0];
				EXPECT_NEAR(box.width(), scale * sizes[i][0], 1e-12); // one scale for all
				EXPECT_NEAR(box.height(), scale * sizes[i][1], 1e-12);
				if (i > 0) {
					EXPECT_GE(box.min[0] - boxOf(map, map.charts[i - 1]).max[0], margin - 1e-12);
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
	map.refined.uv.push_back({Point2{0, 0}, Point2{1, 0}, Point2{0, 1}});
	map.charts[1].refined.push_back(0);
	packCharts(map, false, 0.05, inARow);
	for (std::size_t i = 0; i < sizes.size(); ++i) {
		EXPECT_NEAR(boxOf(map, map.charts[i]).width(), sizes[i][0], 1e-14);
		EXPECT_NEAR(boxOf(map, map.charts[i]).height(), sizes[i][1], 1e-14);
	}
	// The refinement moves with its chart.
	EXPECT_EQ(map.refined.uv[0][0], map.uv[2][0]);
	EXPECT_GT(map.uv[2][0][0], sizes[0][0]);
	const std::vector<Triangle2> before = boxes({sizes[0]}).uv;
	Parametrization alone = boxes({sizes[0]});
	packCharts(alone, false, 0.05, inARow);
	EXPECT_EQ(alone.uv, before);
}

TEST(PackCharts, RefusesMarginsThatLeaveNoRoom)
{
	Parametrization map = boxes(std::vector<Point2>(40, Point2{1.0, 1.0}));
	for (double margin : {-0.01, 0.26, std::numeric_limits<double>::quiet_NaN()}) {
		try {
			packCharts(map, true, margin, inARow);
			ADD_FAILURE() << margin;
		}
		catch (const InvalidOption& e) {
			EXPECT_EQ(e.problem, InvalidOption::ChartMargin);
			EXPECT_EQ(e.bound, kMaxChartMargin);
		}
	}
	for (double margin : {0.25, 0.1}) { // by area alone, and in one row
		try {
			packCharts(map, true, margin, inARow);
			ADD_FAILURE() << margin;
		}
		catch (const InvalidOption& e) {
			EXPECT_EQ(e.problem, InvalidOption::ChartMarginTooWide);
			EXPECT_EQ(e.value, margin);
			EXPECT_EQ(e.count, 40u);
		}
	}
}

/// Fans of triangles round the origin.
Parametrization stars(int n, double orders, Random& random)
{
	Parametrization map;
	for (int i = 0; i < n; ++i) {
		Chart chart;
		const int corners = 3 + random.index(9);
		const double size = std::pow(10.0, -orders * i / n);
		std::vector<Point2> p;
		for (int k = 0; k < corners; ++k)
			p.push_back(
				asPoint(std::polar(size * random.real(0.2, 1.0), 6.283185307179586 * k / corners)));
		for (std::size_t k = 0; k < p.size(); ++k) {
			chart.faces.push_back(static_cast<int>(map.uv.size()));
			map.uv.push_back({Point2{0, 0}, p[k], p[(k + 1) % p.size()]});
			map.reversed.push_back(0);
		}
		map.charts.push_back(chart);
	}
	return map;
}

std::vector<Outline> outlinesOf(const Parametrization& map)
{
	std::vector<Outline> outlines;
	for (const Chart& chart : map.charts) {
		std::vector<Triangle2> triangles;
		for (int f : chart.faces)
			triangles.push_back(map.uv[positionOf(f)]);
		outlines.push_back(outlineOf(triangles));
	}
	return outlines;
}

double areaOf(const std::vector<Triangle2>& triangles)
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
				for (const Triangle2& triangle : map.uv)
					for (const Point2& p : triangle)
						for (double x : p) {
							EXPECT_GE(x, margin - 1e-12);
							EXPECT_LE(x, 1.0 - margin + 1e-12);
						}
				for (const Chart& chart : map.charts) {
					const Box2 box = boxOf(map, chart);
					for (std::size_t k = 0; k < 2; ++k) {
						EXPECT_LE(chart.box.min[k], box.min[k] + 1e-15);
						EXPECT_GE(chart.box.max[k], box.max[k] - 1e-15);
					}
				}
				const double scale = distance(map.uv[0][0], map.uv[0][1]) /
									 distance(before.uv[0][0], before.uv[0][1]);
				for (std::size_t f = 0; f < map.uv.size(); ++f)
					for (std::size_t k = 0; k < 3; ++k)
						EXPECT_NEAR(
							distance(map.uv[f][k], map.uv[f][(k + 1) % 3]),
							scale * distance(before.uv[f][k], before.uv[f][(k + 1) % 3]),
							1e-12);
				EXPECT_NEAR(map.report.occupancy, areaOf(map.uv), 1e-12);
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
		EXPECT_EQ(boxOf(wide, wide.charts[0]).height(), 0.5);
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
	EXPECT_EQ(turned.uv, map.uv);
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
		const Box2 box = boxOf(map, map.charts[0]);
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
		const Box2 box = boxOf(map, map.charts[1]), room = map.charts[1].box;
		for (std::size_t k = 0; k < 2; ++k) {
			EXPECT_GT(box.min[k] - room.min[k], 0.25 * kBoxRoom);
			EXPECT_GT(room.max[k] - box.max[k], 0.25 * kBoxRoom);
		}
	}
}

/// A grid of squares of two triangles over the plane, as one chart.
Parametrization gridOf(int width, int height)
{
	Parametrization map;
	SurfaceMesh& mesh = map.opened.mesh;
	for (int y = 0; y <= height; ++y)
		for (int x = 0; x <= width; ++x)
			mesh.positions.push_back({1.0 * x, 1.0 * y, 0.0});
	map.charts.emplace_back();
	for (int y = 0; y < height; ++y)
		for (int x = 0; x < width; ++x) {
			const int a = y * (width + 1) + x, b = a + 1, d = a + width + 1, c = d + 1;
			for (const Triangle& t : {Triangle{a, b, c}, Triangle{a, c, d}}) {
				map.charts[0].faces.push_back(static_cast<int>(mesh.triangles.size()));
				mesh.triangles.push_back(t);
				map.reversed.push_back(0);
				Triangle2 uv;
				for (std::size_t k = 0; k < 3; ++k) {
					const Point3& p = mesh.positions[positionOf(t[k])];
					uv[k] = {p[0], p[1]};
				}
				map.uv.push_back(uv);
			}
		}
	return map;
}

/// A strip of 20 by 2 is cut by the two edges across its middle into two of 10 by 2 at most.
TEST(PackStrips, CutsAcrossWhereThatWins)
{
	const Parametrization before = gridOf(20, 2);
	Parametrization whole = before, map = before;
	packCharts(whole, true, 0.01, inRows, ChartTurns::Free);
	packStrips(map, 0.01, inRows, ChartTurns::Free);
	ASSERT_EQ(map.charts.size(), 2u);
	EXPECT_EQ(map.report.charts, 2);
	EXPECT_EQ(map.report.overlapCuts, 2);
	EXPECT_NEAR(map.report.seamLength, 2.0, 1e-12);
	EXPECT_NEAR(map.report.seamLengthRelative, 2.0 / std::sqrt(40.0), 1e-12);
	EXPECT_EQ(map.charts[0].faces.size() + map.charts[1].faces.size(), 80u);
	for (const Chart& chart : map.charts) {
		EXPECT_GE(chart.faces.size(), 4u * 8); // within the middle fifth
	}
	EXPECT_GE(map.report.occupancy, kWorthCutting * whole.report.occupancy);
	EXPECT_TRUE(keepApart(outlinesOf(map), 0.01 * (1.0 - 1e-9)));
	for (const Triangle2& triangle : map.uv)
		EXPECT_GT(doubledArea(triangle[0], triangle[1], triangle[2]), 0.0);
}

TEST(PackStrips, LeavesWholeWhatWinsNothing)
{
	for (const ChartTurns turns : {ChartTurns::None, ChartTurns::Free})
		for (const std::array<int, 2> size : {std::array<int, 2>{8, 8}, {16, 10}, {30, 3}}) {
			if (turns == ChartTurns::Free && size[0] == 30)
				continue;
			const Parametrization before = gridOf(size[0], size[1]);
			Parametrization whole = before, map = before;
			packCharts(whole, true, 0.0, inRows, turns);
			packStrips(map, 0.0, inRows, turns);
			EXPECT_EQ(map.uv, whole.uv);
			EXPECT_EQ(map.charts.size(), 1u);
			EXPECT_EQ(map.report.overlapCuts, 0);
		}
}

/// Its chart becomes one more of \p map.
void append(const Parametrization& other, Parametrization& map)
{
	SurfaceMesh& mesh = map.opened.mesh;
	const int vertices = static_cast<int>(mesh.positions.size());
	const int faces = static_cast<int>(mesh.triangles.size());
	const auto add = [](auto& to, const auto& from) {
		to.insert(to.end(), from.begin(), from.end());
	};
	add(mesh.positions, other.opened.mesh.positions);
	for (const Triangle& t : other.opened.mesh.triangles)
		mesh.triangles.push_back({t[0] + vertices, t[1] + vertices, t[2] + vertices});
	add(map.uv, other.uv);
	add(map.reversed, other.reversed);
	map.charts.push_back(other.charts[0]);
	for (int& f : map.charts.back().faces)
		f += faces;
}

TEST(PackStrips, LeaveWholeWhatTheMarginHasNoRoomForInTwo)
{
	Parametrization whole = gridOf(20, 10);
	for (int i = 0; i < 3; ++i)
		append(gridOf(12, 12), whole);
	Parametrization map = whole;
	packCharts(whole, true, 0.25, inRows, ChartTurns::Free);
	packStrips(map, 0.25, inRows, ChartTurns::Free);
	EXPECT_EQ(map.uv, whole.uv);
	EXPECT_EQ(map.charts.size(), 4u);
}

/// A face goes with one piece of it, which may lie in another chart than the others.
TEST(PackStrips, KeepEachFaceInOneChart)
{
	Parametrization map = gridOf(20, 2);
	append(gridOf(1, 1), map);
	RefinedMesh& refined = map.refined;
	for (std::size_t v = 0; v < map.opened.mesh.positions.size(); ++v) {
		refined.points.emplace_back();
		refined.points.back().vertex.fill(static_cast<int>(v));
	}
	refined.triangles = map.opened.mesh.triangles;
	refined.uv = map.uv;
	for (Chart& chart : map.charts) {
		chart.refined = chart.faces;
		for (const int f : chart.faces)
			refined.inputFace.push_back(f);
	}
	std::vector<int>& faces = map.charts[0].faces;
	map.charts[1].faces.push_back(faces.front());
	faces.erase(faces.begin());
	packStrips(map, 0.01, inRows, ChartTurns::Free);
	ASSERT_EQ(map.charts.size(), 3u);
	std::vector<int> times(map.uv.size(), 0);
	for (const Chart& chart : map.charts)
		for (const int f : chart.faces)
			++times[positionOf(f)];
	EXPECT_EQ(times, std::vector<int>(map.uv.size(), 1));
}

TEST(ChartTurns, RectanglesStayUprightAndQuarterTurnsStaySo)
{
	Options options;
	EXPECT_EQ(chartTurns(options), ChartTurns::Free);
	options.cones.rounding = ConeRounding::QuarterTurns;
	EXPECT_EQ(chartTurns(options), ChartTurns::Quarter);
	options.target = TargetCurvature::Rectangle;
	EXPECT_EQ(chartTurns(options), ChartTurns::None);
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
		try {
			packCharts(map, false, 0.0, inARow);
			ADD_FAILURE();
		}
		catch (const InvalidMesh& e) {
			EXPECT_EQ(e.problem, InvalidMesh::BeyondFloats);
		}
		packCharts(map, true, 0.0, inARow);
		EXPECT_EQ(boxOf(map, map.charts[0]).max[0], 1.0);
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
			const Box2 own = boxOf(map, map.charts[i]);
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
		Parametrization map;
		const Triangle2 inscribed{Point2{1, 0}, Point2{0, 1}, Point2{-0.6, -0.8}};
		for (int i = 0; i < n; ++i) {
			map.uv.push_back(inscribed);
			map.charts.emplace_back();
			map.charts.back().faces.push_back(i);
		}
		const std::vector<Box2> squares = placeDisks(map);
		ASSERT_EQ(squares.size(), positionOf(n));
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
					EXPECT_NEAR(map.uv[i][k][l], middle + 0.5 * side * inscribed[k][l], 1e-15);
				}
		}
	}
}

TEST(CountFlippedAsWritten, CountsTheOutput)
{
	Parametrization map = boxes({{1.0, 1.0}, {2.0, 1.0}});
	Report report;
	countFlippedAsWritten(map, report);
	EXPECT_EQ(report.flippedFaces, 0);
	map.reversed[1] = 1;
	std::swap(map.uv[2][0], map.uv[2][1]);
	map.uv[3] = {Point2{1, 1}, Point2{2, 1}, Point2{1.5, 1 + 1e-12}}; // flat in float
	countFlippedAsWritten(map, report);
	EXPECT_EQ(report.flippedFaces, 2);
	EXPECT_EQ(report.flippedByRounding, 1);
	// Of a refinement only its own triangles count, turned round like their faces.
	map.refined.triangles.assign(2, Triangle{0, 1, 2});
	map.refined.inputFace = {0, 1};
	map.refined.uv.assign(2, Triangle2{Point2{0, 0}, Point2{1, 0}, Point2{0, 1}});
	countFlippedAsWritten(map, report);
	EXPECT_EQ(report.flippedFaces, 1);
	std::swap(map.refined.uv[1][0], map.refined.uv[1][1]);
	countFlippedAsWritten(map, report);
	EXPECT_EQ(report.flippedFaces, 0);
	EXPECT_EQ(report.flippedByRounding, 0);
}

} // namespace
} // namespace ricci::testing
