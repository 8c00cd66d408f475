// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FLOW_DOMAIN_H
#define RICCI_FLOW_DOMAIN_H

#include "../options.h"
#include "component.h"
#include "triangulation.h"

#include <array>
#include <optional>
#include <vector>

namespace ricci {

/// A connected surface with the metric of its straight triangles in space.
struct EmbeddedSurface
{
	Triangulation triangulation;
	VertexArray<Point3> positions; ///< may be empty for surfaces given by lengths alone
	EdgeArray<double> lengths;
	Topology topology;
};

/// Straight-line length of each edge of \p t between \p positions.
EdgeArray<double> edgeLengths(const Triangulation& t, const VertexArray<Point3>& positions);

/// Surface of coherent, manifold triangles; halfedges(Face(f))[k] starts at triangles[f][k].
/// \pre the triangles are connected
EmbeddedSurface
embeddedSurface(VertexArray<Point3> positions, const std::vector<Triangle>& triangles);

/// Two copies of a surface with boundary, the second one reversed, glued along the boundary: a
/// closed surface. Vertices, edges, halfedges and faces of the surface keep their numbers in the
/// first copy; an exterior halfedge of the surface is an interior one of the second copy.
struct DoubleSurface
{
	Triangulation triangulation;
	VertexArray<Vertex> mirror; ///< the image in the other copy; on the boundary the vertex itself
	EdgeArray<Edge> edgeOf;     ///< the surface's edge that it is or mirrors
};

DoubleSurface doubleOf(const Triangulation& t);

/// What one component gives the flow to run on.
struct FlowDomain
{
	EmbeddedSurface surface;    ///< the component's own triangles
	EdgeArray<char> isDiagonal; ///< [edge of surface] see SurfaceMesh; may be empty
	bool isEmbedded = true;     ///< else it is given by lengths, see SurfaceMesh

	/// The surface with caps on its holes, where they are to be closed: after its own vertices the centres
	/// of the caps, after its own triangles those of the caps. Elements of the surface keep their numbers.
	std::optional<EmbeddedSurface> capped;
	VertexArray<char> onHole; ///< [vertex of surface] 1 on a loop that is closed
	int holes = 0;            ///< loops that are closed

	/// Where edges are swapped or split (paper 5.4), and else empty: 1 on the edges that the component does
	/// not have; and [face of the component] the halfedges of the surface at its corners.
	EdgeArray<char> isForeign;
	FaceArray<std::array<Halfedge, 3>> corners;

	/// The halfedges of the surface at the corners of a face of the component.
	std::array<Halfedge, 3> halfedges(Face f) const
	{
		return corners.empty() ? surface.triangulation.halfedges(f) : corners[f];
	}

	/// The surface on which the flow runs.
	const EmbeddedSurface& solved() const { return capped ? *capped : surface; }
};

/// The domain of \p component. Holes are the loops other than the longest; Holes::Capped closes all of them.
/// Holes::ShortCapped closes the loops no longer than a tenth of the square root of the surface's area, divided
/// by 2 genus - 2 if that is above 1: also the longest, so that a closed surface that lacks some faces is closed
/// for the flow.
FlowDomain flowDomain(const Component& component, Holes holes);

} // namespace ricci

#endif
