// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SEPARATE_CHARTS_H
#define RICCI_SEPARATE_CHARTS_H

#include "../layout/parametrization.h"
#include "chart_overlap.h"
#include "dual_graph.h"

#include <optional>
#include <vector>

namespace ricci {

/// Counts in the report, as overlapCuts and in its seamLength, by what the seams have grown since they were
/// \p before.
void countCuts(const EdgeSet& before, Parametrization& map);

/// Replaces the charts of \p map that cover a part of the plane more than once (see OverlapSearch) by the
/// parts of divideChart(), joined again by joinParts() across seams where they fit, each from the
/// origin. The report counts the charts, and what the seams have grown or shrunk by, in edges and in
/// length.
/// \param turns their smallest bounding rectangles along the axes; else they keep the directions they have
/// \param reflects flipped triangles are cut off and reflected
void separateCharts(bool turns, bool reflects, Parametrization& map);

/// Joins charts across seams where they fit (joinParts()): those whose sides are as long in the
/// plane on both sides of the seam. Each is left as separateCharts() leaves a divided one. The report
/// counts the charts, not what the seams have shrunk by.
/// \pre no chart overlaps itself
void joinCharts(Parametrization& map);

/// Seams may grow by one part for this many parts more of covered square: the worth of a map is
/// log(occupancy) - kPackingPrice log(sqrt(area) + seams), up to a constant.
constexpr double kPackingPrice = 0.7;

/// What a cut costs besides that divides one half of mirrored seams alone.
constexpr double kMirroredSurcharge = 1.6;

/// Share of the square that has to lie beside a chart in its smallest bounding rectangle, where it is cut.
constexpr double kRoomOfChart = 0.04;

/// Shares of a chart's length, at either end, that a cut for packing leaves whole. The second is tried where the first
/// finds crumbs alone.
constexpr double kCutFrom[] = {0.1, 0.4};

/// A cut that divides a chart.
struct ChartCut
{
	Parts pieces;
	int edges = 0;
	double length = 0.0; ///< on the surface
	int chart = -1;      ///< its number
};

/// Finds a cut of a chart in two, along the edges of least length on the surface, across its smallest bounding
/// rectangle, where parts of it that are no longer than \p longest are fewest, or where findCutForPacking() has it; if
/// that leaves crumbs, with these. ChartCut::chart is left to the caller.
/// \return none where nothing is cut
std::optional<ChartCut>
findCutToFit(const FlatMesh& mesh, const std::vector<int>& triangles, double longest);

/// Finds a cut of a chart in two: along the edges of least length on the surface, where those far from the middle
/// count as longer, across its smallest bounding rectangle (kCutFrom). Takes the chart that leaves most room
/// there, of those whose cut may be worth what it costs by kPackingPrice.
/// \param map packed
/// \param onSurface area of the surface
/// \return none where there is no such chart
std::optional<ChartCut> findCutForPacking(const Parametrization& map, double onSurface);

/// Makes a cut. The pieces are left as those of separateCharts(), in the report, too.
void cutChart(const ChartCut& cut, bool turns, Parametrization& map);

/// Makes each of some triangles a chart, and each connected part of what they leave of their charts: from the
/// origin, in the directions that it has. The report counts the charts and the cuts as separateCharts() does.
void cutOff(const std::vector<int>& triangles, Parametrization& map);

/// Part 1 on one side of a cut of least weight between two sets of triangles, 0 on the other.
Array<int>
leastCut(const DualGraph& graph, const std::vector<int>& from, const std::vector<int>& to);

/// Divides a chart along edges of its triangles so that no part covers itself. Two triangles are
/// neighbours where their sides are joined.
///
/// As long as a part has an overlap, one sheet of it is grown from its largest overlapping triangle,
/// and the minimum cut of the dual graph between this sheet and all that it covers divides the part
/// (cutting an edge costs its length on the surface). Cutting moves nothing in the plane, so each cut
/// removes pairs and makes none. The cut is exact where sheet and covered triangles lie near each other, else the
/// least one among the triangles nearest to either. A later cut can make an earlier one needless: joinParts() finds
/// that. The same input always gives the same parts.
///
/// A fold may hide an overlap and then go to another part than the triangles that it hides: what appears
/// in the parts is added to the pairs, and the chart is divided again. A chart of so many sheets that not
/// all pairs are listed is first halved, across its middle.
/// \param overlaps of chart.corners()
/// \return the triangles of each connected part, in increasing order, the parts by their first
Parts divideChart(const FlatMesh& chart, const OverlapSearch& overlaps);

/// Share of the area in space below which a part is joined to another wherever possible.
constexpr double kCrumb = 0.01;

/// Joins parts of a chart across seams: the sides of a seam are isometric, so that a part can be moved to
/// the other side of it, where it often fits. Two parts at a time are joined, along the longest border
/// at which nothing is covered twice then. What is left and smaller than kCrumb of all, and much smaller
/// than the largest part, is divided among the parts round it, if all of it fits there and seams
/// get no longer. Sides that come to lie on each other are joined.
/// \param chart its points are moved and renumbered
/// \param parts triangles of each, connected; none covers itself
/// \return the parts that are left: their triangles in increasing order, the parts by their first
Parts joinParts(FlatMesh& chart, const Parts& parts);

} // namespace ricci

#endif
