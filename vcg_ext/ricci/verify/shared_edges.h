// SPDX-License-Identifier: GPL-3.0-or-later
// Sides of triangles, matched without a triangulation.
#ifndef RICCI_SHARED_EDGES_H
#define RICCI_SHARED_EDGES_H

#include "../math/bucket_sort.h"
#include "../math/points.h"
#include "../surface/surface_mesh.h"

#include <cstddef>
#include <vector>

namespace ricci {

/// One side of a triangle in the plane, by the numbers \c low < \c high of its ends.
struct PlaneSide
{
	int low, high;
	Point2 atLow, atHigh;
};

/// The three sides of every triangle, in order. \p plane [triangle][corner].
inline std::vector<PlaneSide>
planeSides(const std::vector<Triangle>& triangles, const std::vector<Triangle2>& plane)
{
	std::vector<PlaneSide> sides;
	sides.reserve(3 * triangles.size());
	for (std::size_t f = 0; f < triangles.size(); ++f) {
		const Triangle& t = triangles[f];
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t next = (k + 1) % 3;
			sides.push_back(
				t[k] < t[next] ? PlaneSide{t[k], t[next], plane[f][k], plane[f][next]}
							   : PlaneSide{t[next], t[k], plane[f][next], plane[f][k]});
		}
	}
	return sides;
}

/// Calls \p visit(first, count) for every edge: the position of its first side in \p sides, and the
/// number of its sides. A side has the numbers \c low < \c high of its ends; \p sides is sorted.
template<class Side, class Visit>
void forEdgesOf(std::vector<Side>& sides, Visit visit)
{
	bucketSort(
		sides,
		[](const Side& s) { return s.low; },
		[](const Side& a, const Side& b) { return a.high < b.high; });
	for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
		while (end < sides.size() && sides[end].low == sides[i].low &&
			   sides[end].high == sides[i].high)
			++end;
		visit(i, end - i);
	}
}

/// Calls \p visit(a, b) for the two sides of every edge that exactly two triangles share. \p sides
/// has one for each triangle that an edge belongs to, and is sorted.
template<class Side, class Visit>
void forSharedEdges(std::vector<Side>& sides, Visit visit)
{
	forEdgesOf(sides, [&](std::size_t first, std::size_t count) {
		if (count == 2)
			visit(sides[first], sides[first + 1]);
	});
}

} // namespace ricci

#endif
