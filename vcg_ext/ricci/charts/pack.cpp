// SPDX-License-Identifier: GPL-3.0-or-later
#include "pack.h"

#include "../base/task.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "../math/min_area_rectangle.h"
#include "../measure/distortion.h"
#include "separate_charts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace ricci {

namespace {

/// Attempts to find the room between charts, which grows with the square that holds them.
constexpr int kMaxAttempts = 60;

/// Charts that are placed by their outlines at most.
constexpr std::size_t kMaxOutlines = 200;

/// A chart is too small for that if its box is shorter than this share of the square.
constexpr double kMinOutlineExtent = 1.0 / 64.0;

/// The chart's triangles in the plane, of both triangulations.
std::vector<Triangle2> trianglesOf(const Parametrization& map, const Chart& chart)
{
	std::vector<Triangle2> triangles;
	for (int f : chart.faces)
		triangles.push_back(map.uv[positionOf(f)]);
	for (int f : chart.refined)
		triangles.push_back(map.refined.uv[positionOf(f)]);
	return triangles;
}

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

/// Room for triangles that are to be given a height, which lie side by side in two directions.
double roomFor(const Chart& chart)
{
	const std::size_t triangles = chart.refined.empty() ? chart.faces.size() : chart.refined.size();
	return kBoxRoom * (1.0 + 0.25 * std::sqrt(static_cast<double>(triangles)));
}

/// Widens the boxes of charts about their middles, where a side is shorter than kThinSide times the room
/// that the chart's triangles want.
/// \param side of a square that holds all
/// \return [box] 1 for those that are thinner than kBoxRoom, which are not turned
std::vector<char> widen(const std::vector<Chart>& charts, double side, std::vector<Box2>& boxes)
{
	std::vector<char> isThin(boxes.size(), 0);
	for (std::size_t i = 0; i < boxes.size(); ++i) {
		const double room = side * roomFor(charts[i]);
		for (std::size_t k = 0; k < 2; ++k)
			if (const double length = boxes[i].max[k] - boxes[i].min[k];
				length < kThinSide * room) {
				boxes[i].min[k] -= 0.5 * room;
				boxes[i].max[k] += 0.5 * room;
				isThin[i] = isThin[i] || length < side * kBoxRoom;
			}
	}
	return isThin;
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

/// Of the output's triangles.
double coveredArea(const Parametrization& map)
{
	double doubled = 0.0;
	for (const Triangle2& t : map.isRefined() ? map.refined.uv : map.uv)
		doubled += std::abs(doubledArea(t[0], t[1], t[2]));
	return 0.5 * doubled;
}

/// Charts in a square: their motions, the box round them and the room between it and the square.
struct Packing
{
	std::vector<Motion> motions; ///< [chart]
	Box2 whole;
	double room = 0.0;

	double side() const { return whole.extent() + 2.0 * room; }
};

/// By boxes alone.
Packing packBoxes(const std::vector<Box2>& boxes, double margin, const PlaceBoxes& placeBoxes)
{
	// The margin is a share of a square that grows with the margin.
	Packing packing;
	double size = 0.0;
	for (int attempt = 0; attempt == 0 || packing.room < margin * size; ++attempt) {
		if (attempt == kMaxAttempts || !marginsMayFit(boxes.size(), margin))
			throw InvalidOption(InvalidOption::ChartMarginTooWide, margin, 0.0, boxes.size());
		packing = {};
		packing.room = (1.0 + kMarginSpare) * margin * size;
		const std::vector<Point2> shift = placeBoxes(boxes, packing.room);
		for (std::size_t i = 0; i < boxes.size(); ++i) {
			packing.whole.add(sum(boxes[i].min, shift[i]));
			packing.whole.add(sum(boxes[i].max, shift[i]));
			packing.motions.push_back({1.0, shift[i]});
		}
		size = packing.side();
	}
	return packing;
}

/// One chart, turned so that the square round it is smallest.
Packing packAlone(const Parametrization& map)
{
	std::vector<Point2> points;
	for (const Triangle2& triangle : trianglesOf(map, map.charts.front()))
		points.insert(points.end(), triangle.begin(), triangle.end());
	const OrientedRectangle r = minExtentRectangle(std::move(points));
	Packing packing;
	packing.motions.push_back({{r.cosine, -r.sine}, {0.0, 0.0}});
	packing.whole.add(r.min);
	packing.whole.add(r.max);
	return packing;
}

Outline borderOf(const Box2& box)
{
	const Point2 &a = box.min, &c = box.max;
	const Point2 b{c[0], a[1]}, d{a[0], c[1]};
	return {{a, b}, {b, c}, {c, d}, {d, a}};
}

/// transformChart(), and the same for the box that it has. A chart that is turned by less than a right
/// angle gets its own.
void place(
	Parametrization& map,
	Chart& chart,
	std::complex<double> factor,
	const Point2& shift,
	const Box2& box)
{
	transformChart(map, chart, factor, shift);
	if (factor.real() != 0.0 && factor.imag() != 0.0) {
		chart.box = boxOf(map, chart);
		return;
	}
	chart.box = {};
	for (const Point2& p : {box.min, box.max}) {
		const std::complex<double> q = factor * asComplex(p) + asComplex(shift);
		chart.box.add(asPoint(q));
	}
}

/// The largest charts by their outlines, the others in one box.
/// \param room between charts
/// \return without motions where they do not fit into the square of \p byBoxes
Packing packByOutlines(
	const Parametrization& map,
	const std::vector<Box2>& boxes,
	const std::vector<char>& isThin,
	const Packing& byBoxes,
	double room,
	const PlaceBoxes& placeBoxes,
	ChartTurns turns)
{
	const double side = byBoxes.side();
	std::vector<std::size_t> order(boxes.size());
	std::iota(order.begin(), order.end(), std::size_t{0});
	const auto area = [&](std::size_t i) { return boxes[i].width() * boxes[i].height(); };
	std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
		return area(a) > area(b);
	});
	std::vector<std::size_t> large, small;
	double areaOfLarge = 0.0, areaOfSmall = 0.0;
	for (const std::size_t i : order) {
		const bool isLarge = large.size() < kMaxOutlines && !isThin[i] &&
							 boxes[i].extent() > kMinOutlineExtent * side;
		(isLarge ? large : small).push_back(i);
		(isLarge ? areaOfLarge : areaOfSmall) += area(i);
	}
	if (large.empty() || areaOfLarge < areaOfSmall)
		return {};
	std::vector<Outline> outlines;
	for (const std::size_t i : large) {
		outlines.push_back(outlineOf(trianglesOf(map, map.charts[i])));
		if (outlines.back().empty()) // without area
			return {};
		checkpoint();
	}
	std::vector<Box2> smallBoxes;
	smallBoxes.reserve(small.size());
	for (const std::size_t i : small)
		smallBoxes.push_back(boxes[i]);
	const std::vector<Point2> shift = placeBoxes(smallBoxes, room);
	Box2 ofSmall;
	for (std::size_t k = 0; k < small.size(); ++k) {
		ofSmall.add(sum(smallBoxes[k].min, shift[k]));
		ofSmall.add(sum(smallBoxes[k].max, shift[k]));
	}
	std::vector<ChartTurns> turnsOf(large.size(), turns);
	if (!small.empty()) {
		outlines.push_back(borderOf(ofSmall));
		turnsOf.push_back(ChartTurns::Quarter); // their boxes stay upright
	}
	const std::vector<Motion> motions = packOutlines(outlines, turnsOf, side - room, room);
	if (motions.empty())
		return {};
	Packing packing;
	for (std::size_t k = 0; k < outlines.size(); ++k)
		for (auto& ends : outlines[k])
			for (Point2& p : ends) {
				p = motions[k](p);
				packing.whole.add(p);
			}
	if (!keepApart(outlines, (1.0 - kMarginSpare) * room))
		return {};
	packing.motions.resize(boxes.size());
	for (std::size_t k = 0; k < large.size(); ++k)
		packing.motions[large[k]] = motions[k];
	for (std::size_t k = 0; k < small.size(); ++k)
		packing.motions[small[k]] = {motions.back().turn, motions.back()(shift[k])};
	return packing;
}

void requireFloats(const std::vector<Triangle2>& triangles)
{
	using Float = std::numeric_limits<float>;
	// The steps of floats become no smaller below the normal numbers.
	const double smallest =
		static_cast<double>(Float::min()) / static_cast<double>(Float::epsilon());
	double largest = 0.0;
	for (const Triangle2& triangle : triangles)
		for (const Point2& p : triangle)
			for (double x : p) {
				if (!(std::abs(x) <= static_cast<double>(Float::max())))
					throw InvalidMesh(InvalidMesh::BeyondFloats);
				largest = std::max(largest, std::abs(x));
			}
	if (largest > 0.0 && largest < smallest)
		throw InvalidMesh(InvalidMesh::BeyondFloats);
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

ChartTurns chartTurns(const Options& options)
{
	return options.target == TargetCurvature::Rectangle         ? ChartTurns::None
		   : options.cones.rounding == ConeRounding::QuarterTurns ? ChartTurns::Quarter
																: ChartTurns::Free;
}

void packCharts(
	Parametrization& map,
	bool normalize,
	double margin,
	const PlaceBoxes& placeBoxes,
	ChartTurns turns)
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
	const std::vector<char> isThin = widen(map.charts, std::max(extent, std::sqrt(area)), boxes);
	Packing packing = packBoxes(boxes, margin, placeBoxes);
	if (!normalize) {
		for (std::size_t i = 0; i < boxes.size(); ++i)
			place(
				map,
				map.charts[i],
				1.0,
				boxes.size() > 1 ? packing.motions[i].shift : Point2{0.0, 0.0},
				boxes[i]);
		requireFloats(map.uv);
		requireFloats(map.refined.uv);
		map.report.occupancy = coveredArea(map) / (packing.side() * packing.side());
		return;
	}
	if (turns != ChartTurns::None && packing.side() > 0.0 &&
		!(boxes.size() == 1 && isThin.front())) {
		const double room = std::max(packing.room, kMinOutlineRoom * packing.side());
		Packing turned =
			boxes.size() == 1
				? packAlone(map)
				: packByOutlines(map, boxes, isThin, packing, room, placeBoxes, turns);
		const double share = (1.0 + kMarginSpare) * margin; // of the square, on each side
		turned.room = share / (1.0 - 2.0 * share) * turned.whole.extent();
		if (!turned.motions.empty() && turned.side() <= (1.0 - kWorthTurning) * packing.side())
			packing = std::move(turned);
	}
	const Point2 corner{packing.whole.min[0] - packing.room, packing.whole.min[1] - packing.room};
	const double scale = 1.0 / packing.side();
	for (std::size_t i = 0; i < boxes.size(); ++i) {
		const Motion& motion = packing.motions[i];
		place(
			map,
			map.charts[i],
			scale * motion.turn,
			{(motion.shift[0] - corner[0]) * scale, (motion.shift[1] - corner[1]) * scale},
			boxes[i]);
	}
	clampToUnitSquare(map);
	map.report.occupancy = coveredArea(map);
}

void packStrips(
	Parametrization& map,
	double margin,
	const PlaceBoxes& placeBoxes,
	ChartTurns turns)
{
	std::optional<Parametrization> cut;
	if (turns != ChartTurns::None)
		cut = cutStrip(map, turns == ChartTurns::Free);
	packCharts(map, true, margin, placeBoxes, turns);
	if (!cut)
		return;
	try {
		packCharts(*cut, true, margin, placeBoxes, turns);
	}
	catch (const InvalidOption& e) {
		if (e.problem != InvalidOption::ChartMarginTooWide)
			throw;
		return; // there is no room for one chart more
	}
	if (cut->report.occupancy >= kWorthCutting * map.report.occupancy)
		map = std::move(*cut);
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
	map.report.occupancy = coveredArea(map);
	return squares;
}

void transformChart(
	Parametrization& map, const Chart& chart, std::complex<double> factor, const Point2& shift)
{
	const double re = factor.real(), im = factor.imag();
	const auto move = [&](Triangle2& triangle) {
		for (Point2& p : triangle)
			p = {re * p[0] - im * p[1] + shift[0], im * p[0] + re * p[1] + shift[1]};
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
