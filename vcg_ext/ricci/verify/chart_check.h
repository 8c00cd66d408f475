// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CHART_CHECK_H
#define RICCI_CHART_CHECK_H

#include "../math/points.h"
#include "../surface/surface_mesh.h"

#include <cstddef>
#include <vector>

namespace ricci {

/// Number of pairs of border sides of one chart that cross deeper than \p depth: every end lies
/// farther than that from the line of the other side. A chart without turned triangles whose border
/// does not cross itself covers no region partly twice.
/// \param triangles corners by vertex
/// \param plane [triangle][corner]; two triangles meet at a side where they have both of its
/// vertices and both of their places in common
int borderCrossings(
	const std::vector<Triangle>& triangles,
	const std::vector<Triangle2>& plane,
	double depth);

/// Whether each of 0 .. \p count - 1 is in exactly one of \p parts.
bool isPartition(const std::vector<const std::vector<int>*>& parts, std::size_t count);

} // namespace ricci

#endif
