// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CHART_SIDES_H
#define RICCI_CHART_SIDES_H

#include "chart_overlap.h"

#include <array>
#include <cstddef>
#include <utility>

namespace ricci {

// Side 3 i + k of triangle i begins at its corner k; corners have the same numbers.

/// The next side of a triangle.
inline int nextSide(int side)
{
	return side % 3 < 2 ? side + 1 : side - 2;
}

/// The side of a triangle before it.
inline int previousSide(int side)
{
	return side % 3 > 0 ? side - 1 : side + 2;
}

/// Ends of a side in the plane.
inline std::array<Point2, 2> endsOf(const DrawnChart& chart, int side)
{
	const Triangle2& p = chart.plane[side / 3];
	return {p[positionOf(side % 3)], p[positionOf((side + 1) % 3)]};
}

/// For each side the one of another triangle with the same two vertices, which runs the other way, or
/// -1. Where more than two sides have them, only such are found that lie at one place in the plane.
Array<int> sidesAcross(const DrawnChart& chart);

/// The side across, where it lies at the same place in the plane; else -1.
inline int joinedSide(const DrawnChart& chart, const Array<int>& across, int side)
{
	if (across[side] < 0)
		return -1;
	const auto own = endsOf(chart, side), other = endsOf(chart, across[side]);
	return own[0] == other[1] && own[1] == other[0] ? across[side] : -1;
}

/// The sides of a chart's triangles.
struct ChartSides
{
	Array<int> across;                   ///< [side] from sidesAcross()
	Array<std::array<double, 3>> length; ///< [triangle][side] in space

	double lengthOf(int side) const { return length[side / 3][positionOf(side % 3)]; }
};

} // namespace ricci

#endif
