// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PART_GRAPH_H
#define RICCI_PART_GRAPH_H

#include "chart_sides.h"

#include <algorithm>
#include <cstdint>

namespace ricci {

/// The dual graph of a chart that falls into parts: triangles are joined where they share an edge's
/// vertices, and both its ends in the plane. An edge weighs what it costs to cut it: its length.
class PartGraph
{
public:
	PartGraph(const DrawnChart& chart, const ChartSides& sides) :
			part(chart.triangles.size(), 0), m_chart(chart), m_sides(sides)
	{
		for (const int side : sides.across.indices())
			m_longest = std::max(m_longest, sides.lengthOf(side));
	}

	/// joinedSide().
	int joined(int side) const { return joinedSide(m_chart, m_sides.across, side); }

	/// joined(), if it is in the same part; else -1.
	int neighbour(int side) const
	{
		const int other = joined(side);
		return other >= 0 && part[other / 3] == part[side / 3] ? other : -1;
	}

	/// In units of 1e-9 of the chart's longest edge, at least 1.
	std::int64_t weight(int side) const
	{
		constexpr double kUnits = 1e9;
		return m_longest > 0.0
				   ? static_cast<std::int64_t>(m_sides.lengthOf(side) / m_longest * kUnits) + 1
				   : 1;
	}

	Array<int> part; ///< [triangle] number

private:
	const DrawnChart& m_chart;
	const ChartSides& m_sides;
	double m_longest = 0.0; // edge, in space
};

} // namespace ricci

#endif
