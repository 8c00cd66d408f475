// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MIN_AREA_RECTANGLE_H
#define RICCI_MIN_AREA_RECTANGLE_H

#include "points.h"

#include <vector>

namespace ricci {

/// A rectangle along the axes of a frame that is turned counter-clockwise by the angle with this
/// cosine and sine: a point (x, y) has the coordinates (cosine x + sine y, cosine y - sine x) there,
/// which are between min and max.
struct OrientedRectangle
{
	double cosine = 1.0, sine = 0.0;
	Point2 min{0.0, 0.0}, max{0.0, 0.0};

	double width() const { return max[0] - min[0]; }
	double height() const { return max[1] - min[1]; }

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
/// kSquareAccuracy of it, and among all turns to within 0.4 %.
/// Its frame is turned by at most a right angle, and its cosine and sine are a rational point of the
/// circle, so that they are the same on every machine.
OrientedRectangle minExtentRectangle(std::vector<Point2> points);

constexpr double kSquareAccuracy = 1e-4;

} // namespace ricci

#endif
