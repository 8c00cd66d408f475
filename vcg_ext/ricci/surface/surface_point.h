// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SURFACE_POINT_H
#define RICCI_SURFACE_POINT_H

#include "../base/indexed.h"
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
inline Point3 placeOnSurface(const SurfacePoint& p, const std::vector<Point3>& positions)
{
	Point3 x{0, 0, 0};
	for (std::size_t i = 0; i < 4; ++i)
		if (p.weight[i] != 0.0)
			x += p.weight[i] * positions[positionOf(p.vertex[i])];
	return x;
}

} // namespace ricci

#endif
