// SPDX-License-Identifier: GPL-3.0-or-later
// The folder mesh: triangles and half-edges, vertices that are split, opening at non-manifold edges and chosen
// seams, holes, creases, normal coordinates. No curvature, and no place in the plane.
#ifndef RICCI_COMPONENT_H
#define RICCI_COMPONENT_H

#include "../options.h"
#include "elements.h"
#include "opened_mesh.h"
#include "triangulation.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace ricci {

/// One connected, coherently oriented manifold piece of an OpenedMesh, with numbers of its own.
struct Component
{
	VertexArray<int> vertex;  ///< into the positions of OpenedMesh::mesh
	FaceArray<int> face;      ///< into its triangles
	FaceArray<char> reversed; ///< 1 if the order of the input was reversed
	VertexArray<Point3> positions;
	std::vector<Triangle> triangles; ///< [face] numbers of the component's vertices, coherent order
	std::vector<std::array<double, 3>>
		lengths;        ///< [face] of the sides of these triangles, see SurfaceMesh; may be empty
	SideMarks diagonal; ///< of these triangles, see SurfaceMesh; may be empty
	SideMarks hole;     ///< of these triangles: 1 on one, see OpenedMesh; may be empty
	std::vector<Triangle2> map; ///< of these triangles, see SurfaceMesh; may be empty
	bool hasSeam = false;       ///< whether a seam that was opened is on the boundary

	/// Corner of the input face that became corner \p k of face \p f.
	std::size_t inputCorner(Face f, std::size_t k) const { return reversed[f] ? (3 - k) % 3 : k; }

	/// Lengths of the sides of face \p f.
	std::array<double, 3> sides(Face f) const
	{
		return lengths.empty() ? sideLengths(triangles[positionOf(f)], positions.values())
							   : lengths[positionOf(f)];
	}
};

/// The connected components of a mesh, in the order of their lowest faces, with the faces of a
/// minority of incoherent order turned. Each is numbered breadth first from its lowest face.
std::vector<Component> splitIntoComponents(const OpenedMesh& opened);

/// The surface from its other side: all triangles turned over, and numbered as splitIntoComponents() does.
Component turnedOver(Component component, const CornerOrder& order);

/// The component that another one is a copy of.
struct Original
{
	int number = 0;
	/// Where it is its mirror image: the copy turned over, in the numbers of the original, and how its corners are listed.
	std::optional<Component> mirrored;
	CornerOrder order{};
};

/// [component] The first one that it is a copy of, or itself: its sides are as long, triangle by triangle and but for
/// rounding, it is the same by a rigid motion where there are positions, or by one and a reflection, and its vertices have
/// the same values.
/// \param selected, targetCurvature [vertex of the opened mesh] or empty
/// \param mayMirror whether mirror images count
std::vector<Original> originals(
	const std::vector<Component>& components,
	const std::vector<char>& selected,
	const std::vector<double>& targetCurvature,
	bool mayMirror);

/// \throw InvalidMesh if edges have no length or faces no area, as rounding finds them
void requireAreaEverywhere(const std::vector<Component>& components);

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

/// A reflection of space that takes nearly all vertices of a surface to vertices, and whose plane divides the surface
/// along edges into two connected halves.
struct MirrorSymmetry
{
	VertexArray<Vertex> image; ///< in the plane the vertex itself; none where there is none
	EdgeArray<Edge>
		edgeImage; ///< in the plane the edge itself; none for diagonals that are not mirrored
	VertexArray<char> isAbove; ///< 1 on one side of the plane

	/// The half of a face: no face has vertices on both sides.
	bool isAboveFace(const Triangulation& t, Face f) const
	{
		const auto [a, b, c] = t.vertices(f);
		return isAbove[a] || isAbove[b] || isAbove[c];
	}
};

/// Finds one of a surface in space: of its planes that with the shortest edges in sum, whatever the pose, if it mirrors all
/// vertices; else one normal to an axis of the coordinates.
/// \param onHole see FlowDomain; of two holes that are images of each other, one alone may be closed
/// \return null if there is none
std::shared_ptr<const MirrorSymmetry>
findMirror(const EmbeddedSurface& surface, const VertexArray<char>& onHole = {});

} // namespace ricci

#endif
