// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CREASES_H
#define RICCI_CREASES_H

#include "sides.h"
#include "surface_mesh.h"

#include <array>
#include <vector>

namespace ricci {

/// The edges at which a surface bends.
struct Creases
{
	/// [face][k] 1 where the side from corner k is one, on one of the two sides of an edge, as in
	/// SurfaceMesh::seam.
	std::vector<std::array<char, 3>> sides;
	int edges = 0;
	/// What is left, away from creases and boundary, of the sum of |K| over all vertices inside: 0 to 1. 0
	/// for a surface that unfolds between its creases.
	double curvatureBetween = 1.0;
};

/// \param positions, triangles, sides of an oriented manifold
/// \param angle radians between the normals of the two triangles at an edge, above which it is a crease.
/// Edges of a triangle so thin that it has no normal are none.
Creases creases(
	const std::vector<Point3>& positions,
	const std::vector<Triangle>& triangles,
	const Sides& sides,
	double angle);

} // namespace ricci

#endif
