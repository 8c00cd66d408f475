// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DOUBLE_SURFACE_H
#define RICCI_DOUBLE_SURFACE_H

#include "triangulation.h"

#include <vector>

namespace ricci {

/// Two copies of a surface with boundary, the second one turned round, glued along the boundary: a
/// closed surface. Vertices, edges, halfedges and faces of the surface keep their numbers in the
/// first copy (an outer halfedge becomes the second copy's inner one).
struct DoubleSurface
{
	Triangulation triangulation;
	std::vector<int> mirror; ///< [vertex] its image in the other copy; itself on the boundary
	std::vector<int> edgeOf; ///< [edge] the surface's edge that it is or mirrors
};

DoubleSurface doubleOf(const Triangulation& t);

} // namespace ricci

#endif
