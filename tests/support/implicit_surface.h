// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_IMPLICIT_SURFACE_H
#define RICCI_TESTS_IMPLICIT_SURFACE_H

#include <ricci/mesh/surface_mesh.h>

#include <array>
#include <cstdint>
#include <functional>

namespace ricci::testing {

/// The zero set of a function within a box by vcglib's marching cubes: triangles of every shape,
/// most of all slivers, as scanned and voxel data give them. Open where the box cuts it.
SurfaceMesh marchingCubes(
	const std::function<double(const Point3&)>& f,
	const Point3& low,
	const Point3& high,
	const std::array<int, 3>& cells);

/// Closed surface of genus 0 to 3: a ball, or the skin round a chain of circles. \p seed moves the
/// surface within the grid.
SurfaceMesh implicitClosed(int genus, int cellsPerUnit, std::uint64_t seed);

/// A hilly disk, cut off along the box.
SurfaceMesh implicitDisk(int cells, std::uint64_t seed);

/// A waisted tube, cut off at both ends.
SurfaceMesh implicitAnnulus(int cells, std::uint64_t seed);

} // namespace ricci::testing

#endif
