// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_OPENED_MAP_H
#define RICCI_TESTS_OPENED_MAP_H

#include <ricci/parametrize.h>

namespace ricci::testing {

/// The charts of any triangles before they are packed, on the mesh that openMesh() makes of these, with all faces
/// in the order in which they are counter-clockwise.
struct OpenedMap
{
	SurfaceMesh mesh;
	Parametrization map;

	OpenedMap(const SurfaceMesh& mesh, const VertexInput& input, const Options& options);
};

} // namespace ricci::testing

#endif
