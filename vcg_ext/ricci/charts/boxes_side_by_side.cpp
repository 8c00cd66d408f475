// SPDX-License-Identifier: GPL-3.0-or-later
#include "boxes_side_by_side.h"

#include "../base/indexed.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <optional>

namespace ricci {

namespace {

/// Boxes that are placed in cells at most, which takes more than their number squared.
constexpr std::size_t kMaxInCells = 512;

/// Share of the square that boxes in cells are to cover: at first, and at least; and the factor between tries.
constexpr double kMostCovered = 0.9, kLeastCovered = 1e-9, kLess = 0.85;

using Size = std::array<int, 2>; // in cells
using Order = std::vector<std::size_t>;

/// Boxes by a key, the largest first.
template<class Key>
Order largestFirst(std::size_t count, const Key& key)
{
	Order order(count);
	std::iota(order.begin(), order.end(), std::size_t{0});
	std::stable_sort(
		order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) > key(b); });
	return order;
}

/// A square of cells, each with the number of the box in it, or -1.
class Cells
{
public:
	explicit Cells(int side) : m_side(side), m_box(positionOf(side * side), -1) {}

	/// A box that one of \p size at (x, y) would meet, or -1. None is lower than it: each that it meets is in its
	/// lowest or its highest row.
	int inTheWay(int x, int y, const Size& size) const
	{
		for (const int row : {y + size[1] - 1, y})
			for (int i = x; i < x + size[0]; ++i)
				if (const int box = m_box[positionOf(i + row * m_side)]; box >= 0)
					return box;
		return -1;
	}

	void take(int x, int y, const Size& size, int box)
	{
		for (int row = y; row < y + size[1]; ++row)
			std::fill_n(m_box.begin() + x + row * m_side, size[0], box);
	}

private:
	int m_side;
	std::vector<int> m_box;
};

/// Places boxes one after the other, the highest first, each where the box round all so far has the least area.
/// \return [box] its place, or nothing if one has none within the square
std::optional<std::vector<Size>> placesInCells(const std::vector<Size>& sizes, int side)
{
	const Order order = largestFirst(sizes.size(), [&](std::size_t i) {
		return Size{sizes[i][1], sizes[i][0]};
	});
	Cells cells(side);
	std::vector<Size> places(sizes.size());
	Size whole{0, 0};
	for (const std::size_t i : order) {
		const Size& size = sizes[i];
		int least = -1;
		Size reached = whole;
		const int lastX = std::min(whole[0], side - size[0]),
				  lastY = std::min(whole[1], side - size[1]);
		for (int y = 0; y <= lastY && (least < 0 || reached != whole); ++y) {
			int x = 0;
			for (int box; x <= lastX && (box = cells.inTheWay(x, y, size)) >= 0;)
				x = places[positionOf(box)][0] + sizes[positionOf(box)][0];
			const Size grown{std::max(whole[0], x + size[0]), std::max(whole[1], y + size[1])};
			if (x <= lastX && (least < 0 || grown[0] * grown[1] < least)) {
				least = grown[0] * grown[1];
				reached = grown;
				places[i] = {x, y};
			}
		}
		if (least < 0)
			return std::nullopt;
		cells.take(places[i][0], places[i][1], size, static_cast<int>(i));
		whole = reached;
	}
	return places;
}

double longestOf(const std::vector<Box2>& boxes)
{
	double longest = 0.0;
	for (const Box2& box : boxes)
		longest = std::max(longest, box.extent());
	return longest;
}

double areaOf(const std::vector<Box2>& boxes)
{
	double area = 0.0;
	for (const Box2& box : boxes)
		area += box.width() * box.height();
	return area;
}

/// In cells fine enough for the number of boxes, as large as they fit. Empty if they do not.
std::vector<Point2> inCells(std::vector<Box2> boxes)
{
	const int side = std::max(
		256, 16 * static_cast<int>(std::ceil(std::sqrt(static_cast<double>(boxes.size())))));
	const double longest = longestOf(boxes);
	const double maxScale = (side - 2) / longest / side * std::sqrt(areaOf(boxes));
	for (Box2& box : boxes) // each takes a cell
		for (std::size_t k = 0; k < 2; ++k)
			if (!(box.max[k] > box.min[k]))
				box.max[k] = box.min[k] + 1e-9 * longest;
	const double root = std::sqrt(static_cast<double>(side) * side) / std::sqrt(areaOf(boxes));
	for (double covered = std::min(kMostCovered, maxScale * maxScale); covered > kLeastCovered;
		 covered *= kLess) {
		const double scale = root * std::sqrt(covered);
		std::vector<Size> sizes;
		sizes.reserve(boxes.size());
		for (const Box2& box : boxes)
			sizes.push_back(
				{static_cast<int>(std::ceil(box.width() * scale)),
				 static_cast<int>(std::ceil(box.height() * scale))});
		const auto places = placesInCells(sizes, side);
		if (!places)
			continue;
		std::vector<Point2> shifts;
		shifts.reserve(boxes.size());
		for (std::size_t i = 0; i < boxes.size(); ++i) {
			const auto& [x, y] = (*places)[i];
			shifts.push_back(
				{(x - boxes[i].min[0] * scale) / scale, (y - boxes[i].min[1] * scale) / scale});
		}
		return shifts;
	}
	return {};
}

/// In rows as wide as the side of the square with the boxes' area, or as the longest box; the highest boxes first. A
/// gap keeps the rounded sums, and floats of them, apart.
std::vector<Point2> onShelves(const std::vector<Box2>& boxes)
{
	const double width = std::max(longestOf(boxes), std::sqrt(areaOf(boxes)));
	const double gap = 1e-6 * width;
	std::vector<Point2> shifts(boxes.size());
	double x = 0.0, floor = 0.0, height = 0.0;
	for (const std::size_t i : largestFirst(
			 boxes.size(), [&](std::size_t k) { return roundedShare(boxes[k].height(), width); })) {
		if (x + boxes[i].width() > width) {
			x = 0.0;
			floor += height + gap;
			height = 0.0;
		}
		shifts[i] = {x - boxes[i].min[0], floor - boxes[i].min[1]};
		x += boxes[i].width() + gap;
		height = std::max(height, boxes[i].height());
	}
	return shifts;
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
	std::vector<Point2> shifts;
	if (boxes.size() <= kMaxInCells && longestOf(boxes) > 0.0)
		shifts = inCells(boxes);
	return shifts.empty() ? onShelves(boxes) : shifts;
}

} // namespace ricci
