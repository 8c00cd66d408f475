// SPDX-License-Identifier: GPL-3.0-or-later
// Outlines in the cells of a square: how they are drawn, and where they find a place.
#ifndef RICCI_OUTLINE_CELLS_H
#define RICCI_OUTLINE_CELLS_H

#include "../base/points.h"
#include "../base/task.h"
#include "outline_packing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace ricci {

constexpr int kWordBits = 64;

/// Rows of cells, a bit for each that is taken, and bits that stay free at the end.
class Rows
{
public:
	Rows(int rows, int cells) : m_words(cells / kWordBits + 2), m_bits(positionOf(rows * m_words))
	{
	}

	std::uint64_t* operator[](int row) { return m_bits.data() + positionOf(row * m_words); }
	const std::uint64_t* operator[](int row) const
	{
		return m_bits.data() + positionOf(row * m_words);
	}
	void clear(int rows) { std::fill_n(m_bits.begin(), rows * m_words, 0); }
	int words() const { return m_words; } ///< of a row

private:
	int m_words;
	std::vector<std::uint64_t> m_bits;
};

/// 64 cells of a row from one of those in \p word on.
inline std::uint64_t bitsFrom(const std::uint64_t* word, int bit)
{
	return word[0] >> bit | word[1] << 1 << (kWordBits - 1 - bit);
}

inline void fill(std::uint64_t* row, int first, int last)
{
	for (int x = first; x < last;) {
		const int bit = x % kWordBits, count = std::min(kWordBits - bit, last - x);
		const std::uint64_t ones =
			count == kWordBits ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
		row[x / kWordBits] |= ones << bit;
		x += count;
	}
}

/// Place of the lowest bit of \p word, which is not 0: the exponent of a double.
inline int lowestBit(std::uint64_t word)
{
	const auto lowest = static_cast<double>(word & (~word + 1));
	std::uint64_t bits;
	std::memcpy(&bits, &lowest, sizeof bits);
	return static_cast<int>(bits >> 52) - 1023;
}

/// The first cell from \p x to before \p end that is taken or that is free, or \p end.
inline int nextCell(const std::uint64_t* row, int x, int end, bool taken)
{
	while (x < end) {
		const std::uint64_t word = row[x / kWordBits];
		const std::uint64_t rest = (taken ? word : ~word) >> (x % kWordBits);
		if (rest != 0)
			return std::min(x + lowestBit(rest), end);
		x += kWordBits - x % kWordBits;
	}
	return end;
}

/// Cells of one row, from first to before last.
struct Run
{
	int row, first, last;
	int level; ///< two runs of 2^level cells cover it, one from its first, one to its last cell
};

/// An outline that is turned, in cells from the lower left corner of a box round it.
struct Shape
{
	Motion motion; ///< brings that corner to the origin
	int width = 0, height = 0;
	int x = 0, y = 0;      ///< of the middle of its area
	int size = 0;          ///< the same for areas that differ by less than a fifth
	std::vector<Run> runs; ///< longest first
	int quarterTurns = 0;  ///< right angles that it is turned by besides

	int extent() const { return std::max(width, height); }
};

/// Draws outlines in cells, in buffers that it keeps.
class Drawing
{
public:
	/// \param reach taken, too: what is nearer than this along both axes
	Drawing(int cells, double side, double reach) :
			m_cells(cells), m_cell(side / cells), m_reach(reach / m_cell), m_rows(cells, cells),
			m_crossings(positionOf(cells))
	{
	}

	double cell() const { return m_cell; }

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
		if (shape.extent() > m_cells)
			return false;
		m_rows.clear(shape.height);
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
			fill(
				m_rows[y],
				cellAt(std::min(from, to) - m_reach),
				std::min(cellAt(std::max(from, to) + m_reach) + 1, shape.width));
			const double middle = y + 0.5;
			if (low[1] <= middle && middle < high[1])
				m_crossings[positionOf(y)].emplace_back(xAt(middle), up ? -1 : 1);
		}
	}

	void fillBetween(int height)
	{
		for (int y = 0; y < height; ++y) {
			auto& crossings = m_crossings[positionOf(y)];
			std::sort(crossings.begin(), crossings.end());
			int turns = 0; // 0 again at the end
			for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
				turns += crossings[i].second;
				if (turns != 0)
					fill(m_rows[y], cellAt(crossings[i].first), cellAt(crossings[i + 1].first) + 1);
			}
			crossings.clear();
		}
	}

	void findRuns(Shape& shape)
	{
		m_runs.clear();
		m_longer.assign(positionOf(m_cells + 1), 0);
		for (int y = 0; y < shape.height; ++y) {
			for (int last = 0;;) {
				const int first = nextCell(m_rows[y], last, shape.width, true);
				if (first == shape.width)
					break;
				last = nextCell(m_rows[y], first, shape.width, false);
				m_runs.push_back({y, first, last, std::ilogb(last - first)});
				++m_longer[positionOf(last - first - 1)];
			}
		}
		double area = 0.0, x = 0.0, y = 0.0; // whole numbers
		for (const Run& run : m_runs) {
			const double length = run.last - run.first;
			area += length;
			x += length * (run.first + run.last);
			y += length * run.row;
		}
		shape.x = static_cast<int>(0.5 * x / area);
		shape.y = static_cast<int>(y / area);
		shape.size = std::ilogb(area * area * area * area);
		std::partial_sum(m_longer.rbegin(), m_longer.rend(), m_longer.rbegin());
		shape.runs.resize(m_runs.size());
		for (const Run& run : m_runs)
			shape.runs[m_longer[positionOf(run.last - run.first)]++] = run;
	}

	int m_cells;
	double m_cell, m_reach;                     // m_reach in cells
	std::vector<std::array<Point2, 2>> m_sides; // in cells
	Rows m_rows;
	/// [row] where sides cross its middle, and 1 where one runs down, the outline's inner side on its right.
	std::vector<std::vector<std::pair<double, int>>> m_crossings;
	std::vector<Run> m_runs;
	std::vector<std::size_t> m_longer; // [length] runs that are longer
};

/// Less is better: the side of the square, how far along an axis the shape reaches, and the square of its middle's
/// distance from the corner.
using Cost = std::array<int, 3>;

struct Spot
{
	Cost cost{std::numeric_limits<int>::max(), 0, 0};
	const Shape* shape = nullptr; ///< none: there is no place
	int x = 0, y = 0;

	/// Of the outline, where a cell has this side.
	Motion motion(double cell) const
	{
		return {shape->motion.turn, shape->motion.shift + std::complex<double>(x * cell, y * cell)};
	}
};

class Canvas
{
public:
	explicit Canvas(int cells) :
			m_cells(cells), m_levels(std::ilogb(cells) + 1), m_taken(cells * m_levels, cells)
	{
	}

	long long work() const { return m_work; }

	void clear()
	{
		m_taken.clear(m_side * m_levels);
		m_side = 0;
		m_reached.clear();
	}

	/// Places one of these shapes of an outline where the square that holds all so far is smallest. What is about as large
	/// as one that has a place is not looked for nearer, but for twice its own extent.
	/// \param shapes not empty
	/// \param side of the square, which has to stay smaller
	Spot put(const std::vector<Shape>& shapes, int side)
	{
		Spot spot;
		spot.cost[0] = side;
		int& reached = m_reached[shapes.front().size];
		for (const Shape& shape : shapes)
			look(shape, reached - 2 * shape.extent(), spot);
		checkpoint();
		if (spot.shape) {
			take(spot);
			reached = spot.cost[1];
		}
		return spot;
	}

private:
	/// Takes a better place of \p shape than \p best, if there is one.
	/// \param least cells that it reaches along an axis; it is not looked for nearer
	void look(const Shape& shape, int least, Spot& best)
	{
		m_blockers.clear();
		for (const Run& run : shape.runs)
			m_blockers.push_back(
				{blockerAt(run, run.first), blockerAt(run, run.last - (1 << run.level))});
		for (int y = 0; y + shape.height <= farthest(best); ++y) {
			const int end = farthest(best) - shape.width + 1; // of x
			if (end <= 0)
				return;
			const int begin = y + shape.height < least ? std::max(least - shape.width, 0) : 0;
			const int x = begin < end ? firstFree(y, begin, end) : end;
			if (x == end)
				continue;
			const int right = x + shape.width, top = y + shape.height;
			const int reach = std::max(right, top), toX = x + shape.x, toY = y + shape.y;
			const Cost cost{std::max(m_side, reach), reach, toX * toX + toY * toY};
			if (cost < best.cost)
				best = {cost, &shape, x, y};
		}
	}

	void take(const Spot& spot)
	{
		for (const Run& run : spot.shape->runs)
			fill(rowAt(spot.y + run.row, 0), spot.x + run.first, spot.x + run.last);
		const int last =
			std::min((spot.x + spot.shape->width) / kWordBits + 1, m_cells / kWordBits);
		for (int y = spot.y; y < spot.y + spot.shape->height; ++y)
			for (int k = 0; k + 1 < m_levels; ++k) {
				const std::uint64_t* half = rowAt(y, k);
				for (int i = std::max(spot.x - (2 << k), 0) / kWordBits; i < last; ++i) {
					const int x = std::min(i * kWordBits + (1 << k), m_cells);
					rowAt(y, k + 1)[i] = half[i] | bitsFrom(half + x / kWordBits, x % kWordBits);
				}
			}
		m_side = spot.cost[0];
	}

	/// No place that reaches farther along an axis is better.
	int farthest(const Spot& best) const
	{
		return best.shape ? best.cost[1] : std::min(best.cost[0] - 1, m_cells);
	}

	std::uint64_t* rowAt(int y, int k) { return m_taken[y * m_levels + k]; }

	/// Half of a run, for a shape in the corner: where the x begin at which it meets cells that are taken, as a word from
	/// the start of the row of the shape's corner and a bit.
	using Blocker = std::pair<std::ptrdiff_t, int>;
	Blocker blockerAt(const Run& run, int first) const
	{
		const std::ptrdiff_t row = run.row * m_levels + run.level;
		return {row * m_taken.words() + first / kWordBits, first % kWordBits};
	}

	/// The first x from \p begin to before \p end at which the shape meets no cell that is taken, or \p end.
	int firstFree(int y, int begin, int end)
	{
		const std::uint64_t* row = rowAt(y, 0);
		for (int i = begin / kWordBits; i * kWordBits < end; ++i) {
			std::uint64_t blocked = 0;
			const int first = begin - i * kWordBits, last = end - i * kWordBits;
			if (first > 0)
				blocked = (std::uint64_t{1} << first) - 1;
			if (last < kWordBits)
				blocked |= ~std::uint64_t{0} << last;
			for (std::size_t k = 0; k < m_blockers.size() && ~blocked != 0; ++k) {
				for (const auto& [word, bit] : m_blockers[k])
					blocked |= bitsFrom(row + word + i, bit);
				++m_work;
				if (~blocked == 0)
					std::swap(m_blockers[k], m_blockers[k / 2]); // it blocks the next ones, too
			}
			if (~blocked != 0)
				return i * kWordBits + lowestBit(~blocked);
		}
		return end;
	}

	int m_cells, m_levels;
	Rows m_taken; // [y, k] the x from which one of 2^k cells is taken
	/// Of the runs of a shape, those that block most first.
	std::vector<std::array<Blocker, 2>> m_blockers;
	int m_side = 0;               // of the square that holds all
	std::map<int, int> m_reached; // by Shape::size
	long long m_work = 0;
};

} // namespace ricci

#endif
