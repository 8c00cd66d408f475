// SPDX-License-Identifier: GPL-3.0-or-later
#include "boxes_side_by_side.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace ricci {

namespace {

/// Widths of rows that are tried, each wider by this share of the first.
constexpr int kWidths = 12;
constexpr double kWiderRow = 0.03;

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

/// Places in rows, and the side of the square that holds them.
struct Shelves
{
	double side = 0.0;
	std::vector<Point2> shifts; ///< [box]
};

/// In rows of some width. A gap keeps the rounded sums, and floats of them, apart.
Shelves onShelves(
	const std::vector<Box2>& boxes, const std::vector<std::size_t>& order, double width, double gap)
{
	Shelves shelves;
	shelves.shifts.resize(boxes.size());
	double x = 0.0, floor = 0.0, height = 0.0;
	for (const std::size_t i : order) {
		if (x + boxes[i].width() > width) {
			x = 0.0;
			floor += height + gap;
			height = 0.0;
		}
		shelves.shifts[i] = {x - boxes[i].min[0], floor - boxes[i].min[1]};
		x += boxes[i].width() + gap;
		height = std::max(height, boxes[i].height());
		shelves.side = std::max({shelves.side, x, floor + height});
	}
	return shelves;
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
	const double root = std::max(longestOf(boxes), std::sqrt(areaOf(boxes))), gap = 1e-6 * root;
	std::vector<std::size_t> order(boxes.size()); // the highest first
	std::iota(order.begin(), order.end(), std::size_t{0});
	std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
		return roundedShare(boxes[a].height(), root) > roundedShare(boxes[b].height(), root);
	});
	Shelves best = onShelves(boxes, order, root, gap);
	for (int i = 1; i < kWidths; ++i)
		if (Shelves next = onShelves(boxes, order, (1.0 + kWiderRow * i) * root, gap);
			next.side < best.side)
			best = std::move(next);
	return best.shifts;
}

} // namespace ricci
