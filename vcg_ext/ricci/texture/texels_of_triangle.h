// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TEXELS_OF_TRIANGLE_H
#define RICCI_TEXELS_OF_TRIANGLE_H

#include "../math/points.h"

#include <algorithm>
#include <cmath>

namespace ricci {

/// Calls visit(x, y) for the texels whose middle lies in a triangle, row by row; the middle of texel
/// (x, y) is (x + 0.5, y + 0.5).
/// \param reach positive: at least those this far outside are visited, too; negative: those nearer to
/// the triangle's sides, along the axes, are not
/// \param first, last of the coordinates of texels that are visited
template<class Visit>
void forEachTexelOf(const Triangle2& t, double reach, int first, int last, const Visit& visit)
{
	const auto clamped = [&](double x) { // no number becomes first
		return x > first ? static_cast<int>(std::min(x, last + 1.0)) : first;
	};
	const double low = std::min({t[0][1], t[1][1], t[2][1]}) - reach;
	const double high = std::max({t[0][1], t[1][1], t[2][1]}) + reach;
	const double slab = std::max(reach, 0.0);
	for (int y = clamped(std::ceil(low - 0.5)); y <= last && y + 0.5 <= high; ++y) {
		// What the triangle has of the rows within reach.
		const double bottom = y + 0.5 - slab, top = y + 0.5 + slab;
		double left = HUGE_VAL, right = -HUGE_VAL;
		for (std::size_t k = 0; k < 3; ++k) {
			Point2 a = t[k], b = t[(k + 1) % 3];
			if (a[1] > b[1])
				std::swap(a, b);
			if (b[1] < bottom || a[1] > top)
				continue;
			const double rise = b[1] - a[1];
			const auto at = [&](double height) {
				const double share = rise > 0.0 ? (height - a[1]) / rise : 0.0;
				return a[0] + std::clamp(share, 0.0, 1.0) * (b[0] - a[0]);
			};
			const double from = a[1] >= bottom ? a[0] : at(bottom);
			const double to = b[1] <= top ? b[0] : at(top);
			left = std::min({left, from, to});
			right = std::max({right, from, to});
		}
		if (left > right)
			continue;
		right += reach;
		for (int x = clamped(std::ceil(left - reach - 0.5)); x <= last && x + 0.5 <= right; ++x)
			visit(x, y);
	}
}

/// The point of a triangle that is nearest to p, as barycentric coordinates.
inline Point3 nearestInTriangle(const Triangle2& t, const Point2& p)
{
	const double area = doubledArea(t[0], t[1], t[2]);
	if (area != 0.0) {
		const Point3 weights{
			doubledArea(p, t[1], t[2]) / area,
			doubledArea(t[0], p, t[2]) / area,
			doubledArea(t[0], t[1], p) / area};
		if (weights[0] >= 0.0 && weights[1] >= 0.0 && weights[2] >= 0.0)
			return weights;
	}
	Point3 nearest{1, 0, 0};
	double nearestSoFar = HUGE_VAL;
	for (std::size_t k = 0; k < 3; ++k) {
		const Point2 &a = t[k], &b = t[(k + 1) % 3];
		const double share = nearestOnSegment(a, b, p);
		const double apart = distance(p, between(a, b, share));
		if (apart < nearestSoFar) {
			nearestSoFar = apart;
			nearest = {0, 0, 0};
			nearest[k] = 1.0 - share;
			nearest[(k + 1) % 3] = share;
		}
	}
	return nearest;
}

/// The point with these barycentric coordinates.
inline Point2 pointOf(const Triangle2& t, const Point3& weights)
{
	return {
		weights[0] * t[0][0] + weights[1] * t[1][0] + weights[2] * t[2][0],
		weights[0] * t[0][1] + weights[1] * t[1][1] + weights[2] * t[2][1]};
}

} // namespace ricci

#endif
