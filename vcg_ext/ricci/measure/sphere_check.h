// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SPHERE_CHECK_H
#define RICCI_SPHERE_CHECK_H

#include "../base/points.h"
#include "../mesh/surface_mesh.h"

#include <vector>

namespace ricci {

/// Errors of a map to the unit sphere, found from its triangles alone.
struct SphereCheck
{
	double radiusError = 0.0; ///< largest | |p| - 1 |; infinite where a point is not finite

	/// How many times the triangles cover the sphere: the sum of their solid angles, with sign,
	/// over 4 pi, with tan(angle / 2) = det(a, b, c) / (1 + ab + bc + ca)
	/// [van Oosterom Strackee 1983]. A whole number for a closed surface, 1 where its map is one to
	/// one.
	double degree = 0.0;

	int turned = 0; ///< triangles of negative solid angle
};

/// \param triangles corners by vertex; counter-clockwise seen from outside
/// \param sphere [vertex] its image
SphereCheck checkSphere(const std::vector<Triangle>& triangles, const std::vector<Point3>& sphere);

} // namespace ricci

#endif
