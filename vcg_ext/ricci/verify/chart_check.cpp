// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_check.h"

#include "../base/task.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace ricci {

namespace {

/// Pairs of sides that are looked at between two checkpoints.
constexpr std::size_t kPairsPerCheckpoint = 1000000;

using Ends = std::array<Point2, 2>; // of a side

/// Distance of \p p from the line of \p s, positive on the left; 0 where it has no length.
double offset(const Ends& s, const Point2& p)
{
	const double length = distance(s[1], s[0]);
	return length > 0.0 ? doubledArea(s[0], s[1], p) / length : 0.0;
}

/// Whether the ends of \p s lie on different sides of \p line, both deeper than \p depth.
bool separates(const Ends& line, const Ends& s, double depth)
{
	const double a = offset(line, s[0]), b = offset(line, s[1]);
	return (a > depth && b < -depth) || (a < -depth && b > depth);
}

} // namespace

int borderCrossings(const FlatMesh& chart, double depth)
{
	const Sides across(chart.vertices.values());
	std::vector<Ends> sides;
	for (const int f : chart.points.indices())
		for (const Corner side : cornersOf(f))
			if (!joinedSide(chart, across, side).isValid())
				sides.push_back(chart.ends(side));
	// A line sweeps from left to right.
	const auto left = [](const Ends& s) { return std::min(s[0][0], s[1][0]); };
	const auto right = [](const Ends& s) { return std::max(s[0][0], s[1][0]); };
	std::sort(sides.begin(), sides.end(), [&](const Ends& a, const Ends& b) {
		return left(a) < left(b);
	});
	int crossings = 0;
	std::vector<const Ends*> swept;
	std::size_t pairs = 0;
	for (const Ends& s : sides) {
		pairs += 1 + swept.size();
		if (pairs > kPairsPerCheckpoint) {
			pairs = 0;
			checkpoint();
		}
		const auto isPassed = [&](const Ends* other) { return right(*other) < left(s); };
		swept.erase(std::remove_if(swept.begin(), swept.end(), isPassed), swept.end());
		const auto [bottom, top] = std::minmax({s[0][1], s[1][1]});
		for (const Ends* other : swept)
			if (std::max((*other)[0][1], (*other)[1][1]) > bottom &&
				std::min((*other)[0][1], (*other)[1][1]) < top)
				crossings += separates(s, *other, depth) && separates(*other, s, depth);
		swept.push_back(&s);
	}
	return crossings;
}

} // namespace ricci
