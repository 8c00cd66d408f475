// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_MESH_FILE_H
#define RICCI_TESTS_MESH_FILE_H

#include <ricci/mesh/surface_mesh.h>

#include <string>

namespace ricci::testing {

/// Reads PLY, OFF, OBJ or STL by vcglib's importers, in double precision, polygons as triangles.
/// \throw std::runtime_error with the importer's reason
SurfaceMesh readMesh(const std::string& path);

} // namespace ricci::testing

#endif
