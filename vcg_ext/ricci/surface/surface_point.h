// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SURFACE_POINT_H
#define RICCI_SURFACE_POINT_H

#include "../math/points.h"

#include <array>
#include <vector>

namespace ricci {

/// A point of a surface as an affine combination of its vertices. The weights of vertices that are
/// not used are 0.
struct SurfacePoint
{
	std::array<int, 4> vertex{0, 0, 0, 0};
	std::array<double, 4> weight{1, 0, 0, 0};
};

/// The point in space. \p positions [vertex].
Point3 placeOnSurface(const SurfacePoint& p, const std::vector<Point3>& positions);

} // namespace ricci

#endif
