// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_POINT_GROUPS_H
#define RICCI_POINT_GROUPS_H

#include "../layout/flat_mesh.h"
#include "../math/disk_isometry.h"

#include <complex>
#include <functional>

namespace ricci {

/// Which points of a drawing may move, and which of them together: the points of one group are images
/// of its first point.
struct PointGroups
{
	Array<int> group;  ///< [point]
	Array<int> first;  ///< [group] its lowest point
	Array<char> fixed; ///< [group]

	Array<char> inside; ///< [point] 1 where no border of a chart is

	/// [point] The derivative of its place by that of the first point of its group.
	Array<std::complex<double>> turn;

	/// [point] In the disk: takes the first point of the group to it. Empty in the plane, where
	/// images are displaced by their turn times the displacement of the first point.
	Array<DiskIsometry> isometry;

	/// The place of a point after the first one of its group was displaced.
	/// \param points [point] before
	Point2
	displaced(int point, const Array<Point2>& points, std::complex<double> displacement) const
	{
		const int from = first[group[point]];
		if (isometry.empty() || point == from)
			return asPoint(asComplex(points[point]) + turn[point] * displacement);
		return asPoint(isometry[point](asComplex(points[from]) + displacement));
	}
};

/// What joins the two sides of a seam.
enum class SeamGeometry {
	Plane, ///< rotations and translations
	Disk   ///< isometries of the Poincaré disk
};

/// Every point is a group; those on sides that belong to no two triangles with the same ends in the
/// plane, the borders of charts, are fixed.
PointGroups insidePoints(const FlatMesh& flat);

/// The copies of a seam vertex are a group, joined by the isometries that take one side of a seam to
/// the other, so that seams stay isometric where a group moves. Fixed are cones, where these do not
/// close round the vertex; seams whose sides differ in length; and points on sides of a single
/// triangle, unless \p boundaryMoves of their vertices.
PointGroups joinedPoints(
	const FlatMesh& flat,
	SeamGeometry geometry,
	const std::function<bool(int vertex)>& boundaryMoves);

/// Every point is a group, and none is fixed.
PointGroups allPoints(const FlatMesh& flat);

} // namespace ricci

#endif
