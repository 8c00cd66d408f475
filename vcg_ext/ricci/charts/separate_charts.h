// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SEPARATE_CHARTS_H
#define RICCI_SEPARATE_CHARTS_H

#include "../layout/parametrization.h"

#include <optional>
#include <vector>

namespace ricci {

/// Counts in the report, as overlapCuts and in its seamLength, by what the seams have grown since they were
/// \p before.
void countCuts(const Seams& before, Parametrization& map);

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
constexpr double kPackingPrice = 2.3;

/// Share of the square that has to lie beside a chart in its smallest bounding rectangle, where it is cut.
constexpr double kRoomOfChart = 0.04;

/// Shares of a chart's length, at either end, that a cut for packing leaves whole. The second is tried where the first
/// finds crumbs alone.
constexpr double kCutFrom[] = {0.1, 0.4};

/// A cut that divides a chart.
struct ChartCut
{
	std::vector<std::vector<int>> pieces; ///< triangles of each
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

} // namespace ricci

#endif
