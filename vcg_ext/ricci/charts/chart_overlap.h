// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CHART_OVERLAP_H
#define RICCI_CHART_OVERLAP_H

#include "../base/indexed.h"
#include "../base/tolerances.h"
#include "../math/points.h"
#include "../progress.h"
#include "../surface/surface_mesh.h"

#include <array>
#include <vector>

namespace ricci {

/// The triangles of one chart, drawn in the plane. Their corners are ordered so that those which are
/// counter-clockwise in the plane are properly oriented.
struct DrawnChart
{
	Array<Triangle> triangles; ///< vertices, which tell the edges that triangles share
	Array<Triangle2> plane;    ///< [triangle][corner]
};

/// Two triangles of a chart, the lower number first.
using TrianglePair = std::array<int, 2>;

/// Pairs of triangles that cover a part of the plane twice, in increasing order.
///
/// Two triangles have a common inner point exactly if no side of either has the other triangle on
/// its outer side (separating axes of convex polygons; sides are compared by orientation(), and
/// contact up to kTouching is ignored). Candidates come from a tree of bounding boxes. So neither
/// the chart's topology nor its boundary matters: holes, slits whose sides coincide, and parts that
/// touch in points or along lines are no overlap; a cone of more than 2 pi at a boundary vertex is.
///
/// Where triangles are turned round, the fold covers points three times although the chart goes on
/// behind it. Folds are counted elsewhere (Report::flippedFaces). Here triangles that are not
/// counter-clockwise count as negative cover, and a pair is an overlap only if a point of its common
/// part is covered more than once in the sum, which is the winding number of the chart's boundary
/// about that point. A part of the chart may have lost the fold that hides an overlap: it has to be
/// searched anew.
///
/// \param extent of the layout that the chart is a part of: how closely its sides can be expected to
/// meet. The chart's own where that is larger.
/// \param tick heard many times a second: the boxes of the n triangles round one vertex meet in as
/// many as n^2 / 2 pairs
std::vector<TrianglePair> overlappingPairs(
	const DrawnChart& chart, const Tick& tick = [] {}, double extent = 0.0);

} // namespace ricci

#endif
