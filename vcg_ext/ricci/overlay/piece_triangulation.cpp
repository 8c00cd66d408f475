// SPDX-License-Identifier: GPL-3.0-or-later
#include "piece_triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ricci {

namespace {

/// Twice the area over the square of the longest side: in the plane (negative if clockwise) or in
/// space, whichever is lower.
double quality(const std::array<const Point2*, 3>& plane, const std::array<const Point3*, 3>& space)
{
	const double area = doubledArea(*plane[0], *plane[1], *plane[2]);
	double longest = 0.0, longestInSpace = 0.0;
	for (std::size_t k = 0; k < 3; ++k) {
		longest = std::max(longest, distance(*plane[k], *plane[(k + 1) % 3]));
		longestInSpace = std::max(longestInSpace, distance(*space[k], *space[(k + 1) % 3]));
	}
	const double inPlane = longest > 0.0 ? area / (longest * longest) : 0.0;
	if (!(longestInSpace > 0.0))
		return inPlane;
	double e[3], g[3];
	for (std::size_t k = 0; k < 3; ++k) {
		e[k] = (*space[1])[k] - (*space[0])[k];
		g[k] = (*space[2])[k] - (*space[0])[k];
	}
	const double inSpace = hypotOfThree(
		e[1] * g[2] - e[2] * g[1], e[2] * g[0] - e[0] * g[2], e[0] * g[1] - e[1] * g[0]);
	return std::min(inPlane, inSpace / (longestInSpace * longestInSpace));
}

} // namespace

std::vector<std::array<std::size_t, 3>>
triangulatePiece(const std::vector<Point2>& plane, const std::vector<Point3>& space)
{
	const std::size_t n = plane.size();
	std::vector<std::array<std::size_t, 3>> triangles;
	if (n == 3)
		return {{0, 1, 2}};
	// best[i n + j]: lowest quality in the best triangulation of corners i .. j; apex: of side ij there.
	std::vector<double> best(n * n, std::numeric_limits<double>::infinity());
	std::vector<std::size_t> apex(n * n, 0);
	for (std::size_t span = 2; span < n; ++span)
		for (std::size_t i = 0; i + span < n; ++i) {
			const std::size_t j = i + span;
			best[i * n + j] = -std::numeric_limits<double>::infinity();
			for (std::size_t k = i + 1; k < j; ++k) {
				const double own =
					quality({&plane[i], &plane[k], &plane[j]}, {&space[i], &space[k], &space[j]});
				const double worst = std::min({own, best[i * n + k], best[k * n + j]});
				if (worst > best[i * n + j] || k == i + 1) {
					best[i * n + j] = worst;
					apex[i * n + j] = k;
				}
			}
		}
	std::vector<std::pair<std::size_t, std::size_t>> stack{{0, n - 1}};
	while (!stack.empty()) {
		const auto [i, j] = stack.back();
		stack.pop_back();
		if (j - i < 2)
			continue;
		const std::size_t k = apex[i * n + j];
		triangles.push_back({i, k, j});
		stack.push_back({i, k});
		stack.push_back({k, j});
	}
	return triangles;
}

} // namespace ricci
