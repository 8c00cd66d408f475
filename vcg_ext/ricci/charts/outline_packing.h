// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_OUTLINE_PACKING_H
#define RICCI_OUTLINE_PACKING_H

#include "../base/points.h"
#include "../layout/flat_mesh.h"
#include "../options.h"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace ricci {

/// The numbers of lengths or areas, those of the largest first. They count as shares of \p whole, without the digits in
/// which equal ones may differ, so that the order is the same on every machine.
std::vector<std::size_t> largestFirst(std::vector<double> sizes, double whole);

/// The border of a chart: straight sides from one point to the next, the chart on the left of each.
using Outline = std::vector<std::array<Point2, 2>>;

/// Cells along a side of the square in which packOutlines() first places so many outlines.
int coarseCells(std::size_t outlines);

/// Packs outlines into a square from the origin, by cells that they touch, one after the other. Each goes
/// where the square that holds all so far is smallest, also in holes and bays of others. The largest is the first, at
/// several angles; of the others the one that reached farthest comes earlier the next time. Orders are tried in
/// coarse cells, the best again in fine ones, as long as the square gets smaller. Cells are smaller where there are
/// more outlines, and time grows with their number about as its power 1.5. The same outlines always get the same
/// places: turns are rational points of the circle.
/// \param outlines not empty, none without sides
/// \param turns [outline]
/// \param side of the square
/// \param padding least distance of two outlines
/// \return [outline] its motion; empty where they do not fit
std::vector<Motion> packOutlines(
	const std::vector<Outline>& outlines,
	const std::vector<ChartTurns>& turns,
	double side,
	double padding);

/// How many of so many outlines lie in one of the squares that their areas need.
std::size_t outlinesPerSquare(std::size_t outlines, double squares);

/// Packs outlines into squares of one side, as many as they take, by cells that they touch, the largest first. Each goes
/// into the first square in which there is room for it, where the square that holds all so far is smallest. The same
/// outlines always get the same places.
/// \param outlines not empty, none without sides
/// \param turns [outline]
/// \param padding least distance of two outlines
/// \return [outline] its square, and its motion into the one at the origin; empty where one fits into no square
std::vector<std::pair<int, Motion>> packIntoTiles(
	const std::vector<Outline>& outlines,
	const std::vector<ChartTurns>& turns,
	double side,
	double padding);

} // namespace ricci

#endif
