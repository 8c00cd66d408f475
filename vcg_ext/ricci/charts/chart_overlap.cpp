// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_overlap.h"

#include "../math/box_tree.h"
#include "../math/orientation.h"

#include <algorithm>

namespace ricci {

namespace {

/// Pairs of boxes that are looked at between two ticks.
constexpr int kPairsBetweenTicks = 1 << 20;

/// How far \p r lies to the left of the line from \p p to \p q; at most 0 exactly if it does not.
double depth(const Point2& p, const Point2& q, const Point2& r)
{
	if (orientation(p, q, r) <= 0)
		return 0.0;
	return doubledArea(p, q, r) / distance(p, q);
}

/// Whether a side of \p a has \p b on its outer side, or no deeper inside than \p touching.
bool separates(const Triangle2& a, const Triangle2& b, double touching)
{
	for (std::size_t k = 0; k < 3; ++k) {
		bool outside = true;
		for (std::size_t i = 0; i < 3 && outside; ++i)
			outside = depth(a[k], a[(k + 1) % 3], b[i]) <= touching;
		if (outside)
			return true;
	}
	return false;
}

/// Mean of the corners of the common part of two counter-clockwise triangles.
/// \return false if rounding leaves no common part
bool commonPoint(const Triangle2& a, const Triangle2& b, Point2& point)
{
	std::vector<Point2> part(a.begin(), a.end()), next;
	for (std::size_t k = 0; k < 3; ++k) {
		next.clear();
		for (std::size_t i = 0; i < part.size(); ++i) {
			const Point2 &x = part[i], &y = part[(i + 1) % part.size()];
			const double u = doubledArea(b[k], b[(k + 1) % 3], x);
			const double v = doubledArea(b[k], b[(k + 1) % 3], y);
			if (u >= 0.0)
				next.push_back(x);
			if ((u > 0.0 && v < 0.0) || (u < 0.0 && v > 0.0)) {
				const double t = u / (u - v);
				next.push_back({x[0] + t * (y[0] - x[0]), x[1] + t * (y[1] - x[1])});
			}
		}
		part.swap(next);
	}
	if (part.size() < 3)
		return false;
	point = {0.0, 0.0};
	for (const Point2& p : part)
		for (std::size_t k = 0; k < 2; ++k)
			point[k] += p[k] / static_cast<double>(part.size());
	return true;
}

BoxTree boxTreeOf(const Array<Triangle2>& triangles)
{
	std::vector<Box2> boxes;
	boxes.reserve(triangles.values().size());
	for (const Triangle2& triangle : triangles) {
		Box2 box;
		for (const Point2& p : triangle)
			box.add(p);
		boxes.push_back(box);
	}
	return BoxTree(std::move(boxes));
}

/// Triangles round \p p less those turned round: the winding number of the chart's boundary, where
/// p lies on no edge.
int cover(const BoxTree& tree, const Array<Triangle2>& plane, const Point2& p)
{
	int sum = 0;
	tree.boxesAround(p, [&](int i) {
		const Triangle2& c = plane[i];
		const int first = orientation(c[0], c[1], p);
		if (first != 0 && orientation(c[1], c[2], p) == first &&
			orientation(c[2], c[0], p) == first)
			sum += first;
	});
	return sum;
}

} // namespace

std::vector<TrianglePair> overlappingPairs(const DrawnChart& chart, const Tick& tick, double extent)
{
	const Array<Triangle2>& plane = chart.plane;
	const BoxTree tree = boxTreeOf(plane);
	Array<char> proper(plane.size());
	for (int i = 0; i < plane.size(); ++i)
		proper[i] = orientation(plane[i][0], plane[i][1], plane[i][2]) > 0;
	const bool hasFolds = std::find(proper.begin(), proper.end(), 0) != proper.end();
	const double touching = kTouching * std::max(extent, tree.extent());
	std::vector<TrianglePair> pairs;
	int untilTick = kPairsBetweenTicks;
	tree.meetingPairs([&](int i, int j) {
		if (--untilTick == 0) {
			untilTick = kPairsBetweenTicks;
			tick();
		}
		const Triangle2 &a = plane[i], &b = plane[j];
		if (!proper[i] || !proper[j] || separates(a, b, touching) || separates(b, a, touching))
			return;
		Point2 p;
		if (hasFolds && (!commonPoint(a, b, p) || cover(tree, plane, p) < 2))
			return;
		pairs.push_back({std::min(i, j), std::max(i, j)});
	});
	std::sort(pairs.begin(), pairs.end());
	return pairs;
}

} // namespace ricci
