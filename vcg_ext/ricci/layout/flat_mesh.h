// SPDX-License-Identifier: GPL-3.0-or-later
// The folder layout: triangles unfolded into the plane or the disk, and FlatMesh, what a map is from here on. No
// point is moved for quality.
#ifndef RICCI_FLAT_MESH_H
#define RICCI_FLAT_MESH_H

#include "../base/graphs.h"
#include "../base/indexed.h"
#include "../base/points.h"
#include "../mesh/surface_mesh.h"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace ricci {

/// Triangles laid out in the plane or in the Poincaré disk: the mesh's own, or those of its refinement
/// (overlay_pieces.h). Corner k of a triangle begins its side k.
struct FlatMesh
{
	/// [triangle] corners by vertex of the surface, or by point of the refinement, in the one order that
	/// is counter-clockwise where the map is right
	Array<Triangle> vertices;
	/// [side] the other side of its edge, which runs the other way; none where the surface ends.
	/// Empty in results, whose triangles are in the input's order.
	CornerArray<Corner> across;
	/// [triangle] corners by point: two corners are joined if and only if they have one point number
	Array<Triangle> points;
	Array<Point2> place;                  ///< [point]
	Array<std::array<double, 3>> lengths; ///< [triangle] of its sides on the surface
	/// [side] inside a polygon (SurfaceMesh); empty where there are none, and in results
	CornerArray<char> isDiagonal;
	Array<int> chart; ///< [triangle] -1: of none
	Array<int> face;  ///< [triangle] the input's face that it lies in
	/// [vertex] where it lies on the input: first the input's vertices, then points of the refinement
	Array<SurfacePoint> source;

	int size() const { return points.size(); }

	Triangle2 at(int triangle) const
	{
		const Triangle& p = points[triangle];
		return {place[p[0]], place[p[1]], place[p[2]]};
	}
	const Point2& at(Corner c) const { return place[points[c]]; }
	/// Of a side.
	std::array<Point2, 2> ends(Corner side) const { return {at(side), at(side.next())}; }

	/// The side across, if both sides of the edge have the same ends in the plane; else none.
	Corner joined(Corner side) const
	{
		const Corner other = across[side];
		return other.isValid() && points[side] == points[other.next()] &&
					   points[side.next()] == points[other]
				   ? other
				   : Corner();
	}

	/// at() of all triangles.
	Array<Triangle2> corners() const;
	/// [point]
	Array<int> chartOfPoints() const;
	/// [chart] its points, in increasing order.
	std::vector<std::vector<int>> pointsByChart(std::size_t chartCount) const;
	/// [chart] its triangles, in increasing order; those of no chart are left out.
	std::vector<std::vector<int>> trianglesByChart(std::size_t chartCount) const;
	/// Some triangles as one chart by itself. Vertices keep their numbers, and the part has no sources.
	FlatMesh part(const std::vector<int>& triangles) const;
	/// [vertex] its place on the surface with the vertices \p positions.
	std::vector<Point3> onSurface(const std::vector<Point3>& positions) const;

	/// Adds the triangles of another mesh, whose vertices, charts and faces have their numbers here already, and
	/// its points after those here. Sources are not added.
	void append(FlatMesh other);

	/// Of all triangles, on the surface; and in the plane, where orientation does not count.
	double area() const;
	double planeArea() const;

	/// Integrals of |J|^2 and |J^-1|^2 over a triangle of the surface, where J is the derivative of the map;
	/// 0 where it has no area there, infinite where it has none in the plane. Orientation does not count.
	std::array<double, 2> stretch(int triangle) const;

	/// 1 + the highest number of a vertex.
	int vertexCount() const;

	/// Of all points.
	Box2 box() const;
	/// [chart] Of its triangles.
	std::vector<Box2> boxes(std::size_t chartCount) const;
};

/// Edges of the surface whose two sides are not joined, in one chart or two.
EdgeSet seams(const FlatMesh& mesh);

/// Renumbers the points: two corners are one point if a chain of triangles with joined sides connects
/// them, at the place of the first of them. Points are in the order of their first corners.
/// \param place place(corner)
/// \param isJoined isJoined(side, across) for the two sides of an edge
template<class Place, class IsJoined>
void numberPoints(const Place& place, const IsJoined& isJoined, FlatMesh& mesh)
{
	DisjointSets sets(3 * mesh.vertices.size());
	for (int c = 0; c < sets.size(); ++c)
		if (const Corner side(c), other = mesh.across[side];
			other > side && isJoined(side, other)) {
			sets.merge(c, other.next().number());
			sets.merge(side.next().number(), other.number());
		}
	Array<int> number(sets.size(), -1);
	Array<Point2> places;
	Array<Triangle> points(mesh.vertices.size());
	for (int c = 0; c < sets.size(); ++c) {
		const int first = sets.find(c); // never above the corner
		if (first == c) {
			number[c] = places.size();
			places.push_back(place(Corner(c)));
		}
		points[Corner(c)] = number[first];
	}
	mesh.points = std::move(points);
	mesh.place = std::move(places);
}

/// Turns all triangles over: a map of a mirror image. Each chart is mirrored in its box.
/// \param order of their corners then
void mirror(const CornerOrder& order, std::size_t chartCount, FlatMesh& mesh);

/// Gives triangles that no chain of joined sides in one chart connects points of their own, and forgets
/// points that no corner has.
void splitPoints(FlatMesh& mesh);

/// Scales a map by one factor to the area of the surface, if it has any in the plane.
void scaleToSurface(FlatMesh& mesh);

/// Finds FlatMesh::across by the vertices.
void connect(FlatMesh& mesh);

/// Marks of sides, for FlatMesh::isDiagonal.
CornerArray<char> sidesOf(const SideMarks& marks);

/// The flat mesh, one chart, of the faces of a surface whose corners are placed one by one: two corners at one
/// vertex are one point if a chain of triangles joins them whose common sides have the same ends in the plane.
/// \param vertices [triangle] corners by vertex, counter-clockwise where \p plane is right
/// \param plane [triangle][corner]
/// \param positions [vertex] its place in space
FlatMesh flatMeshOf(
	Array<Triangle> vertices, const Array<Triangle2>& plane, const std::vector<Point3>& positions);

/// Vertices as points of their surface.
Array<SurfacePoint> verticesOf(std::size_t count);

} // namespace ricci

#endif
