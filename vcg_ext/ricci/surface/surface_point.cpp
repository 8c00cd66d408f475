// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_point.h"

#include "../base/indexed.h"

namespace ricci {

Point3 placeOnSurface(const SurfacePoint& p, const std::vector<Point3>& positions)
{
	Point3 x{0, 0, 0};
	for (std::size_t i = 0; i < 4; ++i)
		if (p.weight[i] != 0.0)
			x += p.weight[i] * positions[positionOf(p.vertex[i])];
	return x;
}

} // namespace ricci
