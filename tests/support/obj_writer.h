// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_OBJ_WRITER_H
#define RICCI_TESTS_OBJ_WRITER_H

#include <ricci/layout/planar_layout.h>
#include <ricci/mesh/surface_mesh.h>

#include <array>
#include <string>
#include <vector>

namespace ricci::testing {

/// Writes a mesh with one texture coordinate for each corner, all with 17 significant digits, so
/// that a checker sees the algorithm's doubles and not the floats of a host.
/// \throw std::runtime_error if the file cannot be written
void writeObj(
	const std::string& path, const SurfaceMesh& mesh, const std::vector<std::array<Point2, 3>>& uv);

} // namespace ricci::testing

#endif
