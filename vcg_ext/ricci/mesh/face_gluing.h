// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FACE_GLUING_H
#define RICCI_FACE_GLUING_H

#include "../base/graphs.h"
#include "surface_mesh.h"

#include <array>
#include <vector>

namespace ricci {

/// Which sides of triangles are glued to each other.
struct FaceGluing
{
	CornerArray<Corner> glued; ///< [side] the side that is glued to it; none on a boundary
	std::vector<Corner> alone; ///< sides that no other triangle has
	int cutEdges = 0;          ///< edges with more than two sides, or with two of equal vertices
	int duplicateFaces = 0;    ///< triangles with the vertices of one before them
};

/// A side of several that meet at an edge.
struct Page
{
	Corner side;
	double
		angle; ///< of the triangle about the edge, in [-pi, pi]; that of the first where it has no area
	bool isThin; ///< rounding may have turned it about the edge (kThinTriangle)
};

/// The pages of an edge, whose ends are those of its first side. Equal triangles have the same angle, bit for bit.
/// \param sides have their ends at the same two places
std::vector<Page> pagesOf(
	const std::vector<Point3>& positions,
	const Array<Triangle>& triangles,
	ItemRange<const Corner> sides);

/// Glues triangles to surfaces in which no edge has more than two sides.
///
/// The two sides of an ordinary edge are glued, whatever their directions. Where more meet, they are
/// paired along the smoothest continuation, where their orientation is coherent and no surface becomes
/// one-sided by it; what is left over becomes boundary. Triangles with the same
/// three vertices are never glued to each other: they belong to different sheets, in the order of
/// their numbers.
/// \pre no triangle uses a vertex twice
FaceGluing glueFaces(const std::vector<Point3>& positions, const Array<Triangle>& triangles);

/// Connected pieces of glued triangles, and an orientation of each.
struct FacePartition
{
	Array<int> component;   ///< [face] in the order of their lowest faces
	Array<char> reversed;   ///< [face] 1 for the minority in each component that is to be turned
	Array<char> isOneSided; ///< [component] no orientation fits all its faces
	Array<Corner> contradicted; ///< glued sides, the lower of each two, where it does not fit

	int componentCount() const { return isOneSided.size(); }
};

FacePartition partitionFaces(const Array<Triangle>& triangles, const CornerArray<Corner>& glued);

/// Where a one-sided surface is cut.
enum class OneSidedCut {
	Shortest, ///< along a short one-sided loop of edges
	/// Along a short one of those that touch the boundary least: clear of it, a cut keeps the Euler
	/// characteristic, and a loop through it is an arc, which raises it by 1
	ClearOfBoundary,
	Everywhere ///< along all contradicted edges, which leaves no one-sided component
};

/// Cuts every one-sided component of \p partition. The cut may still leave one: a Klein bottle becomes a Möbius
/// band or an annulus. Where the edges between faces of opposite orders are about as short, the cut is there, and
/// no face has to be turned.
///
/// The loop is the shortest through any of a few vertices: two shortest paths and an edge, because of
/// two loops that a third path makes of a one-sided loop one is one-sided ([Thomassen 1990]).
/// \pre an edge of glued triangles is determined by its vertices (see OpenedMesh)
void cutOneSided(
	const std::vector<Point3>& positions,
	const Array<Triangle>& triangles,
	const FacePartition& partition,
	OneSidedCut cut,
	CornerArray<Corner>& glued);

/// Leaves a side without the other that it was glued to.
void unglue(Corner side, CornerArray<Corner>& glued);

/// Divides the sides that no other face shares by index into those to be joined, and the others: these are of parts
/// (SurfaceMesh) less than nine tenths of whose sides are such, unless \p all are to be joined.
/// \param alone see FaceGluing
std::array<std::vector<Corner>, 2> sidesToJoin(
	const Array<Triangle>& triangles,
	const std::vector<Corner>& alone,
	const std::vector<int>& part,
	bool all);

/// Finds edges of a surface whose two faces have vertices of their own there.
///
/// Two sides of faces that no other face shares by index are one edge if their ends are bit-equal. Where just two
/// lie there they are joined; where more do, each is joined to the one that is met first when one turns round the
/// edge through the inner side of its face, if that one runs the other way. Faces that lie on one another (kSmall)
/// are never joined, and vertices become one only through joined edges.
///
/// So solids that touch stay apart, in a soup of faces too, and so do the two sides of a leaf.
/// \param alone sides that no other face shares by index, see FaceGluing
/// \param part see SurfaceMesh
/// \param vertices receives the merges of the vertices that are one
/// \return pairs of sides that are one edge
/// \pre no triangle uses a vertex twice; positions are finite
std::vector<std::array<Corner, 2>> findSplitVertices(
	const std::vector<Point3>& positions,
	const Array<Triangle>& triangles,
	const std::vector<Corner>& alone,
	const std::vector<int>& part,
	DisjointSets& vertices);

} // namespace ricci

#endif
