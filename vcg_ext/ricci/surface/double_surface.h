// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DOUBLE_SURFACE_H
#define RICCI_DOUBLE_SURFACE_H

#include "triangulation.h"

namespace ricci {

/// Two copies of a surface with boundary, the second one turned round, glued along the boundary: a
/// closed surface. Vertices, edges, halfedges and faces of the surface keep their numbers in the
/// first copy; an exterior halfedge of the surface is an interior one of the second copy.
struct DoubleSurface
{
	Triangulation triangulation;
	VertexArray<Vertex> mirror; ///< the image in the other copy; on the boundary the vertex itself
	EdgeArray<Edge> edgeOf;     ///< the surface's edge that it is or mirrors
};

DoubleSurface doubleOf(const Triangulation& t);

} // namespace ricci

#endif
