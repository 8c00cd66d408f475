// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_OFF_FILE_H
#define RICCI_TESTS_OFF_FILE_H

#include <ricci/surface/surface_mesh.h>

#include <string>

namespace ricci::testing {

/// Reads an OFF file of text (with colours and normals left out), polygons as fans of triangles.
/// vcglib's importer stops the program at comments within the file, and makes some concave polygons
/// into duplicate triangles.
/// \throw std::runtime_error
SurfaceMesh readOff(const std::string& path);

} // namespace ricci::testing

#endif
