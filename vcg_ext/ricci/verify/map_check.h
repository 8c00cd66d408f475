// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MAP_CHECK_H
#define RICCI_MAP_CHECK_H

#include "../layout/flat_mesh.h"

namespace ricci {

/// Errors of a chart in the plane, found from its triangles alone.
struct MapCheck
{
	bool finite = true;

	/// Largest difference of the lengths of the two sides of an edge that two triangles share, relative
	/// to the extent of the chart.
	double seamGap = 0.0;

	/// Triangles that the map flips or flattens (exact predicate) although they are higher than \p
	/// tolerance times the extent.
	int flipped = 0;
};

/// \param tolerance relative to the extent of the chart
MapCheck checkMap(const FlatMesh& chart, double tolerance);

} // namespace ricci

#endif
