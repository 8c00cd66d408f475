// SPDX-License-Identifier: GPL-3.0-or-later
// From a map whose charts have places of their own each to texture coordinates of all of them.
#ifndef RICCI_PACK_H
#define RICCI_PACK_H

#include "../options.h"
#include "outline_packing.h"
#include "parametrization.h"

#include <complex>
#include <cstddef>
#include <functional>
#include <vector>

namespace ricci {

/// Finds places for boxes along the axes, none of them empty: [box] translations that leave at least
/// \p room >= 0 between any two. One box alone stays where it is. Neither turns nor scales.
using PlaceBoxes = std::function<std::vector<Point2>(const std::vector<Box2>& boxes, double room)>;

/// The widest margin that packCharts() takes.
constexpr double kMaxChartMargin = 0.25;

/// packCharts() calls it; a caller may do so before a long run.
/// \throw InvalidOption ChartMargin unless \p margin is between 0 and kMaxChartMargin
void checkChartMargin(double margin);

/// False if so many charts of any extent cannot keep \p margin, by the area of the margins alone.
bool marginsMayFit(std::size_t charts, double margin);

/// Free; but a rectangle stays upright, and quarter turns across seams stay quarter turns.
ChartTurns chartTurns(const Options& options);

/// Places the bounding boxes of the charts beside each other, and moves the charts there. With \p
/// normalize the smallest square round all boxes with their margins is then scaled to [0, 1]^2.
/// Without it the charts keep their scale, and a single chart keeps its place. A chart with a side that
/// may be too short for triangles that have to be given a height (finishInFloats()) gets a wider box.
/// Fills Chart::box.
///
/// With \p normalize charts may be turned, too, and the largest placed by their outlines, with the boxes
/// of the small and the thin ones as one more chart, where the square gets smaller by kWorthTurning. One
/// chart is turned as the smallest square round it lies. The report's occupancy is set in all cases.
/// \param margin least distance of two charts, and of a chart from the border of the unit square, as
/// a share of the side of that square, between 0 and kMaxChartMargin
/// \throw InvalidOption ChartMargin, or ChartMarginTooWide if so many charts do not fit with it;
/// InvalidMesh BeyondFloats if coordinates that keep their scale are too large or too small for float,
/// in which they will be stored
void packCharts(
	Parametrization& map,
	bool normalize,
	double margin,
	const PlaceBoxes& placeBoxes,
	ChartTurns turns = ChartTurns::None);

/// A strip is cut where the charts then cover this many times as much of the square: about twice.
constexpr double kWorthCutting = 1.7;

/// packCharts() into the unit square, and once more with the largest chart cut by cutStrip(), which is
/// taken where the charts then cover kWorthCutting times as much. Without turns nothing is cut.
/// \throw what packCharts() does
void packStrips(
	Parametrization& map,
	double margin,
	const PlaceBoxes& placeBoxes,
	ChartTurns turns);

/// Places the unit disks of the charts, as parametrizeHyperbolic() leaves them, in equal squares, row
/// by row from the origin, which together lie in [0, 1]^2, and moves the charts there.
/// \return [chart] the square that its disk fills
std::vector<Box2> placeDisks(Parametrization& map);

/// Moves every point p of a chart to factor p + shift, in the input's faces and in the refinement.
void transformChart(
	Parametrization& map, const Chart& chart, std::complex<double> factor, const Point2& shift);

/// Counts the flipped triangles of the output (flippedFaces, flippedByRounding of \p report) at their
/// present coordinates: rounding while the charts are packed can turn a thin triangle round. Exact.
void countFlippedAsWritten(const Parametrization& map, Report& report);

} // namespace ricci

#endif
