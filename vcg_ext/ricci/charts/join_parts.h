// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_JOIN_PARTS_H
#define RICCI_JOIN_PARTS_H

#include "movable_parts.h"

#include <vector>

namespace ricci {

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
