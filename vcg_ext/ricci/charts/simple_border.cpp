// SPDX-License-Identifier: GPL-3.0-or-later
#include "simple_border.h"

#include "../math/box_tree.h"
#include "../math/orientation.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace ricci {

namespace {

/// By how much of the extent boxes are widened, so that those of sides that touch meet.
constexpr double kWidened = 1e-12;

/// A side of a triangle on the border, and the one where the border goes on.
struct BorderSide
{
	std::array<Point2, 2> ends;
	int next;
};

/// In order of the triangles.
Array<BorderSide> borderOf(const FlatMesh& mesh, const std::vector<int>& chart)
{
	std::vector<Corner> border; // in increasing order
	for (const int f : chart)
		for (const Corner side : cornersOf(f))
			if (!mesh.joined(side).isValid())
				border.push_back(side);
	Array<BorderSide> result;
	for (const Corner side : border) {
		Corner next = side.next();
		for (Corner other; (other = mesh.joined(next)).isValid();)
			next = other.next();
		const auto found = std::lower_bound(border.begin(), border.end(), next);
		result.push_back({mesh.ends(side), static_cast<int>(found - border.begin())});
	}
	return result;
}

/// Whether the sides have no point in common, but for the one where the first goes on as the second.
bool areApart(const BorderSide& s, const BorderSide& t, bool isNext)
{
	const auto& [a, b] = s.ends;
	const auto& [c, d] = t.ends;
	if (isNext)
		return orientation(a, b, d) != 0 ||
			   (a[0] - b[0]) * (d[0] - b[0]) + (a[1] - b[1]) * (d[1] - b[1]) < 0.0;
	return orientation(a, b, c) * orientation(a, b, d) > 0 ||
		   orientation(c, d, a) * orientation(c, d, b) > 0;
}

bool areApart(const Array<BorderSide>& border)
{
	Box2 whole;
	for (const BorderSide& side : border)
		whole.add(side.ends[0]);
	const double width = kWidened * whole.extent();
	std::vector<Box2> boxes;
	boxes.reserve(border.values().size());
	for (const BorderSide& side : border) {
		Box2 box;
		for (const Point2& p : side.ends) {
			box.add(Point2{p[0] - width, p[1] - width});
			box.add(Point2{p[0] + width, p[1] + width});
		}
		boxes.push_back(box);
	}
	bool apart = true;
	BoxTree(boxes).meetingPairs(
		[&](int i, int j) {
			if (border[j].next == i)
				std::swap(i, j);
			apart = apart && areApart(border[i], border[j], border[i].next == j);
		},
		[&](int, int) { return !apart; });
	return apart;
}

/// Of the polygons of a border whose sides are apart.
int counterClockwisePolygons(const Array<BorderSide>& border)
{
	int count = 0;
	Array<char> seen(border.size(), 0);
	for (const int first : border.indices()) {
		if (seen[first])
			continue;
		// The corner on the left, the lowest of these, is convex.
		int before = first;
		for (int side = first; !seen[side]; side = border[side].next) {
			seen[side] = 1;
			if (border[side].ends[1] < border[before].ends[1])
				before = side;
		}
		const auto& [a, b] = border[before].ends;
		count += orientation(a, b, border[border[before].next].ends[1]) > 0;
	}
	return count;
}

} // namespace

bool hasSimpleBorder(const FlatMesh& mesh, const std::vector<int>& chart)
{
	for (const int f : chart)
		if (orientation(mesh.at(f)) <= 0)
			return false;
	const Array<BorderSide> border = borderOf(mesh, chart);
	return areApart(border) && counterClockwisePolygons(border) == 1;
}

} // namespace ricci
