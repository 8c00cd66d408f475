// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_LEAST_RECTANGLE_H
#define RICCI_LEAST_RECTANGLE_H

#include "planar_layout.h"

#include <vector>

namespace ricci {

/// A rectangle in the frame turned clockwise by the angle with this cosine and sine: a point p has
/// the coordinates (cosine x + sine y, cosine y - sine x), between low and high.
struct OrientedRectangle
{
	double cosine = 1.0, sine = 0.0;
	Point2 low{0.0, 0.0}, high{0.0, 0.0};

	/// Coordinates of \p p in the rectangle's frame.
	Point2 inFrame(const Point2& p) const
	{
		return {cosine * p[0] + sine * p[1], cosine * p[1] - sine * p[0]};
	}
};

/// Rectangle of least area round \p points (at least one); one of its sides lies along an edge of
/// their convex hull. Its longer side is the first.
OrientedRectangle leastRectangle(std::vector<Point2> points);

} // namespace ricci

#endif
