// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_OPENED_MESH_H
#define RICCI_OPENED_MESH_H

#include "../options.h"
#include "elements.h"
#include "face_gluing.h"
#include "surface_mesh.h"

#include <string>
#include <vector>

namespace ricci {

/// A mesh cut open where it is not an oriented manifold, and along the seams that its caller wants. Its
/// faces have the order of the input, those without area left out; a vertex keeps its number, and
/// copies of it follow after all vertices. Of a mesh that needs no cut it is a copy with the same
/// numbers.
struct OpenedMesh
{
	/// At most two triangles at an edge, one fan at a vertex, two-sided components. An edge is
	/// determined by its vertices.
	SurfaceMesh mesh;
	std::vector<int> vertex; ///< [vertex of mesh] number in the input
	/// [vertex of the input] the vertex that it is one with, which has its faces; empty where none are joined
	std::vector<int> joined;
	std::vector<int> face;       ///< [face of mesh] number in the input
	std::vector<int> degenerate; ///< faces of the input that are left out

	FaceArray<int> component; ///< [face of mesh] in the order of their lowest faces
	FaceArray<char>
		reversed; ///< [face of mesh] 1 if it is turned: the majority of a component is not
	int componentCount = 0;

	/// Where the side of a face lies: on a hole, a boundary loop other than the longest of its component before seams
	/// were opened; or on a seam that was opened.
	enum Border : char { Other, OnHole, OnSeam };
	SideMarks border; ///< [face of mesh][k] a Border; empty where no seams were opened

	/// Edges whose faces had vertices of their own there, joined; and by how many pieces the surface would be fewer if
	/// those that are left were.
	int joinedEdges = 0, piecesApart = 0;

	int cutEdges = 0;       ///< edges with more than two faces, or with two of the same vertices
	int splitVertices = 0;  ///< vertices of the input that have copies, also without the seams
	int duplicateFaces = 0; ///< faces with the vertices of one before them
	int oneSidedComponents = 0; ///< cut along one-sided loops

	int seamEdges = 0;            ///< edges opened because they are marked, or sharp
	double seamLength = 0.0;      ///< of these, by each pair of sides
	int seamEdgesAdded = 0;       ///< edges by which seams of one edge alone were lengthened
	double seamLengthAdded = 0.0; ///< of these

	bool isAsGiven() const
	{
		const bool hasCopies =
			!vertex.empty() && vertex.back() + 1 != static_cast<int>(vertex.size());
		return !hasCopies && degenerate.empty();
	}

	/// A triangle of the input with vertices that have faces.
	Triangle withJoined(const Triangle& t) const
	{
		return joined.empty() ? t
							  : Triangle{
									joined[positionOf(t[0])],
									joined[positionOf(t[1])],
									joined[positionOf(t[2])]};
	}
};

/// \throw InvalidMesh ArrayLength unless an array has no entries or as many as are wanted
void requireLength(const char* array, std::size_t length, std::size_t wanted);

/// Joins vertices that are split (findSplitVertices()) as \p join says, then cuts a triangle soup open, so that every
/// triangle with an area can be mapped (after the cutting of [Gueziec et al. 2001]): edges with more than two faces by
/// glueFaces(), vertices with more than one fan into one copy for each, one-sided components as \p cut says. Before
/// the last of these, all sheets are opened along SurfaceMesh::seam, the jumps of SurfaceMesh::map and the edges above
/// \p sharpAngle (FlowOptions) that are not inside polygons. A seam of one
/// edge that touches neither another nor a boundary goes on along the edge that leads straightest on: else both its
/// sides would have the same two vertices, and lie on each other in the plane. Left out are faces that use a vertex
/// twice, and components that have no area.
/// \throw InvalidMesh for the first of these that is found, with its number: no faces; marks of sides for another
/// number of faces; faces that use vertices which are not in the mesh; coordinates that are not finite or
/// beyond 1e50; components smaller than 1e-50; no face with an area, or none beside a vertex too far away
OpenedMesh openMesh(
	const SurfaceMesh& mesh,
	OneSidedCut cut = OneSidedCut::Shortest,
	JoinSplitVertices join = JoinSplitVertices::Never,
	double sharpAngle = kPi);

/// Sentences on what openMesh() has done.
std::vector<std::string> openingNotes(const SurfaceMesh& mesh, const OpenedMesh& opened);

} // namespace ricci

#endif
