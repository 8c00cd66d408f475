// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_JOIN_PARTS_H
#define RICCI_JOIN_PARTS_H

#include "chart_division.h"
#include "movable_parts.h"

#include <vector>

namespace ricci {

/// Parts of a chart after joinParts().
struct JoinedParts
{
	std::vector<std::vector<int>>
		parts;       ///< triangles, in increasing order, the parts by their first
	ChartCuts seams; ///< what they have more than before, or less
};

/// Joins parts of a chart across seams: the sides of a seam are isometric, so that a part can be
/// moved to the other side of it, where it often has room. Of all parts the smallest is moved first,
/// along the longest border where it covers nothing, until none can be moved. What is smaller than a
/// hundredth of all then is divided among the parts round it, if they have room for all of it. Sides
/// that come to lie on each other are joined then.
/// \param chart its points are moved and numbered anew
/// \param tree boxTreeOf(chart.corners())
/// \param parts connected, and none covers itself
JoinedParts joinParts(
	FlatMesh& chart,
	const Sides& sides,
	const BoxTree& tree,
	const std::vector<std::vector<int>>& parts);

} // namespace ricci

#endif
