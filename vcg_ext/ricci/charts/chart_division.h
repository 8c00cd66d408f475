// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CHART_DIVISION_H
#define RICCI_CHART_DIVISION_H

#include "chart_overlap.h"

#include <vector>

namespace ricci {

/// Divides a chart along edges of its triangles so that no part contains both triangles of one of
/// \p pairs. Two triangles are neighbours where their sides are joined (joinedSide()).
///
/// As long as a part has an overlap, one sheet of it is grown from its largest overlapping triangle,
/// and the minimum cut of the dual graph between this sheet and all that it covers divides the part
/// (cutting an edge costs its length on the surface). Cutting moves nothing in the plane, so each cut
/// removes pairs and makes none. The cut is exact, but only the smaller side of it is searched, and
/// what is nearer to the border of the part than the cut is long (border_flow.h, min_cut.h). In the
/// end neighbouring parts that do not cover each other are joined again. The same input always gives
/// the same parts.
/// \param pairs from overlappingPairs()
/// \return the triangles of each connected part, in increasing order, the parts by their first
std::vector<std::vector<int>>
divideChart(const FlatMesh& chart, const Sides& sides, const std::vector<TrianglePair>& pairs);

} // namespace ricci

#endif
