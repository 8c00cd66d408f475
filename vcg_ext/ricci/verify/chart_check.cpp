// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_check.h"

#include "../numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace ricci {

namespace {

struct Side
{
	int low, high;
	Point2 atLow, atHigh;

	auto key() const { return std::tie(low, high, atLow, atHigh); }
};

/// Distance of \p p from the line of \p s, with sign.
double offset(const Side& s, const Point2& p)
{
	const double x = s.atHigh[0] - s.atLow[0], y = s.atHigh[1] - s.atLow[1];
	const double length = std::hypot(x, y);
	return length > 0.0 ? (x * (p[1] - s.atLow[1]) - y * (p[0] - s.atLow[0])) / length : 0.0;
}

bool parts(const Side& line, const Side& ends, double depth)
{
	const double a = offset(line, ends.atLow), b = offset(line, ends.atHigh);
	return (a > depth && b < -depth) || (a < -depth && b > depth);
}

std::vector<Side>
border(const std::vector<Triangle>& triangles, const std::vector<std::array<Point2, 3>>& plane)
{
	std::vector<Side> sides;
	for (std::size_t f = 0; f < triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t next = (k + 1) % 3;
			const int a = triangles[f][k], b = triangles[f][next];
			sides.push_back(
				a < b ? Side{a, b, plane[f][k], plane[f][next]}
					  : Side{b, a, plane[f][next], plane[f][k]});
		}
	std::sort(
		sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.key() < b.key(); });
	std::vector<Side> single;
	for (std::size_t i = 0; i < sides.size(); ++i)
		if (i + 1 < sides.size() && sides[i].key() == sides[i + 1].key())
			++i;
		else
			single.push_back(sides[i]);
	return single;
}

} // namespace

int borderCrossings(
	const std::vector<Triangle>& triangles,
	const std::vector<std::array<Point2, 3>>& plane,
	double tolerance)
{
	std::vector<Side> sides = border(triangles, plane);
	const double far = std::numeric_limits<double>::infinity();
	Point2 low{far, far}, high{-far, -far};
	for (const Side& s : sides)
		for (const Point2& p : {s.atLow, s.atHigh})
			for (std::size_t k = 0; k < 2; ++k) {
				low[k] = std::min(low[k], p[k]);
				high[k] = std::max(high[k], p[k]);
			}
	const double depth = tolerance * std::max(high[0] - low[0], high[1] - low[1]);
	// A line sweeps from left to right.
	const auto left = [](const Side& s) { return std::min(s.atLow[0], s.atHigh[0]); };
	const auto right = [](const Side& s) { return std::max(s.atLow[0], s.atHigh[0]); };
	std::sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) {
		return left(a) < left(b);
	});
	int crossings = 0;
	std::vector<const Side*> swept;
	for (const Side& s : sides) {
		swept.erase(
			std::remove_if(
				swept.begin(), swept.end(), [&](const Side* o) { return right(*o) < left(s); }),
			swept.end());
		const auto bottom = std::minmax(s.atLow[1], s.atHigh[1]);
		for (const Side* o : swept)
			if (std::max(o->atLow[1], o->atHigh[1]) > bottom.first &&
				std::min(o->atLow[1], o->atHigh[1]) < bottom.second)
				crossings += parts(s, *o, depth) && parts(*o, s, depth);
		swept.push_back(&s);
	}
	return crossings;
}

bool isPartition(const std::vector<const std::vector<int>*>& parts, std::size_t count)
{
	std::vector<char> seen(count, 0);
	std::size_t sum = 0;
	for (const std::vector<int>* part : parts)
		for (int i : *part) {
			if (i < 0 || at(i) >= count || seen[at(i)])
				return false;
			seen[at(i)] = 1;
			++sum;
		}
	return sum == count;
}

} // namespace ricci
