// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PLANAR_LAYOUT_H
#define RICCI_PLANAR_LAYOUT_H

#include "../base/points.h"
#include "../mesh/component.h"
#include "../mesh/triangulation.h"
#include "flat_mesh.h"

#include <vector>

namespace ricci {

/// A metric laid out in the plane, or in the Poincaré disk (paper 4.3). The cut divides the corners of the surface
/// into wedges: those at one vertex between two cut or boundary edges. The corners of a wedge share one point, so
/// that the layout is continuous everywhere off the cut.
struct PlanarLayout
{
	HalfedgeArray<int> wedge; ///< of the corner at the halfedge's origin; -1 if exterior
	Array<Point2> points;     ///< [wedge]

	const Point2& operator[](Halfedge h) const { return points[wedge[h]]; }
	Point2& operator[](Halfedge h) { return points[wedge[h]]; }
};

/// The wedges, numbered from 0 in order of their lowest halfedge, all of them at 0.
PlanarLayout cornerWedges(const Triangulation& t, const EdgeArray<char>& isCut);

/// The faces of a component as one chart; its points are the wedges.
/// \param layout of the domain's surface
FlatMesh
flatMeshOf(const Component& component, const FlowDomain& domain, const PlanarLayout& layout);

/// Unfolds the triangles one after another across the edges with isCut 0, which must leave the
/// surface connected and simply connected, along the tree that loses least to rounding.
/// Counter-clockwise triangles stay counter-clockwise.
/// \param lengths Euclidean
/// \param angles radians, at the halfedge's origin
/// \param root the first triangle; what is not connected to it has points without a meaning
PlanarLayout layOutInPlane(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const HalfedgeArray<double>& angles,
	const EdgeArray<char>& isCut,
	Face root = Face(0));

/// Finds the boundary loops round which the metric closes by rotation and translation, so that it
/// needs no seam at them: every edge of the cut at such a loop has both of its sides in one place
/// of the layout.
/// \param layout of \p t, cut open along \p isCut
/// \return 1 at the vertices of these loops
VertexArray<char>
loopsThatClose(const Triangulation& t, const PlanarLayout& layout, const EdgeArray<char>& isCut);

/// The order in which triangles are laid out one after another across the edges with isCut 0: a
/// spanning tree of the triangles with the root \p root, as the halfedges across which they are
/// entered. A triangle's neighbour in the tree always comes before it.
///
/// Across a side that is short in its triangle, directions lose as many units of rounding as the
/// longest side is times longer. The tree reaches every triangle by the way that loses least
/// [Dijkstra 1959], which also keeps the number of triangles on the way low. The order is
/// deterministic.
/// \param lengths positive
/// \return for each triangle that can be reached, except for the root, the halfedge of it that is
/// entered first
std::vector<Halfedge> layoutTree(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const EdgeArray<char>& isCut,
	Face root);

} // namespace ricci

#endif
