// SPDX-License-Identifier: GPL-3.0-or-later
#include "outline_packing.h"

#include "../base/task.h"
#include "../math/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace ricci {

namespace {

constexpr int kWordBits = 64;

/// Cells along a side of the square.
constexpr int kLevels = 9, kCells = 1 << (kLevels - 1);

/// Rows of cells compared after which no further angle of the largest chart is tried.
constexpr long long kMaxWork = 4'000'000;

/// Cells of a row that are taken, in its bits.
using Row = std::array<std::uint64_t, kCells / kWordBits>;

/// Adds the cells of \p row, moved to lower places, to the first \p count words.
void addMovedDown(const Row& row, int cells, std::size_t count, Row& sum)
{
	const auto words = static_cast<std::size_t>(cells / kWordBits);
	const int bits = cells % kWordBits;
	count = std::min(count, row.size() - words);
	for (std::size_t i = 0; i < count; ++i) {
		sum[i] |= row[i + words] >> bits;
		if (bits > 0 && i + words + 1 < row.size())
			sum[i] |= row[i + words + 1] << (kWordBits - bits);
	}
}

void fill(Row& row, int first, int last)
{
	for (int x = first; x < last;) {
		const int bit = x % kWordBits, count = std::min(kWordBits - bit, last - x);
		const std::uint64_t ones =
			count == kWordBits ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
		row[static_cast<std::size_t>(x / kWordBits)] |= ones << bit;
		x += count;
	}
}

/// Place of the lowest bit of \p word, which is not 0.
int lowestBit(std::uint64_t word)
{
	int bit = 0;
	for (int half = kWordBits / 2; half > 0; half /= 2)
		if (word << (kWordBits - half) == 0) {
			word >>= half;
			bit += half;
		}
	return bit;
}

/// The first cell, not before \p x, that is taken or that is free, or kCells.
int nextCell(const Row& row, int x, bool taken)
{
	while (x < kCells) {
		const std::uint64_t word = row[static_cast<std::size_t>(x / kWordBits)];
		const std::uint64_t rest = (taken ? word : ~word) >> (x % kWordBits);
		if (rest != 0)
			return x + lowestBit(rest);
		x += kWordBits - x % kWordBits;
	}
	return kCells;
}

/// Cells of one row, from first to before last.
struct Run
{
	int row, first, last;
};

/// An outline that is turned, in cells from the lower left corner of a box round it.
struct Shape
{
	Motion motion;   ///< brings that corner to the origin
	int quarter = 0; ///< right angles that it is turned by besides
	int width = 0, height = 0;
	std::vector<Run> runs; ///< longest first
};

/// Draws outlines in cells, in buffers that it keeps.
class Drawing
{
public:
	/// \param reach taken, too: what is nearer than this along both axes
	Drawing(double cell, double reach) : m_cell(cell), m_reach(reach / cell) {}

	/// \return whether it fits into the square
	bool draw(const Outline& outline, std::complex<double> turn, Shape& shape)
	{
		shape.motion = {turn, {0.0, 0.0}};
		m_sides.clear();
		Box2 box;
		for (const auto& side : outline) {
			m_sides.push_back({shape.motion(side[0]), shape.motion(side[1])});
			box.add(m_sides.back()[0]);
		}
		const double reach = m_reach * m_cell;
		shape.motion.shift = {reach - box.min[0], reach - box.min[1]};
		shape.width = cellAt(box.width() / m_cell + 2 * m_reach) + 1;
		shape.height = cellAt(box.height() / m_cell + 2 * m_reach) + 1;
		if (std::max(shape.width, shape.height) > kCells)
			return false;
		std::fill_n(m_rows.begin(), shape.height, Row{});
		for (auto& side : m_sides) {
			for (Point2& p : side)
				p = {
					(p[0] + shape.motion.shift.real()) / m_cell,
					(p[1] + shape.motion.shift.imag()) / m_cell};
			drawSide(side, shape);
		}
		fillBetween(shape.height);
		findRuns(shape);
		return true;
	}

private:
	struct Crossing
	{
		double x;
		int turns; // 1 where the side runs down, the outline's inner side on its right

		bool operator<(const Crossing& other) const { return x < other.x; }
	};

	/// The first one where \p x is negative.
	static int cellAt(double x) { return static_cast<int>(std::max(x, 0.0)); }

	void drawSide(const std::array<Point2, 2>& side, const Shape& shape)
	{
		const bool up = side[0][1] < side[1][1];
		const Point2 &low = up ? side[0] : side[1], &high = up ? side[1] : side[0];
		const double slope = high[1] > low[1] ? (high[0] - low[0]) / (high[1] - low[1]) : 0.0;
		const auto xAt = [&](double y) {
			return y <= low[1] ? low[0] : y >= high[1] ? high[0] : low[0] + slope * (y - low[1]);
		};
		const int last = std::min(cellAt(high[1] + m_reach), shape.height - 1);
		for (int y = cellAt(low[1] - m_reach); y <= last; ++y) {
			double from = xAt(y - m_reach), to = xAt(y + 1 + m_reach);
			if (low[1] == high[1]) {
				from = low[0];
				to = high[0];
			}
			const auto row = static_cast<std::size_t>(y);
			fill(
				m_rows[row],
				cellAt(std::min(from, to) - m_reach),
				std::min(cellAt(std::max(from, to) + m_reach) + 1, shape.width));
			const double middle = y + 0.5;
			if (low[1] <= middle && middle < high[1])
				m_crossings[row].push_back({xAt(middle), up ? -1 : 1});
		}
	}

	void fillBetween(int height)
	{
		for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
			std::vector<Crossing>& crossings = m_crossings[y];
			std::sort(crossings.begin(), crossings.end());
			int turns = 0; // 0 again at the end
			for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
				turns += crossings[i].turns;
				if (turns != 0)
					fill(m_rows[y], cellAt(crossings[i].x), cellAt(crossings[i + 1].x) + 1);
			}
			crossings.clear();
		}
	}

	void findRuns(Shape& shape)
	{
		m_runs.clear();
		std::array<std::size_t, kCells + 1> longer{}; // [length] runs
		for (int y = 0; y < shape.height; ++y) {
			const Row& row = m_rows[static_cast<std::size_t>(y)];
			for (int first = nextCell(row, 0, true); first < kCells;) {
				const int last = nextCell(row, first, false);
				m_runs.push_back({y, first, last});
				++longer[static_cast<std::size_t>(last - first) - 1];
				first = nextCell(row, last, true);
			}
		}
		std::partial_sum(longer.rbegin(), longer.rend(), longer.rbegin());
		shape.runs.resize(m_runs.size());
		for (const Run& run : m_runs)
			shape.runs[longer[static_cast<std::size_t>(run.last - run.first)]++] = run;
	}

	double m_cell, m_reach;                     // m_reach in cells
	std::vector<std::array<Point2, 2>> m_sides; // in cells
	std::array<Row, kCells> m_rows;
	std::array<std::vector<Crossing>, kCells> m_crossings; // [row]
	std::vector<Run> m_runs;
};

/// Less is better: the side of the square, then how far out the shape lies.
using Cost = std::array<int, 3>;

struct Spot
{
	Cost cost{std::numeric_limits<int>::max(), 0, 0};
	const Shape* shape = nullptr;
	int x = 0, y = 0;
};

class Canvas
{
public:
	int side() const { return m_side; }
	long long work() const { return m_work; }

	/// Takes a better place of \p shape than \p best, if there is one.
	void look(const Shape& shape, Spot& best)
	{
		m_runs = shape.runs;
		for (int y = 0; y + shape.height <= farthest(best); ++y) {
			const int last = farthest(best) - shape.width; // of x
			if (last < 0)
				return;
			const std::size_t words = static_cast<std::size_t>(last / kWordBits) + 1;
			Row blocked{};
			fill(blocked, last + 1, kCells);
			for (std::size_t i = 0; i < m_runs.size(); ++i) {
				block(m_runs[i], y, words, blocked);
				++m_work;
				if (std::all_of(blocked.begin(), blocked.begin() + words, [](std::uint64_t w) {
						return w == ~std::uint64_t{0};
					})) {
					std::swap(m_runs[i], m_runs[i / 2]); // it blocks the next row, too
					break;
				}
			}
			const int x = nextCell(blocked, 0, false);
			if (x == kCells)
				continue;
			const int right = x + shape.width, top = y + shape.height;
			const Cost cost{
				std::max({m_side, right, top}), std::max(right, top), right + top + x + y};
			if (cost < best.cost)
				best = {cost, &shape, x, y};
		}
	}

	void take(const Spot& spot)
	{
		for (const Run& run : spot.shape->runs)
			fill(rowsAt(spot.y + run.row)[0], spot.x + run.first, spot.x + run.last);
		for (int y = spot.y; y < spot.y + spot.shape->height; ++y) {
			auto& taken = rowsAt(y);
			for (std::size_t k = 0; k + 1 < taken.size(); ++k) {
				taken[k + 1] = taken[k];
				addMovedDown(taken[k], 1 << k, taken[k].size(), taken[k + 1]);
			}
		}
		m_side = spot.cost[0];
	}

private:
	/// No place that reaches farther along an axis is better.
	static int farthest(const Spot& best)
	{
		return best.shape ? best.cost[1] : std::min(best.cost[0] - 1, kCells);
	}

	/// Adds the x, of the first \p words, at which \p run meets cells that are taken.
	void block(const Run& run, int y, std::size_t words, Row& blocked) const
	{
		const int count = run.last - run.first;
		std::size_t k = 0;
		while (2 << k <= count)
			++k;
		const Row& taken = m_taken[static_cast<std::size_t>(y + run.row)][k];
		addMovedDown(taken, run.first, words, blocked);
		addMovedDown(taken, run.last - (1 << k), words, blocked);
	}

	std::array<Row, kLevels>& rowsAt(int y) { return m_taken[static_cast<std::size_t>(y)]; }

	/// [y][k] the x from which one of 2^k cells is taken
	std::array<std::array<Row, kLevels>, kCells> m_taken{};
	std::vector<Run> m_runs; // of a shape, those that block most first
	int m_side = 0;          // of the square that holds all
	long long m_work = 0;
};

double areaOf(const Outline& outline)
{
	double doubled = 0.0;
	for (const auto& side : outline)
		doubled += doubledArea(outline.front()[0], side[0], side[1]);
	return 0.5 * doubled;
}

std::vector<Point2> pointsOf(const Outline& outline)
{
	std::vector<Point2> points;
	points.reserve(outline.size());
	for (const auto& side : outline)
		points.push_back(side[0]);
	return points;
}

using Order = std::vector<std::size_t>; // of outlines

/// The largest first: by area, by that of the smallest rectangle round it, by the longer side of that. Which
/// one packs best differs from case to case.
std::vector<Order> ordersOf(const std::vector<Outline>& outlines)
{
	std::array<std::vector<double>, 3> sizes;
	for (const Outline& outline : outlines) {
		const OrientedRectangle r = minAreaRectangle(pointsOf(outline));
		sizes[0].push_back(areaOf(outline));
		sizes[1].push_back(r.width() * r.height());
		sizes[2].push_back(r.width());
	}
	std::vector<Order> orders;
	for (const std::vector<double>& size : sizes) {
		Order order(outlines.size());
		std::iota(order.begin(), order.end(), std::size_t{0});
		std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
			return size[a] > size[b];
		});
		if (std::find(orders.begin(), orders.end(), order) == orders.end())
			orders.push_back(std::move(order));
	}
	return orders;
}

std::complex<double> turnToMinExtent(const Outline& outline)
{
	const OrientedRectangle r = minExtentRectangle(pointsOf(outline));
	return {r.cosine, -r.sine};
}

/// Half the angle has this tangent, at most 1.
std::complex<double> rationalTurn(int numerator, int denominator)
{
	const double t = static_cast<double>(numerator) / denominator;
	return {(1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t)};
}

} // namespace

std::vector<Motion> packOutlines(
	const std::vector<Outline>& outlines,
	const std::vector<ChartTurns>& turns,
	double side,
	double room)
{
	const double cell = side / kCells, reach = 0.5 * room;
	const int freeAngles = std::clamp(256 / static_cast<int>(outlines.size()), 2, 16);
	const std::vector<Order> orders = ordersOf(outlines);
	const auto isFirst = [&](std::size_t i) {
		return std::any_of(
			orders.begin(), orders.end(), [&](const Order& order) { return order.front() == i; });
	};

	Drawing drawing(cell, reach);
	Shape drawn;
	std::vector<std::vector<Shape>> shapes(outlines.size()); // [outline][turn]
	for (std::size_t i = 0; i < outlines.size(); ++i) {
		const int angles = turns[i] == ChartTurns::Free ? freeAngles : 1;
		const int quarters = turns[i] == ChartTurns::None ? 1 : 4;
		std::vector<std::complex<double>> firsts; // of the four turns by right angles
		if (turns[i] == ChartTurns::Free && isFirst(i))
			firsts.push_back(turnToMinExtent(outlines[i]));
		for (int k = 0; k < angles; ++k)
			firsts.push_back(rationalTurn(k, angles));
		for (std::complex<double> turn : firsts)
			for (int q = 0; q < quarters; ++q, turn = {-turn.imag(), turn.real()}) {
				drawn.quarter = q;
				if (drawing.draw(outlines[i], turn, drawn))
					shapes[i].push_back(drawn);
			}
		checkpoint();
	}

	int minSide = kCells + 1;
	long long work = 0;
	std::vector<Motion> best;
	for (std::size_t k = 0; work <= kMaxWork; ++k) {
		bool isAny = false; // turn of the first outline left
		for (const Order& order : orders) {
			const std::vector<Shape>& firsts = shapes[order.front()];
			if (k >= firsts.size())
				continue;
			isAny = true;
			if (firsts[k].quarter > 0)
				continue;
			Canvas canvas;
			std::vector<Motion> motions(outlines.size());
			for (const std::size_t i : order) {
				Spot spot;
				spot.cost[0] = minSide;
				if (i == order.front())
					canvas.look(firsts[k], spot);
				else
					for (const Shape& shape : shapes[i])
						canvas.look(shape, spot);
				checkpoint();
				if (!spot.shape)
					break;
				canvas.take(spot);
				motions[i] = spot.shape->motion;
				motions[i].shift += std::complex<double>(spot.x * cell, spot.y * cell);
				if (i == order.back() && canvas.side() < minSide) {
					minSide = canvas.side();
					best = motions;
				}
			}
			work += canvas.work();
		}
		if (!isAny)
			break;
	}
	return best;
}

} // namespace ricci
