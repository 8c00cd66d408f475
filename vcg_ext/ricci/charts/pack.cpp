// SPDX-License-Identifier: GPL-3.0-or-later
#include "pack.h"

#include "../base/tolerances.h"
#include "../error.h"
#include "../measure/distortion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ricci {

namespace {

/// Attempts to find the room between charts, which grows with the square that holds them.
constexpr int kMaxAttempts = 60;

Box2 boxOf(const Parametrization& map, const Chart& chart)
{
	Box2 box;
	for (int f : chart.faces)
		for (const Point2& p : map.uv[positionOf(f)])
			box.add(p);
	for (int f : chart.refined)
		for (const Point2& p : map.refined.uv[positionOf(f)])
			box.add(p);
	return box;
}

Point2 sum(const Point2& a, const Point2& b)
{
	return {a[0] + b[0], a[1] + b[1]};
}

/// Widens boxes with a side shorter than \p least, about their middles.
void widen(std::vector<Box2>& boxes, double least)
{
	for (Box2& box : boxes)
		for (std::size_t k = 0; k < 2; ++k)
			if (const double missing = least - (box.max[k] - box.min[k]); missing > 0.0) {
				box.min[k] -= 0.5 * missing;
				box.max[k] += 0.5 * missing;
			}
}

/// Rounding may leave the unit square by one unit of the last place.
void clampToUnitSquare(Parametrization& map)
{
	for (std::vector<Triangle2>* triangles : {&map.uv, &map.refined.uv})
		for (Triangle2& triangle : *triangles)
			for (Point2& p : triangle)
				for (double& x : p)
					x = std::min(std::max(x, 0.0), 1.0);
	for (Chart& chart : map.charts)
		for (Point2* p : {&chart.box.min, &chart.box.max})
			for (double& x : *p)
				x = std::min(std::max(x, 0.0), 1.0);
}

void requireFloats(const std::vector<Triangle2>& triangles)
{
	for (const Triangle2& triangle : triangles)
		for (const Point2& p : triangle)
			for (double x : p)
				if (!(std::abs(x) <= static_cast<double>(std::numeric_limits<float>::max())))
					throw InvalidMesh(InvalidMesh::TooLargeForFloats);
}

} // namespace

void checkChartMargin(double margin)
{
	if (!(margin >= 0.0 && margin <= kMaxChartMargin))
		throw InvalidOption(InvalidOption::ChartMargin, margin, kMaxChartMargin);
}

bool marginsMayFit(std::size_t charts, double margin)
{
	const double free = 1.0 - margin;
	return static_cast<double>(charts) * margin * margin <= free * free;
}

void packCharts(Parametrization& map, bool normalize, double margin, const PlaceBoxes& placeBoxes)
{
	checkChartMargin(margin);
	std::vector<Box2> boxes;
	for (const Chart& chart : map.charts)
		boxes.push_back(boxOf(map, chart));
	// The square that holds all has this side at least.
	double area = 0.0, extent = 0.0;
	for (const Box2& box : boxes) {
		area += box.width() * box.height();
		extent = std::max(extent, box.extent());
	}
	widen(boxes, kLeastBoxSide * std::max(extent, std::sqrt(area)));
	// The margin is a share of a square that grows with the margin.
	std::vector<Point2> shift;
	double size = 0.0, room = 0.0;
	Box2 whole;
	for (int attempt = 0; attempt == 0 || room < margin * size; ++attempt) {
		if (attempt == kMaxAttempts || !marginsMayFit(boxes.size(), margin))
			throw InvalidOption(InvalidOption::ChartMarginTooWide, margin, 0.0, boxes.size());
		room = (1.0 + kMarginSpare) * margin * size;
		shift = placeBoxes(boxes, room);
		whole = Box2();
		for (std::size_t i = 0; i < boxes.size(); ++i) {
			whole.add(sum(boxes[i].min, shift[i]));
			whole.add(sum(boxes[i].max, shift[i]));
		}
		size = whole.extent() + 2.0 * room;
	}
	const auto place = [&](std::size_t i, double scale, const Point2& by) {
		const auto placed = [&](const Point2& p) {
			return Point2{scale * p[0] + by[0], scale * p[1] + by[1]};
		};
		transformChart(map, map.charts[i], scale, by);
		map.charts[i].box = {placed(boxes[i].min), placed(boxes[i].max)};
	};
	if (!normalize) {
		for (std::size_t i = 0; i < boxes.size(); ++i)
			place(i, 1.0, boxes.size() > 1 ? shift[i] : Point2{0.0, 0.0});
		requireFloats(map.uv);
		requireFloats(map.refined.uv);
		return;
	}
	const Point2 corner{whole.min[0] - room, whole.min[1] - room};
	const double scale = 1.0 / size;
	for (std::size_t i = 0; i < boxes.size(); ++i)
		place(i, scale, {(shift[i][0] - corner[0]) * scale, (shift[i][1] - corner[1]) * scale});
	clampToUnitSquare(map);
}

std::vector<Box2> placeDisks(Parametrization& map)
{
	const int perRow =
		static_cast<int>(std::ceil(std::sqrt(static_cast<double>(map.charts.size()))));
	const double side = 1.0 / perRow;
	std::vector<Box2> squares;
	for (const Chart& chart : map.charts) {
		const int i = static_cast<int>(squares.size()), row = i / perRow;
		Box2 square;
		square.min = {side * (i % perRow), side * row};
		square.max = {square.min[0] + side, square.min[1] + side};
		squares.push_back(square);
		transformChart(
			map,
			chart,
			0.5 * side,
			{(square.min[0] + square.max[0]) / 2, (square.min[1] + square.max[1]) / 2});
	}
	clampToUnitSquare(map);
	return squares;
}

void transformChart(Parametrization& map, const Chart& chart, double scale, const Point2& shift)
{
	const auto move = [&](Triangle2& triangle) {
		for (Point2& p : triangle)
			p = {scale * p[0] + shift[0], scale * p[1] + shift[1]};
	};
	for (int f : chart.faces)
		move(map.uv[positionOf(f)]);
	for (int f : chart.refined)
		move(map.refined.uv[positionOf(f)]);
}

void countFlippedAsWritten(const Parametrization& map, Report& report)
{
	if (!map.isRefined()) {
		countFlipped(map.uv, map.reversed, report);
		return;
	}
	std::vector<char> reversed;
	for (int f : map.refined.inputFace)
		reversed.push_back(map.reversed[positionOf(f)]);
	countFlipped(map.refined.uv, reversed, report);
}

} // namespace ricci
