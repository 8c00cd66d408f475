// SPDX-License-Identifier: GPL-3.0-or-later
#include "pack_items.h"

#include "../base/numbers.h"
#include "../base/parallel.h"
#include "../base/tolerances.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

namespace ricci {

namespace {

/// Charts that are placed by their outlines at most: the time for them grows faster than their number.
constexpr std::size_t kMaxOutlines = 4096;

/// A chart is placed by its outline if its box is longer than so many of the cells in which places are sought.
constexpr double kMinOutlineCells = 3.0;

Outline borderOf(const Box2& box)
{
	const Point2 &a = box.min, &c = box.max;
	const Point2 b{c[0], a[1]}, d{a[0], c[1]};
	return {{a, b}, {b, c}, {c, d}, {d, a}};
}

/// Adds one item for small charts, or one for each half of them if their box is too long.
/// \pre no chart alone is longer
void addBox(
	const std::vector<std::size_t>& small,
	const std::vector<Box2>& boxes,
	const PackSquare& square,
	PackItems& items)
{
	std::vector<Box2> own;
	own.reserve(small.size());
	for (const std::size_t i : small)
		own.push_back(boxes[i]);
	const std::vector<Point2> shift = sideBySide(own, square.padding);
	Box2 all;
	for (std::size_t k = 0; k < small.size(); ++k) {
		all.add(own[k].min + shift[k]);
		all.add(own[k].max + shift[k]);
	}
	if (all.extent() > square.longestBox && small.size() > 1) {
		const auto middle = small.begin() + static_cast<std::ptrdiff_t>(small.size() / 2);
		addBox({small.begin(), middle}, boxes, square, items);
		addBox({middle, small.end()}, boxes, square, items);
		return;
	}
	for (std::size_t k = 0; k < small.size(); ++k) {
		items.itemOf[small[k]] = items.outlines.size();
		items.shiftOf[small[k]] = shift[k];
	}
	items.outlines.push_back(borderOf(all));
	items.turns.push_back(ChartTurns::Quarter); // their boxes stay upright
}

/// Widths of rows that are tried, each wider by this share of the first.
constexpr int kWidths = 12;
constexpr double kWiderRow = 0.03;

/// In rows of some width: places, and the side of the square that holds them. A gap keeps the rounded sums, and floats
/// of them, apart.
std::pair<double, std::vector<Point2>> onShelves(
	const std::vector<Box2>& boxes, const std::vector<std::size_t>& order, double width, double gap)
{
	double side = 0.0, x = 0.0, floor = 0.0, height = 0.0;
	std::vector<Point2> shifts(boxes.size());
	for (const std::size_t i : order) {
		if (x + boxes[i].width() > width) {
			x = 0.0;
			floor += height + gap;
			height = 0.0;
		}
		shifts[i] = {x - boxes[i].min[0], floor - boxes[i].min[1]};
		x += boxes[i].width() + gap;
		height = std::max(height, boxes[i].height());
		side = std::max({side, x, floor + height});
	}
	return {side, std::move(shifts)};
}

/// Side that a square needs at least to hold boxes.
double leastSquare(const std::vector<Box2>& boxes)
{
	double longest = 0.0, area = 0.0;
	for (const Box2& box : boxes) {
		longest = std::max(longest, box.extent());
		area += box.area();
	}
	return std::max(longest, std::sqrt(area));
}

} // namespace

std::vector<Point2> sideBySide(std::vector<Box2> boxes, double padding)
{
	if (boxes.size() <= 1)
		return std::vector<Point2>(boxes.size(), Point2{0.0, 0.0});
	for (Box2& box : boxes)
		for (std::size_t k = 0; k < 2; ++k) {
			box.min[k] -= 0.5 * padding;
			box.max[k] += 0.5 * padding;
		}
	const double root = leastSquare(boxes), gap = 1e-6 * root;
	std::vector<double> heights;
	heights.reserve(boxes.size());
	for (const Box2& box : boxes)
		heights.push_back(box.height());
	const std::vector<std::size_t> order = largestFirst(std::move(heights), root);
	auto best = onShelves(boxes, order, root, gap);
	for (int i = 1; i < kWidths; ++i)
		if (auto next = onShelves(boxes, order, (1.0 + kWiderRow * i) * root, gap);
			next.first < best.first)
			best = std::move(next);
	return best.second;
}

std::complex<double> uprightTurn(const Outline& outline)
{
	constexpr int kDegrees = 90; // directions modulo a right angle
	// Fourth powers of directions: those at right angles are one.
	std::vector<std::complex<double>> fourth;
	std::array<double, kDegrees> lengths{};
	double total = 0.0;
	for (const auto& s : outline) {
		const std::complex<double> side = asComplex(s[1] - s[0]);
		const double length = std::abs(side);
		const std::complex<double> square = length > 0.0 ? side / length * (side / length) : 0.0;
		fourth.push_back(length * square * square);
		total += length;
		const double angle = kDegrees * (0.5 + std::arg(fourth.back()) / (2.0 * kPi));
		lengths[positionOf(std::clamp(static_cast<int>(angle), 0, kDegrees - 1))] += length;
	}
	const auto around = [&](int degree) {
		return lengths[positionOf((degree + kDegrees - 1) % kDegrees)] +
			   lengths[positionOf(degree)] + lengths[positionOf((degree + 1) % kDegrees)];
	};
	int best = 0;
	for (int degree = 1; degree < kDegrees; ++degree)
		if (around(degree) > around(best))
			best = degree;
	std::complex<double> mean = std::polar(1.0, 2.0 * kPi * ((best + 0.5) / kDegrees - 0.5));
	double straight = 0.0;
	for (const double degrees : {2.0, 1.0}) { // about the middle of these three, then their mean
		const std::complex<double> middle = mean / std::abs(mean);
		mean = 0.0;
		straight = 0.0;
		for (const std::complex<double>& side : fourth)
			if ((side * std::conj(middle)).real() >
				std::cos(4.0 * degrees * kPi / 180.0) * std::abs(side)) {
				mean += side;
				straight += std::abs(side);
			}
		if (!(2.0 * straight > total))
			return 0.0;
	}
	return std::conj(std::sqrt(std::sqrt(mean / std::abs(mean))));
}

void moveCharts(const std::vector<Motion>& motions, FlatMesh& mesh)
{
	const Array<int> chart = mesh.chartOfPoints();
	for (const int p : chart.indices())
		mesh.place[p] = motions[positionOf(chart[p])](mesh.place[p]);
}

namespace {

/// The sides of a chart's triangles, each taken counter-clockwise, except for two that are joined and run
/// opposite ways. A point off them is covered by as many triangles as they go round it.
Outline outlineOf(const FlatMesh& mesh, const std::vector<int>& triangles)
{
	const auto hasNegativeArea = [&](int f) { return doubledArea(mesh.at(f)) < 0.0; };
	const bool hasFlipped = std::any_of(triangles.begin(), triangles.end(), hasNegativeArea);
	const auto isFlipped = [&](int f) { return hasFlipped && hasNegativeArea(f); };
	Outline outline;
	for (const int f : triangles)
		for (const Corner side : cornersOf(f)) {
			const Corner other = mesh.joined(side);
			if (other.isValid() && isFlipped(f) == isFlipped(other.face()))
				continue;
			const auto [a, b] = mesh.ends(side);
			if (a != b)
				outline.push_back(isFlipped(f) ? std::array{b, a} : std::array{a, b});
		}
	std::sort(outline.begin(), outline.end());
	return outline;
}

/// \param triangles [chart]
/// \return [chart] 1 for those that have an uprightTurn(), and now lie along the axes
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

/// \param side of a square that holds charts
/// \return [box] 1 for those that are thin
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

} // namespace

ChartsToPack
chartsToPack(const PackOptions& options, ChartTurns turns, std::size_t count, FlatMesh& mesh)
{
	ChartsToPack charts;
	charts.turns = std::min(turns, options.turns);
	charts.triangles = mesh.trianglesByChart(count);
	charts.isUpright.assign(count, 0);
	if (turns == ChartTurns::Free && options.turns != ChartTurns::None)
		charts.isUpright = turnUpright(charts.triangles, mesh);
	charts.boxes = mesh.boxes(count);
	const double side = options.tileSide > 0.0 ? 1.0 : leastSquare(charts.boxes);
	charts.isThin = widen(charts.triangles, side, charts.boxes);
	return charts;
}

PackItems packItems(const FlatMesh& mesh, const ChartsToPack& charts, const PackSquare& square)
{
	const std::vector<Box2>& boxes = charts.boxes;
	std::vector<double> areas;
	areas.reserve(boxes.size());
	for (const Box2& box : boxes)
		areas.push_back(box.area());
	const std::vector<std::size_t> order = largestFirst(areas, square.side * square.side);
	std::vector<std::size_t> large, small;
	const double least = kMinOutlineCells * square.side / coarseCells(square.charts);
	for (const std::size_t i : order) {
		const bool isLarge =
			large.size() < kMaxOutlines && !charts.isThin[i] && boxes[i].extent() > least;
		(isLarge ? large : small).push_back(i);
	}
	PackItems items;
	items.itemOf.resize(boxes.size());
	items.shiftOf.resize(boxes.size(), {0.0, 0.0});
	items.outlines.resize(large.size());
	tasksInParallel(static_cast<int>(large.size()), threadsFor(mesh.size() / 32), [&](int k) {
		const std::size_t i = large[positionOf(k)];
		Outline& outline = items.outlines[positionOf(k)];
		outline = outlineOf(mesh, charts.triangles[i]);
		if (outline.empty()) // what has no area has none
			outline = borderOf(boxes[i]);
	});
	for (const std::size_t i : large) {
		items.itemOf[i] = items.turns.size();
		items.turns.push_back(
			charts.isUpright[i] ? std::min(charts.turns, ChartTurns::Quarter) : charts.turns);
	}
	if (!small.empty())
		addBox(small, boxes, square, items);
	return items;
}

} // namespace ricci
