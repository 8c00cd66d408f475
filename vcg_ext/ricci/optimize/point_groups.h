// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_POINT_GROUPS_H
#define RICCI_POINT_GROUPS_H

#include "../layout/flat_mesh.h"

#include <complex>
#include <functional>

namespace ricci {

/// Which points of a flat mesh may move, and which of them together: the points of one group are images
/// of its first point.
struct PointGroups
{
	Array<int> group;  ///< [point]
	Array<int> first;  ///< [group]
	Array<char> fixed; ///< [group]

	Array<char> inside; ///< [point] 1 where no border of a chart is

	/// [point] The derivative of its place by that of the first point of its group.
	Array<std::complex<double>> turn;

	/// The place of a point after the first one of its group was displaced.
	/// \param points [point] before
	Point2
	displaced(int point, const Array<Point2>& points, std::complex<double> displacement) const
	{
		return asPoint(asComplex(points[point]) + turn[point] * displacement);
	}
};

/// Whether the boundary may move at a vertex.
using BoundaryRule = std::function<bool(int vertex)>;

/// Every point is a group, and none is fixed.
PointGroups allPoints(const FlatMesh& flat);

/// Every point is a group; the borders of charts are fixed.
PointGroups insidePoints(const FlatMesh& flat);

/// The copies of a seam vertex are a group, joined by the isometries that take one side of a seam to
/// the other, so that seams stay isometric where a group moves. Fixed are cones, where these do not
/// close round the vertex; seams whose sides differ in length; and points of the boundary, unless
/// \p boundaryMoves there.
PointGroups joinedPoints(const FlatMesh& flat, const BoundaryRule& boundaryMoves);

} // namespace ricci

#endif
