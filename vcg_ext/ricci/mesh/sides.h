// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SIDES_H
#define RICCI_SIDES_H

#include "../base/graphs.h"
#include "surface_mesh.h"

#include <functional>
#include <vector>

namespace ricci {

/// The sides of triangles by edge: those with the same two ends, in either direction, are the sides of
/// one edge. Side c runs from corner c to corner c.next().
class Sides
{
public:
	explicit Sides(const std::vector<Triangle>& triangles);

	/// Calls \p visit(sides) for every edge, with an ItemRange<const Corner> in increasing order. The
	/// edges come in the order of their lower ends, then of their higher ends.
	template<class Visit>
	void forEdges(const Visit& visit) const
	{
		for (int i = 0; i + 1 < m_first.size(); ++i)
			visit(ItemRange<const Corner>(
				m_sides.data() + m_first[i], m_sides.data() + m_first[i + 1]));
	}

	/// [side] The other side of an edge that has two, which run in opposite directions; else none.
	const CornerArray<Corner>& across() const { return m_across; }

private:
	Array<Corner> m_sides;        // by edge
	Array<int> m_first;           // [edge] into m_sides; their number
	CornerArray<Corner> m_across; // [side]
};

/// [triangle] Normals of length 1. A triangle too thin to have one (kThinTriangle) lies in the plane of the triangle
/// across its longest side, or if that has none, of another beside it: so a crease that passes it runs along one of
/// its sides. 0 where none is connected to a triangle with a normal.
/// \param across [side] the other side of the edge, or none; it starts at the same vertex if its triangle has the
/// opposite orientation
Array<Point3> normalsOf(
	const std::vector<Point3>& positions,
	const std::vector<Triangle>& triangles,
	const CornerArray<Corner>& across);

/// Whether the surface bends between two triangles with these normals, one of which may be 0, by more than the angle of
/// this cosine.
bool isCrease(const Point3& m, const Point3& n, double cosine);

/// The edges at which a surface bends.
struct Creases
{
	/// [face][k] 1 where the side from corner k is one, on one of the two sides of an edge, as in
	/// SurfaceMesh::seam.
	SideMarks sides;
	int edges = 0;
	/// What is left, away from creases and boundary, of the sum of |K| over all vertices inside: 0 to 1. 0
	/// for a surface that unfolds between its creases.
	double curvatureBetween = 1.0;
};

/// \param positions, triangles, sides of an oriented manifold
/// \param angle radians between the normals of the two triangles at an edge, above which it is a crease.
/// Edges of a triangle so thin that it has no normal are none.
Creases creases(
	const std::vector<Point3>& positions,
	const std::vector<Triangle>& triangles,
	const Sides& sides,
	double angle);

/// Tells of corners of two faces at one vertex whether a map that the mesh has jumps between them: it puts the faces
/// into different pictures, or the corners more than kSameCoordinate of the widest extent of all coordinates apart. Two
/// NaN are equal.
/// \param map must outlive the result
std::function<bool(Corner, Corner)> jumpsOf(const std::vector<MappedFace>& map);

} // namespace ricci

#endif
