// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_MESH_FILE_H
#define RICCI_TESTS_MESH_FILE_H

#include <ricci/base/points.h>
#include <ricci/mesh/surface_mesh.h>

#include <array>
#include <string>
#include <vector>

namespace ricci::testing {

/// Reads PLY, OFF, OBJ or STL by vcglib's importers, in double precision, polygons as triangles.
/// \throw std::runtime_error with the importer's reason
SurfaceMesh readMesh(const std::string& path);

/// Writes a mesh with one texture coordinate for each corner, all with 17 significant digits, so
/// that a checker sees the algorithm's doubles and not the floats of a host.
/// \throw std::runtime_error if the file cannot be written
void writeObj(
	const std::string& path, const SurfaceMesh& mesh, const std::vector<std::array<Point2, 3>>& uv);

} // namespace ricci::testing

#endif
