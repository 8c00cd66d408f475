// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_check.h"

#include "../base/indexed.h"
#include "../base/task.h"
#include "shared_edges.h"

#include <algorithm>
#include <tuple>

namespace ricci {

namespace {

/// Pairs of sides that are looked at between two checkpoints.
constexpr std::size_t kPairsPerTick = 1000000;

/// Distance of \p p from the line of \p s, positive on the left; 0 where it has no length.
double offset(const PlaneSide& s, const Point2& p)
{
	const double length = distance(s.atHigh, s.atLow);
	return length > 0.0 ? doubledArea(s.atLow, s.atHigh, p) / length : 0.0;
}

/// Whether the ends of \p s lie on different sides of \p line, both deeper than \p depth.
bool separates(const PlaneSide& line, const PlaneSide& s, double depth)
{
	const double a = offset(line, s.atLow), b = offset(line, s.atHigh);
	return (a > depth && b < -depth) || (a < -depth && b > depth);
}

/// The sides of which no second triangle has the ends and the places.
std::vector<PlaneSide>
borderOf(const std::vector<Triangle>& triangles, const std::vector<Triangle2>& plane)
{
	std::vector<PlaneSide> sides = planeSides(triangles, plane), border;
	const auto places = [](const PlaneSide& s) { return std::tie(s.atLow, s.atHigh); };
	forEdgesOf(sides, [&](std::size_t first, std::size_t count) {
		std::sort(&sides[first], &sides[first] + count, [&](const auto& a, const auto& b) {
			return places(a) < places(b);
		});
		for (std::size_t i = first, end = first; i < first + count; i = end) {
			while (end < first + count && places(sides[end]) == places(sides[i]))
				++end;
			if ((end - i) % 2 == 1)
				border.push_back(sides[i]);
		}
	});
	return border;
}

} // namespace

int borderCrossings(
	const std::vector<Triangle>& triangles,
	const std::vector<Triangle2>& plane,
	double depth)
{
	std::vector<PlaneSide> sides = borderOf(triangles, plane);
	// A line sweeps from left to right.
	const auto left = [](const PlaneSide& s) { return std::min(s.atLow[0], s.atHigh[0]); };
	const auto right = [](const PlaneSide& s) { return std::max(s.atLow[0], s.atHigh[0]); };
	std::sort(sides.begin(), sides.end(), [&](const PlaneSide& a, const PlaneSide& b) {
		return left(a) < left(b);
	});
	int crossings = 0;
	std::vector<const PlaneSide*> swept;
	std::size_t pairs = 0;
	for (const PlaneSide& s : sides) {
		pairs += 1 + swept.size();
		if (pairs > kPairsPerTick) {
			pairs = 0;
			checkpoint();
		}
		const auto isPassed = [&](const PlaneSide* other) { return right(*other) < left(s); };
		swept.erase(std::remove_if(swept.begin(), swept.end(), isPassed), swept.end());
		const auto [bottom, top] = std::minmax({s.atLow[1], s.atHigh[1]});
		for (const PlaneSide* other : swept)
			if (std::max(other->atLow[1], other->atHigh[1]) > bottom &&
				std::min(other->atLow[1], other->atHigh[1]) < top)
				crossings += separates(s, *other, depth) && separates(*other, s, depth);
		swept.push_back(&s);
	}
	return crossings;
}

bool isPartition(const std::vector<const std::vector<int>*>& parts, std::size_t count)
{
	std::vector<char> seen(count, 0);
	std::size_t sum = 0;
	for (const std::vector<int>* part : parts)
		for (const int i : *part) {
			if (i < 0 || positionOf(i) >= count || seen[positionOf(i)])
				return false;
			seen[positionOf(i)] = 1;
			++sum;
		}
	return sum == count;
}

} // namespace ricci
