// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_OUTPUT_TRIANGLES_H
#define RICCI_OUTPUT_TRIANGLES_H

#include "../math/points.h"
#include "../surface/surface_mesh.h"

#include <vector>

namespace ricci {

/// The triangles of one chart as they are given back, in the input's order of corners.
struct OutputTriangles
{
	std::vector<Triangle> triangles; ///< corners by vertex, or by point of the refinement
	std::vector<Triangle2> plane;    ///< [triangle][corner] in the plane or the Poincaré disk
	std::vector<char> reversed;      ///< [triangle] 1 where clockwise is wanted
};

} // namespace ricci

#endif
