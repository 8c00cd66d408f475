// SPDX-License-Identifier: GPL-3.0-or-later
#include "pack.h"

#include "../base/convex_hull.h"
#include "../base/parallel.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "boxes_side_by_side.h"
#include "separate_charts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace ricci {

namespace {

/// Attempts to find the padding between charts, which grows with the square that holds them.
constexpr int kMaxAttempts = 60;

/// A lone chart lies along the axes if the square round it is wider by no more than this share. Nets of boxes, which
/// mostly are one chart, stay below it; a strip ten times as long as wide fills a tenth of the square in place of a sixth.
constexpr double kUprightCost = 0.1;

/// Charts that are placed by their outlines at most: the time for them grows faster than their number.
constexpr std::size_t kMaxOutlines = 4096;

/// A chart is placed by its outline if its box is longer than so many of the cells in which places are sought.
constexpr double kMinOutlineCells = 3.0;

/// A square of cells, which take more room than outlines do, is wider by this factor than that of the boxes.
constexpr double kWider = 1.1;

/// Widens the boxes of charts about their middles, where a side is shorter than kThinSide times the room
/// that the chart's triangles want: to be given a height they lie side by side in two directions.
/// \param side of a square that holds all
/// \return [box] 1 for those that are thinner than kBoxRoom, which are not turned
std::vector<char>
widen(const std::vector<std::vector<int>>& triangles, double side, std::vector<Box2>& boxes)
{
	std::vector<char> isThin(boxes.size(), 0);
	for (std::size_t i = 0; i < boxes.size(); ++i) {
		const double count = static_cast<double>(triangles[i].size());
		const double room = side * (kBoxRoom * (1.0 + 0.25 * std::sqrt(count)));
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
	for (Point2& p : map.mesh.place)
		for (double& x : p)
			x = std::min(std::max(x, 0.0), 1.0);
	for (Chart& chart : map.charts)
		for (Point2* p : {&chart.box.min, &chart.box.max})
			for (double& x : *p)
				x = std::min(std::max(x, 0.0), 1.0);
}

double coveredArea(const FlatMesh& mesh)
{
	double doubled = 0.0;
	for (const int f : mesh.points.indices()) {
		const Triangle2 t = mesh.at(f);
		doubled += std::abs(doubledArea(t));
	}
	return 0.5 * doubled;
}

/// Charts in a square: their motions, the box round them and the padding between it and the square.
struct Packing
{
	std::vector<Motion> motions; ///< [chart]
	Box2 whole;
	double padding = 0.0;

	double side() const { return whole.extent() + 2.0 * padding; }
};

/// By boxes alone.
/// \return without motions where they do not fit with the margin
Packing packBoxes(const std::vector<Box2>& boxes, double margin, const PlaceBoxes& placeBoxes)
{
	// The margin is a share of a square that grows with the margin.
	Packing packing;
	double size = 0.0;
	for (int attempt = 0; attempt == 0 || packing.padding < margin * size; ++attempt) {
		if (attempt == kMaxAttempts || !marginsMayFit(boxes.size(), margin))
			return {};
		packing = {};
		packing.padding = (1.0 + kMarginSpare) * margin * size;
		const std::vector<Point2> shift = placeBoxes(boxes, packing.padding);
		for (std::size_t i = 0; i < boxes.size(); ++i) {
			packing.whole.add(boxes[i].min + shift[i]);
			packing.whole.add(boxes[i].max + shift[i]);
			packing.motions.push_back({1.0, asComplex(shift[i])});
		}
		size = packing.side();
	}
	return packing;
}

/// One chart, turned so that the square round it is smallest, or upright where that costs little.
Packing packAlone(const FlatMesh& mesh, bool isUpright)
{
	const OrientedRectangle r = minExtentRectangle(mesh.place.values());
	const Box2 box = mesh.box();
	Packing packing;
	if (isUpright && box.extent() <= (1.0 + kUprightCost) * r.extent()) {
		packing.motions.emplace_back();
		packing.whole = box;
		return packing;
	}
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

/// Moves the charts and their boxes. A chart that is turned by less than a right angle gets its own box.
void place(const std::vector<Motion>& motions, const std::vector<Box2>& boxes, Parametrization& map)
{
	moveCharts(motions, map.mesh);
	std::vector<Box2> own = map.mesh.boxes(boxes.size());
	for (std::size_t i = 0; i < boxes.size(); ++i) {
		const Motion& motion = motions[i];
		Box2& box = map.charts[i].box;
		box = {};
		if (motion.turn.real() != 0.0 && motion.turn.imag() != 0.0)
			box = own[i];
		else
			for (const Point2& p : {boxes[i].min, boxes[i].max})
				box.add(motion(p));
	}
}

/// What packByOutlines() packs.
struct OutlineTask
{
	const FlatMesh& mesh;
	const std::vector<std::vector<int>>& triangles; ///< [chart]
	const std::vector<Box2>& boxes;                 ///< [chart]
	const std::vector<char>& isThin;                ///< [chart]
	const std::vector<char>& isUpright;             ///< [chart] turned by right angles only
	double side;                                    ///< of the square that holds the boxes
	double padding;                                 ///< between charts
};

/// The largest charts by their outlines, the others in one box.
/// \return without motions where they need more than that square and some more
Packing packByOutlines(const OutlineTask& task, const PlaceBoxes& placeBoxes, ChartTurns turns)
{
	const auto& [mesh, triangles, boxes, isThin, isUpright, side, padding] = task;
	std::vector<std::size_t> order(boxes.size());
	std::iota(order.begin(), order.end(), std::size_t{0});
	const auto area = [&boxes = boxes](std::size_t i) {
		return boxes[i].width() * boxes[i].height();
	};
	const double square = side * side;
	std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
		return roundedShare(area(a), square) > roundedShare(area(b), square);
	});
	std::vector<std::size_t> large, small;
	double areaOfLarge = 0.0, areaOfSmall = 0.0;
	const double least = kMinOutlineCells * side / coarseCells(boxes.size());
	for (const std::size_t i : order) {
		const bool isLarge = large.size() < kMaxOutlines && !isThin[i] && boxes[i].extent() > least;
		(isLarge ? large : small).push_back(i);
		(isLarge ? areaOfLarge : areaOfSmall) += area(i);
	}
	if (large.empty() || areaOfLarge < areaOfSmall)
		return {};
	std::vector<Outline> outlines(large.size());
	tasksInParallel(
		static_cast<int>(large.size()),
		threadsFor(mesh.size() / 32),
		[&, &mesh = mesh, &triangles = triangles](int k) {
			outlines[positionOf(k)] = outlineOf(mesh, triangles[large[positionOf(k)]]);
		});
	if (std::any_of(outlines.begin(), outlines.end(), [](const Outline& o) { return o.empty(); }))
		return {}; // without area
	std::vector<Box2> smallBoxes;
	smallBoxes.reserve(small.size());
	for (const std::size_t i : small)
		smallBoxes.push_back(boxes[i]);
	const std::vector<Point2> shift = placeBoxes(smallBoxes, padding);
	Box2 ofSmall;
	for (std::size_t k = 0; k < small.size(); ++k) {
		ofSmall.add(smallBoxes[k].min + shift[k]);
		ofSmall.add(smallBoxes[k].max + shift[k]);
	}
	std::vector<ChartTurns> turnsOf(large.size(), turns);
	for (std::size_t k = 0; k < large.size(); ++k)
		if (isUpright[large[k]])
			turnsOf[k] = ChartTurns::Quarter;
	if (!small.empty()) {
		outlines.push_back(borderOf(ofSmall));
		turnsOf.push_back(ChartTurns::Quarter); // their boxes stay upright
	}
	const std::vector<Motion> motions =
		packOutlines(outlines, turnsOf, kWider * side - padding, padding);
	if (motions.empty())
		return {};
	Packing packing;
	for (std::size_t k = 0; k < outlines.size(); ++k)
		for (auto& ends : outlines[k])
			for (Point2& p : ends) {
				p = motions[k](p);
				packing.whole.add(p);
			}
	if (!keepApart(outlines, (1.0 - kMarginSpare) * padding))
		return {};
	packing.motions.resize(boxes.size());
	for (std::size_t k = 0; k < large.size(); ++k)
		packing.motions[large[k]] = motions[k];
	for (std::size_t k = 0; k < small.size(); ++k)
		packing.motions[small[k]] = {motions.back().turn, asComplex(motions.back()(shift[k]))};
	return packing;
}

/// Lays charts along the axes that have an upright turn.
/// \return [chart] 1 for these
std::vector<char> turnUpright(const std::vector<std::vector<int>>& triangles, FlatMesh& mesh)
{
	std::vector<char> isUpright(triangles.size(), 0);
	std::vector<Motion> motions(triangles.size());
	tasksInParallel(
		static_cast<int>(triangles.size()), threadsFor(mesh.size() / 32), [&](int chart) {
			const std::size_t i = positionOf(chart);
			const std::complex<double> turn = uprightTurn(outlineOf(mesh, triangles[i]));
			isUpright[i] = turn != 0.0;
			if (isUpright[i])
				motions[i].turn = turn;
		});
	moveCharts(motions, mesh);
	return isUpright;
}

void requireFloats(const Array<Point2>& places)
{
	using Float = std::numeric_limits<float>;
	// The steps of floats become no smaller below the normal numbers.
	const double smallest =
		static_cast<double>(Float::min()) / static_cast<double>(Float::epsilon());
	double largest = 0.0;
	for (const Point2& p : places)
		for (double x : p) {
			if (!(std::abs(x) <= static_cast<double>(Float::max())))
				throw InvalidMesh(InvalidMesh::BeyondFloats);
			largest = std::max(largest, std::abs(x));
		}
	if (largest > 0.0 && largest < smallest)
		throw InvalidMesh(InvalidMesh::BeyondFloats);
}

/// packCharts() into the unit square, without cuts.
void packIntoSquare(Parametrization& map, const PackOptions& options, ChartTurns turns)
{
	const auto triangles = map.mesh.trianglesByChart(map.charts.size());
	std::vector<char> isUpright(triangles.size(), 0);
	if (turns == ChartTurns::Free && options.turns != ChartTurns::None)
		isUpright = turnUpright(triangles, map.mesh);
	std::vector<Box2> boxes = map.mesh.boxes(map.charts.size());
	// The square that holds all has this side at least.
	double area = 0.0, extent = 0.0;
	for (const Box2& box : boxes) {
		area += box.width() * box.height();
		extent = std::max(extent, box.extent());
	}
	const std::vector<char> isThin = widen(triangles, std::max(extent, std::sqrt(area)), boxes);
	const PlaceBoxes& asked = options.placeBoxes ? options.placeBoxes : sideBySide;
	const PlaceBoxes placeBoxes = [&](const std::vector<Box2>& some, double padding) {
		std::vector<Point2> places = asked(some, padding);
		if (places.size() != some.size())
			throw InvalidOption(
				InvalidOption::BoxPlaces, static_cast<double>(places.size()), 0.0, some.size());
		return places;
	};
	double margin = options.chartMargin;
	Packing packing = packBoxes(boxes, margin, placeBoxes);
	while (packing.motions.empty())
		packing = packBoxes(boxes, margin *= 0.5, placeBoxes);
	map.report.margin = margin;
	const ChartTurns mayTurn = std::min(turns, options.turns);
	if (mayTurn != ChartTurns::None && packing.side() > 0.0 &&
		!(boxes.size() == 1 && (isThin.front() || options.turns == ChartTurns::Quarter))) {
		const double padding = std::max(packing.padding, kMinPadding * packing.side());
		Packing turned =
			boxes.size() == 1
				? packAlone(map.mesh, isUpright.front() != 0)
				: packByOutlines(
					  {map.mesh, triangles, boxes, isThin, isUpright, packing.side(), padding},
					  placeBoxes,
					  mayTurn);
		const double share = (1.0 + kMarginSpare) * margin; // of the square, on each side
		turned.padding = share / (1.0 - 2.0 * share) * turned.whole.extent();
		if (!turned.motions.empty() && turned.side() <= (1.0 - kWorthTurning) * packing.side())
			packing = std::move(turned);
	}
	const std::complex<double> corner(
		packing.whole.min[0] - packing.padding, packing.whole.min[1] - packing.padding);
	const double scale = 1.0 / packing.side();
	for (Motion& motion : packing.motions)
		motion = {scale * motion.turn, scale * (motion.shift - corner)};
	place(packing.motions, boxes, map);
	clampToUnitSquare(map);
	map.report.occupancy = coveredArea(map.mesh);
}

/// packCharts() into the unit square, with cuts.
void packWithCuts(Parametrization& map, const PackOptions& options, ChartTurns turns)
{
	packIntoSquare(map, options, turns);
	if (std::min(turns, options.turns) == ChartTurns::None)
		return;
	const double area = map.mesh.area();
	const auto worth = [&](const Parametrization& m) {
		return std::log(m.report.occupancy) -
			   kPackingPrice * std::log(std::sqrt(area) + m.report.seamLength);
	};
	// What cuts and packing change, where the map is not the best.
	std::optional<
		std::tuple<Array<Triangle>, Array<Point2>, Array<int>, std::vector<Chart>, Report>>
		best;
	double most = worth(map);
	double loss = 0.0; // prices of the vain cuts together
	bool isEnded = false;
	for (int cuts = 0, vain = 0; loss < kMaxLoss; ++cuts) {
		if (!best && map.report.occupancy > kEnoughCovered)
			break;
		isEnded = cuts == kMaxCuts;
		const std::optional<ChartCut> cut = isEnded ? std::nullopt : findCutForPacking(map, area);
		if (!cut)
			break;
		if (!best)
			best.emplace(map.mesh.points, map.mesh.place, map.mesh.chart, map.charts, map.report);
		cutChart(*cut, turns == ChartTurns::Free, map);
		const double margin = map.report.margin;
		packIntoSquare(map, options, turns);
		if (map.report.margin < margin)
			break; // there is no room for one chart more
		++vain;
		const double reached = worth(map);
		const double seams = std::sqrt(area) + map.report.seamLength;
		loss += kPackingPrice * std::log(seams / (seams - cut->length));
		if (reached > most + vain * kMinRoom) {
			best.reset();
			most = reached;
			vain = 0;
			loss = 0.0;
		}
	}
	if (best)
		std::tie(map.mesh.points, map.mesh.place, map.mesh.chart, map.charts, map.report) =
			*std::move(best);
	if (isEnded) {
		++map.report.endedEarly;
		logLine(
			"Cuts for packing stopped at " + std::to_string(kMaxCuts) +
			": more cuts could still fill slightly more of the square.");
	}
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

void packCharts(Parametrization& map, const PackOptions& options, ChartTurns turns, bool mayCut)
{
	checkChartMargin(options.chartMargin);
	const Array<Point2> before = map.mesh.place;
	const double area = coveredArea(map.mesh);
	if (mayCut)
		packWithCuts(map, options, turns);
	else
		packIntoSquare(map, options, turns);
	if (options.normalizeUV)
		return;
	if (map.charts.size() == 1) {
		map.mesh.place = before;
		packIntoSquare(map, options, ChartTurns::None);
	}
	const double covered = coveredArea(map.mesh),
				 scale = covered > 0.0 ? std::sqrt(area / covered) : 1.0;
	for (Point2& p : map.mesh.place)
		p *= scale;
	for (Chart& chart : map.charts)
		for (Point2* p : {&chart.box.min, &chart.box.max})
			*p *= scale;
	requireFloats(map.mesh.place);
}

void placeDisks(Parametrization& map)
{
	const int perRow =
		static_cast<int>(std::ceil(std::sqrt(static_cast<double>(map.charts.size()))));
	const double side = 1.0 / perRow;
	std::vector<Motion> motions;
	for (Chart& chart : map.charts) {
		const int i = static_cast<int>(motions.size()), row = i / perRow;
		Box2& square = chart.box;
		square = {};
		square.min = {side * (i % perRow), side * row};
		square.max = {square.min[0] + side, square.min[1] + side};
		motions.push_back({0.5 * side, asComplex(square.centre())});
	}
	moveCharts(motions, map.mesh);
	clampToUnitSquare(map);
	map.report.occupancy = coveredArea(map.mesh);
}

void moveCharts(const std::vector<Motion>& motions, FlatMesh& mesh)
{
	const Array<int> chart = mesh.chartOfPoints();
	for (const int p : chart.indices())
		mesh.place[p] = motions[positionOf(chart[p])](mesh.place[p]);
}

} // namespace ricci
