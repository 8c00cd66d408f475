// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_TRANSFORM_H
#define RICCI_TESTS_TRANSFORM_H

#include "random.h"

#include <ricci/mesh/surface_mesh.h>

#include <array>
#include <vector>

namespace ricci::testing {

SurfaceMesh scaled(SurfaceMesh mesh, double factor);

/// Coordinates as floats hold them.
SurfaceMesh inFloats(SurfaceMesh mesh);

/// Turned by \p angles about x, then y, then z (radians).
SurfaceMesh turned(SurfaceMesh mesh, const std::array<double, 3>& angles);

/// The same surface with other numbers: new vertex i was \p vertex[i], new face f was \p face[f],
/// whose corners are rotated as well.
struct Renumbered
{
	SurfaceMesh mesh;
	std::vector<int> vertex, face;
};

Renumbered renumbered(const SurfaceMesh& mesh, Random& random);

} // namespace ricci::testing

#endif
