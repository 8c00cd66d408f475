// SPDX-License-Identifier: GPL-3.0-or-later
#include "outline_packing.h"

#include "../base/convex_hull.h"
#include "../base/indexed.h"
#include "../base/parallel.h"
#include "outline_cells.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

namespace ricci {

namespace {

/// Cells along a side of the square in which places are sought: at least, at most, and times the root of the number of
/// outlines; and cells in place of one of them, in which places are found.
constexpr int kMinCoarse = 192, kMaxCoarse = 2048, kCoarsePerRoot = 20, kFineInCoarse = 3;

/// A smaller square is sought as long as the last got smaller by its side divided by this.
constexpr int kGains = 256;

/// Angles below a right one in which an outline is tried, at most.
constexpr int kMaxAngles = 12;

/// Orders that are tried in coarse cells, and those of them that are tried in fine ones.
constexpr int kTries = 17;
constexpr std::size_t kFineTries = 3;

/// Coarse cells that a square may be wider than the smallest so far, which finer ones may make up for.
constexpr int kSlack = 4;

/// Rows of cells compared after which no further order is tried.
constexpr long long kMaxWork = 2'000'000;

double areaOf(const Outline& outline)
{
	double doubled = 0.0;
	for (const auto& side : outline)
		doubled += doubledArea(outline.front()[0], side[0], side[1]);
	return 0.5 * doubled;
}

using Order = std::vector<std::size_t>; // of outlines

/// The largest first, by their areas and those of their boxes: what is long or jagged finds no place late.
/// \param side of the square that is to hold them
Order orderOf(const std::vector<Outline>& outlines, double side)
{
	std::vector<double> areas;
	areas.reserve(outlines.size());
	for (const Outline& outline : outlines) {
		Box2 box;
		for (const auto& ends : outline)
			box.add(ends[0]);
		areas.push_back(areaOf(outline) + box.area());
	}
	return largestFirst(std::move(areas), side * side);
}

std::complex<double> turnToMinExtent(const Outline& outline)
{
	std::vector<Point2> points;
	points.reserve(outline.size());
	for (const auto& side : outline)
		points.push_back(side[0]);
	const OrientedRectangle r = minExtentRectangle(std::move(points));
	return {r.cosine, -r.sine};
}

/// Half the angle has this tangent, at most 1.
std::complex<double> rationalTurn(int numerator, int denominator)
{
	const double t = static_cast<double>(numerator) / denominator;
	return {(1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t)};
}

/// Outlines as they were placed.
struct Try
{
	int side = 0; ///< of the square
	Order order;
	std::vector<Motion> motions; ///< [outline]
	std::size_t last = 0;        ///< outline that reaches farthest, or that has no place
};

/// Places outlines below \p side.
/// \param first shape of the first one
/// \param shapes [outline] to choose from
/// \return without motions where one has no place
Try place(
	const Order& order,
	const Shape& first,
	const std::vector<std::vector<Shape>>& shapes,
	double cell,
	int side,
	Canvas& canvas)
{
	canvas.clear();
	Try result{0, order, std::vector<Motion>(order.size()), order.front()};
	const std::vector<Shape> ofFirst{first};
	for (const std::size_t i : order) {
		const Spot spot = canvas.put(i == order.front() ? ofFirst : shapes[i], side);
		if (!spot.shape)
			return {0, order, {}, i};
		result.motions[i] = spot.motion(cell);
		if (spot.cost[1] > result.side) {
			result.side = spot.cost[1];
			result.last = i;
		}
	}
	return result;
}

/// An outline in cells, in all its turns, as far as it fits into the square.
/// \param drawing of the square
/// \param count of angles below a right one, in which it is drawn if it turns freely
/// \param byExtent first in the turn in which the square round it is smallest, if it turns freely
std::vector<Shape>
shapesOf(const Outline& outline, ChartTurns turns, Drawing drawing, int count, bool byExtent)
{
	const bool isFree = turns == ChartTurns::Free;
	std::vector<std::complex<double>> angles; // below a right one
	if (isFree && byExtent)
		angles.push_back(turnToMinExtent(outline));
	for (int k = 0; k < (isFree ? count : 1); ++k)
		angles.push_back(rationalTurn(k, count));
	std::vector<Shape> shapes;
	for (std::complex<double> turn : angles)
		for (int q = 0; q < (turns == ChartTurns::None ? 1 : 4);
			 ++q, turn = {-turn.imag(), turn.real()})
			if (Shape shape; drawing.draw(outline, turn, shape)) {
				shape.quarterTurns = q;
				shapes.push_back(std::move(shape));
			}
	return shapes;
}

std::int64_t sidesOf(const std::vector<Outline>& outlines)
{
	std::int64_t sides = 0;
	for (const Outline& outline : outlines)
		sides += static_cast<std::int64_t>(outline.size());
	return sides;
}

/// Angles below a right one in which each of so many outlines is tried.
int anglesFor(std::size_t outlines)
{
	return std::clamp(256 / static_cast<int>(outlines), 2, kMaxAngles);
}

/// [outline] shapesOf() it.
/// \param inSquare how many outlines a square holds
/// \param isByExtent isByExtent(i) of each
template<class IsByExtent>
std::vector<std::vector<Shape>> shapesOf(
	const std::vector<Outline>& outlines,
	const std::vector<ChartTurns>& turns,
	const Drawing& drawing,
	std::size_t inSquare,
	const IsByExtent& isByExtent)
{
	std::vector<std::vector<Shape>> shapes(outlines.size());
	tasksInParallel(
		static_cast<int>(outlines.size()), threadsFor(sidesOf(outlines)), [&](int number) {
			const std::size_t i = positionOf(number);
			shapes[i] =
				shapesOf(outlines[i], turns[i], drawing, anglesFor(inSquare), isByExtent(i));
		});
	return shapes;
}

} // namespace

std::vector<std::size_t> largestFirst(std::vector<double> sizes, double whole)
{
	std::vector<std::size_t> order(sizes.size());
	std::iota(order.begin(), order.end(), std::size_t{0});
	for (double& size : sizes)
		size = std::round(1e9 * size / whole);
	std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
		return sizes[a] > sizes[b];
	});
	return order;
}

int coarseCells(std::size_t outlines)
{
	const int wanted = static_cast<int>(kCoarsePerRoot * std::sqrt(static_cast<double>(outlines)));
	return std::clamp(wanted, kMinCoarse, kMaxCoarse) / kWordBits * kWordBits;
}

std::size_t outlinesPerSquare(std::size_t outlines, double squares)
{
	const double share = std::ceil(static_cast<double>(outlines) / std::max(squares, 1.0));
	return static_cast<std::size_t>(share);
}

std::vector<Motion> packOutlines(
	const std::vector<Outline>& outlines,
	const std::vector<ChartTurns>& turns,
	double side,
	double padding)
{
	const double reach = 0.5 * padding;
	Order order = orderOf(outlines, side);
	const std::size_t largest = order.front();
	const int coarseSide = coarseCells(outlines.size()), fineSide = kFineInCoarse * coarseSide;
	std::vector<std::vector<Shape>> shapes = shapesOf(
		outlines, turns, Drawing(coarseSide, side, reach), outlines.size(), [&](std::size_t i) {
			return i == largest;
		});
	std::vector<std::size_t> firsts; // of the largest, below a right angle
	for (std::size_t k = 0; k < shapes[largest].size(); ++k)
		if (shapes[largest][k].quarterTurns == 0)
			firsts.push_back(k);
	if (std::any_of(shapes.begin(), shapes.end(), [](const auto& some) { return some.empty(); }))
		return {};

	Canvas canvas(coarseSide);
	std::vector<Try> tries;
	int minSide = coarseSide + 1;
	for (std::size_t t = 0; t < kTries && canvas.work() <= kMaxWork && !firsts.empty(); ++t) {
		const Shape& first = shapes[largest][firsts[t % firsts.size()]];
		const int below = std::min(minSide + kSlack, coarseSide + 1);
		Try next = place(order, first, shapes, side / coarseSide, below, canvas);
		// Earlier the next time, but not before the largest.
		const auto last = std::find(order.begin(), order.end(), next.last);
		std::rotate(order.begin() + (last - order.begin() + 1) / 2, last, last + 1);
		if (!next.motions.empty()) {
			minSide = std::min(minSide, next.side);
			tries.push_back(std::move(next));
		}
	}
	std::stable_sort(
		tries.begin(), tries.end(), [](const Try& a, const Try& b) { return a.side < b.side; });
	tries.resize(std::min(tries.size(), kFineTries));
	if (tries.empty())
		return {};

	// In the turns that were found, in finer cells, which may have other places, as long as the square gets smaller.
	double square = minSide * side / coarseSide;
	Canvas fineCanvas(fineSide);
	std::vector<Motion> best = tries.front().motions;
	for (auto t = tries.begin(); t != tries.end();) {
		Drawing fine(fineSide, square, reach);
		bool fits = true;
		for (std::size_t i = 0; i < outlines.size(); ++i) {
			shapes[i].resize(1);
			fits = fits && fine.draw(outlines[i], t->motions[i].turn, shapes[i][0]);
		}
		Try next;
		if (fits)
			next = place(
				t->order,
				shapes[largest][0],
				shapes,
				fine.cell(),
				fineSide - fineSide / kGains,
				fineCanvas);
		if (next.motions.empty())
			++t;
		else {
			square = next.side * fine.cell();
			best = std::move(next.motions);
		}
	}
	return best;
}

std::vector<std::pair<int, Motion>> packIntoTiles(
	const std::vector<Outline>& outlines,
	const std::vector<ChartTurns>& turns,
	double side,
	double padding)
{
	std::vector<double> areas; // of squares
	areas.reserve(outlines.size());
	for (const Outline& outline : outlines)
		areas.push_back(areaOf(outline) / (side * side));
	const double squares = std::max(1.0, std::accumulate(areas.begin(), areas.end(), 0.0));
	const std::size_t inSquare = outlinesPerSquare(outlines.size(), squares);
	const int cells = kFineInCoarse * coarseCells(inSquare);
	const std::vector<std::vector<Shape>> shapes =
		shapesOf(outlines, turns, Drawing(cells, side, 0.5 * padding), inSquare, [](std::size_t) {
			return true;
		});
	std::vector<std::pair<int, Motion>> places(outlines.size());
	Order left = orderOf(outlines, side);
	Canvas canvas(cells);
	for (int tile = 0; !left.empty(); ++tile) {
		canvas.clear();
		Order next;
		double room = 1.0;
		for (const std::size_t i : left) {
			if (shapes[i].empty())
				return {};
			// An outline that covers itself may have a larger area than the square.
			const bool isFirst = room == 1.0, isLooked = areas[i] <= room || isFirst;
			const Spot spot = isLooked ? canvas.put(shapes[i], cells + 1) : Spot();
			if (!spot.shape) {
				next.push_back(i);
				continue;
			}
			places[i] = {tile, spot.motion(side / cells)};
			room -= areas[i];
		}
		left = std::move(next);
	}
	return places;
}

} // namespace ricci
