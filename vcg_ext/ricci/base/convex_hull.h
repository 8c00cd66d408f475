// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONVEX_HULL_H
#define RICCI_CONVEX_HULL_H

#include "points.h"

#include <cstddef>
#include <vector>

namespace ricci {

/// Corners of the convex hull, counter-clockwise and no three of them on a line (monotone chain
/// [Andrew 1979]).
std::vector<Point2> convexHull(std::vector<Point2> points);

/// A convex polygon round a convex \p polygon, both counter-clockwise: as long as it has more than
/// \p maxCorners, at least 4, its neighbours are prolonged past the side that adds the least area.
/// Rounding may leave a corner more, or outside by few steps of a double of its largest coordinate.
std::vector<Point2> enclosingPolygon(std::vector<Point2> polygon, std::size_t maxCorners);

/// A rectangle along the axes of a frame that is turned counter-clockwise by the angle with this
/// cosine and sine: a point (x, y) has the coordinates (cosine x + sine y, cosine y - sine x) there,
/// which are between min and max.
struct OrientedRectangle : Box2
{
	double cosine = 1.0, sine = 0.0;

	/// Coordinates of \p p in the rectangle's frame.
	Point2 inFrame(const Point2& p) const
	{
		return {cosine * p[0] + sine * p[1], cosine * p[1] - sine * p[0]};
	}
};

/// Rectangle of minimum area round \p points, at least one. One of its sides lies along an edge of
/// their convex hull [Freeman Shapira 1975], and its width is not less than its height. Takes n log n
/// steps for n points.
OrientedRectangle minAreaRectangle(std::vector<Point2> points);

/// Rectangle round \p points, at least one, whose longer side is minimal for small turns, to within
/// 1e-4 of it, and among all turns to within 0.4 %.
/// Its frame is turned by at most a right angle, and its cosine and sine are a rational point of the
/// circle, so that they are the same on every machine.
OrientedRectangle minExtentRectangle(std::vector<Point2> points);

} // namespace ricci

#endif
