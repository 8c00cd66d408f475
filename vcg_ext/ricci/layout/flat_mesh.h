// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FLAT_MESH_H
#define RICCI_FLAT_MESH_H

#include "../base/indexed.h"
#include "../math/points.h"
#include "../surface/sides.h"
#include "../surface/surface_mesh.h"
#include "../surface/surface_point.h"

#include <array>
#include <vector>

namespace ricci {

/// Triangles laid out in the plane or in the Poincaré disk: the mesh's own, or those of its refinement
/// (common_refinement.h). Corner k of a triangle begins its side k.
struct FlatMesh
{
	/// [triangle] corners by vertex of the surface, or by point of the refinement, in the one order that
	/// is counter-clockwise where the map is right
	Array<Triangle> vertices;
	/// [triangle] corners by point: two corners are joined if and only if they have one point number
	Array<Triangle> points;
	Array<Point2> place;                  ///< [point]
	Array<std::array<double, 3>> lengths; ///< [triangle] of its sides on the surface
	Array<int> chart;                     ///< [triangle]
	Array<int> face;                      ///< [triangle] the input's face that it lies in
	/// [vertex] where it lies on the input; empty where the triangles are the mesh's own
	Array<SurfacePoint> source;

	Triangle2 at(int triangle) const
	{
		const Triangle& p = points[triangle];
		return {place[p[0]], place[p[1]], place[p[2]]};
	}

	/// 1 + the highest number of a vertex.
	int vertexCount() const;

	/// Of all points.
	Box2 box() const;
};

/// Whether the two sides of an edge have the same ends in the plane.
inline bool isJoined(const FlatMesh& mesh, Corner side, Corner across)
{
	return mesh.points[side] == mesh.points[across.next()] &&
		   mesh.points[side.next()] == mesh.points[across];
}

/// One side of a triangle, by the lower and the higher number of its ends.
struct FlatSide
{
	int low, high;     ///< vertices
	int atLow, atHigh; ///< points
	int triangle;
};

/// Calls \p visit(sides, count) for every edge of the surface, with an array of its sides in order of
/// their triangles.
template<class Visit>
void forEdges(const std::vector<FlatSide>& sides, const Visit& visit)
{
	for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
		while (end < sides.size() && sides[end].low == sides[i].low &&
			   sides[end].high == sides[i].high)
			++end;
		visit(&sides[i], static_cast<int>(end - i));
	}
}

/// The sides of all triangles, in order of their edges.
std::vector<FlatSide> sidesByEdge(const FlatMesh& mesh);

/// Whether the sides of an edge are those of two triangles with the same ends in the plane.
bool isInside(const FlatSide* sides, int count);

/// The flat mesh of triangles whose corners are placed one by one: two corners at one vertex are one
/// point if a chain of triangles joins them whose common sides have the same ends in the plane.
/// \param vertices [triangle] corners by vertex, counter-clockwise where \p plane is right
/// \param plane [triangle][corner]
/// \param chart [triangle] triangles of different charts share no points
FlatMesh flatMeshOf(
	Array<Triangle> vertices,
	const Array<Triangle2>& plane,
	Array<int> chart,
	Array<std::array<double, 3>> lengths);

} // namespace ricci

#endif
