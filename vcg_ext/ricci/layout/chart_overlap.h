// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CHART_OVERLAP_H
#define RICCI_CHART_OVERLAP_H

#include "../surface/surface_mesh.h"
#include "planar_layout.h"

#include <array>
#include <functional>
#include <vector>

namespace ricci {

/// The triangles of one chart, drawn in the plane. All have one order, so that those which are
/// counter-clockwise in the plane are properly oriented.
struct DrawnChart
{
	std::vector<Triangle> triangles;          ///< vertices, which name the edges
	std::vector<std::array<Point2, 3>> plane; ///< [triangle][corner]
};

/// Share of the chart's size up to which two triangles may cover each other and still only touch:
/// the two sides of a seam that closes in the plane agree to rounding alone.
constexpr double kTouching = 1e-9;

/// Pairs of triangles that cover a part of the plane twice, the lower number first, in order.
///
/// Two triangles have a common inner point exactly if no side of either has the other triangle on
/// its outer side (separating axes of convex polygons; sides are compared by exact orientation, and
/// contact up to kTouching is let pass). Pairs that can meet come from a tree of bounding boxes. So
/// neither the chart's topology nor its boundary matters: holes, slits whose sides coincide, and
/// parts that touch in points or along lines are no overlap, a cone of more than 2 pi round a
/// boundary vertex is.
///
/// Where triangles are turned round, the fold covers points three times although the chart goes on
/// behind it. Such folds are counted elsewhere (Report::flippedFaces); here triangles that are not
/// counter-clockwise count as negative cover, and a pair is an overlap only if a point of its common
/// part is covered more than once in the sum, which is the winding number of the chart's boundary
/// about that point.
///
/// \param tick is called now and then, many times a second: triangles round one vertex meet each
/// other's boxes in as many pairs as the square of their number. What it throws ends the search.
std::vector<std::array<int, 2>> overlappingPairs(
	const DrawnChart& chart, const std::function<void()>& tick = [] {});

/// What a division cuts: edges of the chart's triangles, each counted once.
struct ChartCuts
{
	int edges = 0;
	double length = 0.0; ///< in space
};

/// Divides a chart along edges of its triangles so that no part has one of \p pairs in it. Two
/// triangles are joined where they share an edge's vertices and both of its ends in the plane.
///
/// As long as a part has an overlap, one sheet of it is grown from its largest triangle, and the
/// shortest cut between this sheet and all that it covers (a minimal cut of the dual graph, whose
/// edges are as dear as their length in space) divides the part. Cutting moves nothing in the plane,
/// so each cut removes pairs and makes none. Neighbouring parts that do not cover each other in the
/// end are joined again. Deterministic.
/// \param edgeLength [triangle][side] in space; side k runs from corner k to corner k + 1
/// \param cuts receives what was cut
/// \return the triangles of each connected part, in increasing order, the parts by their first
std::vector<std::vector<int>> divideChart(
	const DrawnChart& chart,
	const std::vector<std::array<int, 2>>& pairs,
	const std::vector<std::array<double, 3>>& edgeLength,
	ChartCuts& cuts);

} // namespace ricci

#endif
