/****************************************************************************
 * Bounding boxes of charts, side by side in the plane                       *
 * An extension of the VCG Library                                           *
 * SPDX-License-Identifier: GPL-3.0-or-later                                 *
 ****************************************************************************/
#ifndef __VCGLIB_BOXES_SIDE_BY_SIDE
#define __VCGLIB_BOXES_SIDE_BY_SIDE

#include <vcg/space/box2.h>
#include <vcg/space/point2.h>
#include <vcg/space/rect_packer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace vcg {

/// Translations, never rotations or scalings, that bring axis-parallel boxes close together.
class BoxesSideBySide
{
public:
	typedef Box2<double> Box;

	/// RectPacker searches its whole grid for each box: n boxes cost it more than n^2.
	static constexpr size_t kMaxForRectPacker = 512;

	/// [box] Translations that leave at least \p padding >= 0 between any two of \p boxes. One box
	/// stays where it is. The boxes are not empty; they may have no width or no height.
	static std::vector<Point2d> Shifts(std::vector<Box> boxes, double padding)
	{
		if (boxes.size() <= 1)
			return std::vector<Point2d>(boxes.size(), Point2d(0, 0));
		for (Box& box : boxes)
			box.Offset(0.5 * padding);
		std::vector<Point2d> shift;
		if (boxes.size() > kMaxForRectPacker || !OnAGrid(boxes, shift))
			shift = OnShelves(boxes);
		return shift;
	}

private:
	static constexpr double kMinOccupancy = 1e-9;

	/// vcglib's rectangle packer on a grid fine enough for the number of boxes. It refuses what
	/// does not fit, so the wanted occupancy is lowered until it agrees. False if it never does.
	static bool OnAGrid(std::vector<Box> boxes, std::vector<Point2d>& shift)
	{
		const int grid = std::max(256, 16 * int(std::ceil(std::sqrt(double(boxes.size())))));
		const double longest = Longest(boxes), area = Area(boxes);
		// A box without extent would take the packer to places before its grid, and one must stay
		// below the grid's own size.
		for (Box& box : boxes)
			for (int k = 0; k < 2; ++k)
				if (!(box.max[k] > box.min[k]))
					box.max[k] = box.min[k] + 1e-9 * longest;
		const double maxScale = (grid - 2) / longest / grid * std::sqrt(area);
		double occupancy = std::min(0.9, maxScale * maxScale);
		std::vector<Similarity2<double>> place;
		Point2d covered;
		while (occupancy > kMinOccupancy) {
			if (RectPacker<double>::PackOccupancy(
					boxes, Point2i(grid, grid), occupancy, place, covered)) {
				for (const Similarity2<double>& p : place)
					shift.push_back(p.tra / p.sca); // undo the common scale
				return true;
			}
			occupancy *= 0.85;
		}
		return false;
	}

	/// In rows as wide as the side of the square with the boxes' area, or as the longest box; the
	/// highest boxes first. A gap keeps the rounded sums, and floats of them, apart.
	static std::vector<Point2d> OnShelves(const std::vector<Box>& boxes)
	{
		const double width = std::max(Longest(boxes), std::sqrt(Area(boxes)));
		const double gap = 1e-6 * width;
		std::vector<size_t> order(boxes.size());
		std::iota(order.begin(), order.end(), size_t(0));
		std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
			return boxes[a].DimY() > boxes[b].DimY();
		});
		std::vector<Point2d> shift(boxes.size());
		double x = 0.0, floor = 0.0, height = 0.0;
		for (size_t i : order) {
			if (x + boxes[i].DimX() > width) {
				x = 0.0;
				floor += height + gap;
				height = 0.0;
			}
			shift[i] = Point2d(x, floor) - boxes[i].min;
			x += boxes[i].DimX() + gap;
			height = std::max(height, boxes[i].DimY());
		}
		return shift;
	}

	static double Longest(const std::vector<Box>& boxes)
	{
		double longest = 0.0;
		for (const Box& box : boxes)
			longest = std::max(longest, std::max(box.DimX(), box.DimY()));
		return longest;
	}

	static double Area(const std::vector<Box>& boxes)
	{
		double area = 0.0;
		for (const Box& box : boxes)
			area += box.DimX() * box.DimY();
		return area;
	}
};

} // namespace vcg

#endif
