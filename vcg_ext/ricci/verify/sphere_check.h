// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SPHERE_CHECK_H
#define RICCI_SPHERE_CHECK_H

#include "../surface/surface_mesh.h"

#include <vector>

namespace ricci {

/// What a map to the unit sphere is worth, seen from its triangles alone, in extended precision.
struct SphereCheck
{
	double radiusError = 0.0; ///< largest | |p| - 1 |; infinite where a point is not finite

	/// How many times the triangles cover the sphere: the sum of their solid angles, with sign, over
	/// 4 pi (van Oosterom and Strackee 1983: tan(angle / 2) = det(a, b, c) / (1 + ab + bc + ca)).
	/// A whole number for a closed surface.
	double degree = 0.0;

	int turned = 0; ///< triangles of negative solid angle
};

SphereCheck checkSphere(const std::vector<Triangle>& triangles, const std::vector<Point3>& sphere);

} // namespace ricci

#endif
