// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold.h"

#include "../base/numbers.h"

#include <algorithm>
#include <cmath>

namespace ricci {

namespace {

Point2 walk(const Point2& from, double length, double direction)
{
	return {from[0] + length * std::cos(direction), from[1] + length * std::sin(direction)};
}

} // namespace

void unfold(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const NormalCoordinates::Curve& curve,
	Strip& strip)
{
	const auto length = [&](Halfedge h) { return lengths[h.edge()]; };
	// Angle at the origin of h, by half-angles.
	const auto angle = [&](Halfedge h) {
		const double a = length(h), b = length(t.previous(h)), c = length(t.next(h));
		const double s = 0.5 * (a + b + c);
		return 2.0 * std::atan2(
						 std::sqrt(std::max(0.0, (s - a) * (s - b))),
						 std::sqrt(std::max(0.0, s * (s - c))));
	};
	strip.sides.clear();
	const Halfedge h = curve.first;
	double along = kPi - angle(t.next(h)); // direction of the crossed halfedge
	Strip::Side side{{length(h), 0.0}, walk({0.0, 0.0}, length(t.previous(h)), angle(h))};
	for (std::size_t i = 0; i < curve.crossings.size(); ++i) {
		strip.sides.push_back(side);
		const Halfedge y = curve.crossings[i].halfedge.twin(); // from side.to
		const double direction = along + kPi;
		const double toApex = direction + angle(y);
		const double fromBase = direction + kPi - angle(t.next(y));
		const double left = length(t.previous(y)), right = length(t.next(y));
		const Point2 apex =
			right < left ? walk(side.from, right, fromBase) : walk(side.to, left, toApex);
		if (i + 1 == curve.crossings.size())
			strip.end = apex;
		else if (curve.crossings[i + 1].halfedge == t.next(y)) {
			side.to = apex;
			along = fromBase;
		}
		else {
			side.from = apex;
			along = toApex - kPi;
		}
	}
}

} // namespace ricci
