// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MAP_CHECK_H
#define RICCI_MAP_CHECK_H

#include "../math/points.h"
#include "../surface/surface_mesh.h"

#include <vector>

namespace ricci {

/// Errors of a chart in the plane, found from its triangles alone.
struct MapCheck
{
	bool finite = true;

	/// Largest difference of the lengths of the two sides of a seam, relative to the extent of the
	/// chart. Sides in the same place are no seam.
	double seamGap = 0.0;

	/// Triangles that the map turns round or flattens (exact predicate) although they are higher
	/// than \p tolerance times the extent.
	int turned = 0;
};

/// \param triangles corners by vertex; a side that not exactly two triangles share is no seam
/// \param plane [triangle][corner]
/// \param reversed [triangle] 1 where clockwise is wanted
/// \param tolerance relative to the extent of the chart
MapCheck checkMap(
	const std::vector<Triangle>& triangles,
	const std::vector<Triangle2>& plane,
	const std::vector<char>& reversed,
	double tolerance);

} // namespace ricci

#endif
