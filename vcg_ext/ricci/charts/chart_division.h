// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CHART_DIVISION_H
#define RICCI_CHART_DIVISION_H

#include "chart_overlap.h"
#include "dual_graph.h"

#include <vector>

namespace ricci {

/// Part 1 on one side of a cut of least weight between two sets of triangles, 0 on the other.
Array<int>
leastCut(const DualGraph& graph, const std::vector<int>& from, const std::vector<int>& to);

/// Divides a chart along edges of its triangles so that no part covers itself. Two triangles are
/// neighbours where their sides are joined.
///
/// As long as a part has an overlap, one sheet of it is grown from its largest overlapping triangle,
/// and the minimum cut of the dual graph between this sheet and all that it covers divides the part
/// (cutting an edge costs its length on the surface). Cutting moves nothing in the plane, so each cut
/// removes pairs and makes none. The cut is exact, but only the smaller side of it is searched (min_cut.h). A
/// later cut can make an earlier one needless: joinParts() finds that. The same input always gives the same
/// parts.
///
/// A fold may hide an overlap and then go to another part than the triangles that it hides: what appears
/// in the parts is added to the pairs, and the chart is divided again. A chart of so many sheets that not
/// all pairs are listed is first halved, across its middle.
/// \param overlaps of chart.corners()
/// \return the triangles of each connected part, in increasing order, the parts by their first
std::vector<std::vector<int>> divideChart(const FlatMesh& chart, const OverlapSearch& overlaps);

} // namespace ricci

#endif
