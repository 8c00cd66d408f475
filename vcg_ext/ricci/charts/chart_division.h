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

/// Share of the area in space below which a part is joined to another wherever possible.
constexpr double kCrumb = 0.01;

/// Joins parts of a chart across seams: the sides of a seam are isometric, so that a part can be moved to
/// the other side of it, where it often fits. Two parts at a time are joined, along the longest border
/// at which nothing is covered twice then. What is left and smaller than kCrumb of all, and much smaller
/// than the largest part, is divided among the parts round it, if all of it fits there and seams
/// get no longer. Sides that come to lie on each other are joined.
/// \param chart its points are moved and renumbered
/// \param parts triangles of each, connected; none covers itself
/// \param tree of the boxes of all triangles, if no point lies in many of them
/// \return the parts that are left: their triangles in increasing order, the parts by their first
std::vector<std::vector<int>> joinParts(
	FlatMesh& chart, const std::vector<std::vector<int>>& parts, const BoxTree* tree = nullptr);

} // namespace ricci

#endif
