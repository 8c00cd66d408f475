// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DRAWN_TRIANGLES_H
#define RICCI_DRAWN_TRIANGLES_H

#include "../base/indexed.h"
#include "../math/points.h"
#include "../surface/surface_mesh.h"

#include <array>
#include <vector>

namespace ricci {

/// Triangles drawn in the plane, which share points where the map is continuous.
struct DrawnTriangles
{
	Array<Triangle> vertices; ///< [triangle] corners by vertex of the surface
	Array<Triangle> corners;  ///< [triangle] corners by point, to be counter-clockwise
	Array<Point2> points;
	Array<std::array<double, 3>> sides; ///< [triangle] lengths on the surface; side k runs from
										///< corner k to corner k + 1

	Triangle2 at(int triangle) const
	{
		const Triangle& c = corners[triangle];
		return {points[c[0]], points[c[1]], points[c[2]]};
	}
};

/// One side of a triangle of a drawing, by the lower and the higher number of its ends.
struct DrawnSide
{
	int low, high;     ///< vertices
	int atLow, atHigh; ///< points
	int triangle;
};

/// Calls \p visit(sides, count) for every edge of the surface, with an array of its sides in order of
/// their triangles.
template<class Visit>
void forEdges(const std::vector<DrawnSide>& sides, const Visit& visit)
{
	for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
		while (end < sides.size() && sides[end].low == sides[i].low &&
			   sides[end].high == sides[i].high)
			++end;
		visit(&sides[i], static_cast<int>(end - i));
	}
}

/// The sides of all triangles, in order of their edges.
std::vector<DrawnSide> sidesByEdge(const DrawnTriangles& drawn);

/// Whether the sides of an edge are those of two triangles with the same ends in the plane.
bool isInside(const DrawnSide* sides, int count);

/// The drawing of triangles whose corners are given one by one: two corners at one vertex are one
/// point if a chain of triangles joins them whose common sides have the same ends in the plane.
/// \param vertices [triangle] corners by vertex, counter-clockwise where \p plane is right
/// \param plane [triangle][corner]
/// \param chart [triangle] triangles of different charts share no points
DrawnTriangles drawingOf(
	Array<Triangle> vertices,
	const Array<Triangle2>& plane,
	const Array<int>& chart,
	Array<std::array<double, 3>> sides);

} // namespace ricci

#endif
