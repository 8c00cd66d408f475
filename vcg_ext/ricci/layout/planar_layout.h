// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PLANAR_LAYOUT_H
#define RICCI_PLANAR_LAYOUT_H

#include "../surface/triangulation.h"

#include <array>
#include <vector>

namespace ricci {

using Point2 = std::array<double, 2>;

/// A flat metric laid out in the plane (paper 4.3). The corners at a vertex between two cuts form a
/// sector and share one point, so that the layout is continuous everywhere off the cut.
struct PlanarLayout
{
	std::vector<int> sector;      ///< [halfedge] sector of the corner at its origin; -1 if outer
	std::vector<Point2> position; ///< [sector]

	const Point2& at(int h) const
	{
		return position[static_cast<std::size_t>(sector[static_cast<std::size_t>(h)])];
	}
};

/// Unfolds the triangles one after another across the edges with isCut 0, which must leave the
/// surface connected and simply connected, along the tree that loses least to rounding.
/// Counter-clockwise triangles stay counter-clockwise.
/// \param lengths [edge] Euclidean
/// \param angles [halfedge] radians, at the halfedge's origin
PlanarLayout layOutInPlane(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<double>& angles,
	const std::vector<char>& isCut);

/// Sector of each halfedge's corner, numbered from 0 in order of the lowest halfedge; \p count
/// receives their number.
std::vector<int> cornerSectors(const Triangulation& t, const std::vector<char>& isCut, int& count);

} // namespace ricci

#endif
