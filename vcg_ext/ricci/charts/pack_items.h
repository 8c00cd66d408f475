// SPDX-License-Identifier: GPL-3.0-or-later
// What has a place as a whole when charts are packed: a chart by its outline, or several small ones side by side in a
// box.
#ifndef RICCI_PACK_ITEMS_H
#define RICCI_PACK_ITEMS_H

#include "../base/points.h"
#include "../layout/flat_mesh.h"
#include "../options.h"
#include "outline_packing.h"

#include <cstddef>
#include <vector>

namespace ricci {

/// Side that a square needs at least to hold boxes.
double leastSquare(const std::vector<Box2>& boxes);

/// [box] Translations, never turns or scalings, that bring boxes along the axes close together in about a square and
/// leave at least \p padding >= 0 between any two. One box stays where it is. The boxes are not empty; they may have
/// no width or no height.
std::vector<Point2> sideBySide(std::vector<Box2> boxes, double padding);

/// Moves every point p of chart i to motions[i](p).
void moveCharts(const std::vector<Motion>& motions, FlatMesh& mesh);

/// Lays charts along the axes that have an uprightTurn().
/// \param triangles [chart]
/// \return [chart] 1 for these
std::vector<char> turnUpright(const std::vector<std::vector<int>>& triangles, FlatMesh& mesh);

/// Widens the boxes of charts about their middles, where a side is shorter than kThinSide times the room
/// that the chart's triangles want: to be given a height they lie side by side in two directions.
/// \param triangles [chart]
/// \param side of a square that holds charts
/// \return [box] 1 for those that are thinner than kBoxRoom, which are not turned
std::vector<char>
widen(const std::vector<std::vector<int>>& triangles, double side, std::vector<Box2>& boxes);

/// Charts before they are packed.
struct ChartsToPack
{
	const FlatMesh& mesh;
	const std::vector<std::vector<int>>& triangles; ///< [chart]
	const std::vector<Box2>& boxes;                 ///< [chart]
	const std::vector<char>& isThin;                ///< [chart]
	const std::vector<char>& isUpright;             ///< [chart] turned by right angles only
	ChartTurns turns;                               ///< of the others
};

/// The square that they are packed into, or one of them.
struct PackSquare
{
	double side;
	double padding;     ///< between charts
	std::size_t charts; ///< that it holds
	double longestBox;  ///< of small charts
	const PlaceBoxes& placeBoxes;
};

struct PackItems
{
	std::vector<Outline> outlines;   ///< [item]
	std::vector<ChartTurns> turns;   ///< [item]
	std::vector<std::size_t> itemOf; ///< [chart] what it is in
	std::vector<Point2> shiftOf;     ///< [chart] before the item is moved
	bool isMostlySmall = false; ///< boxes of small charts have more than half of the area of all

	/// Of chart \p i, where its item is moved by \p motion.
	Motion motionOf(std::size_t i, const Motion& motion) const
	{
		return {motion.turn, asComplex(motion(shiftOf[i]))};
	}
};

/// The largest charts by their outlines, the others in as few boxes as PackSquare::longestBox allows.
PackItems packItems(const ChartsToPack& charts, const PackSquare& square);

} // namespace ricci

#endif
