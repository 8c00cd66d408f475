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

/// [box] Translations, never turns or scalings, that bring boxes along the axes close together in about a square and
/// leave at least \p padding >= 0 between any two. One box stays where it is. The boxes are not empty; they may have
/// no width or no height.
std::vector<Point2> sideBySide(std::vector<Box2> boxes, double padding);

/// The turn that lays a chart along the axes whose outline runs in two perpendicular directions mostly: more than half
/// its length, to a degree. Else 0.
std::complex<double> uprightTurn(const Outline& outline);

/// Moves every point p of chart i to motions[i](p).
void moveCharts(const std::vector<Motion>& motions, FlatMesh& mesh);

/// Charts before they are packed. Arrays by chart.
struct ChartsToPack
{
	std::vector<std::vector<int>> triangles;
	std::vector<char> isUpright; ///< turned by right angles only
	std::vector<Box2> boxes;
	std::vector<char> isThin;            ///< thinner than kBoxRoom: not turned
	ChartTurns turns = ChartTurns::None; ///< of the others
};

/// Lays charts along the axes that have an uprightTurn(), if they may be turned. Widens their boxes about the middles,
/// where a side is shorter than kThinSide times the room that the chart's triangles want: to be given a height they
/// lie side by side in two directions.
/// \param turns that the charts allow
ChartsToPack
chartsToPack(const PackOptions& options, ChartTurns turns, std::size_t count, FlatMesh& mesh);

/// The square that they are packed into, or one of them.
struct PackSquare
{
	double side;
	double padding;     ///< between charts
	std::size_t charts; ///< that it holds
	double longestBox;  ///< of small charts
};

/// What is laid out in the square: each of the largest charts, and boxes of small ones.
struct PackItems
{
	std::vector<Outline> outlines;   ///< [item]
	std::vector<ChartTurns> turns;   ///< [item]
	std::vector<std::size_t> itemOf; ///< [chart] what it is in
	std::vector<Point2> shiftOf;     ///< [chart] before the item is moved

	/// Of chart \p i, where its item is moved by \p motion.
	Motion motionOf(std::size_t i, const Motion& motion) const
	{
		return {motion.turn, asComplex(motion(shiftOf[i]))};
	}
};

/// The largest charts by their outlines, the others in as few boxes as PackSquare::longestBox allows.
PackItems packItems(const FlatMesh& mesh, const ChartsToPack& charts, const PackSquare& square);

} // namespace ricci

#endif
