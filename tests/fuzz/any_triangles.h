// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_ANY_TRIANGLES_H
#define RICCI_TESTS_ANY_TRIANGLES_H

#include "byte_source.h"

#include <ricci/mesh/surface_mesh.h>

namespace ricci::testing {

inline int vertexCount(const SurfaceMesh& mesh)
{
	return static_cast<int>(mesh.positions.size());
}

inline int faceCount(const SurfaceMesh& mesh)
{
	return static_cast<int>(mesh.triangles.size());
}

inline Point3 randomPoint(ByteSource& bytes)
{
	const double x = bytes.real(-1, 1), y = bytes.real(-1, 1), z = bytes.real(-1, 1);
	return {x, y, z};
}

/// A mesh that is not an oriented manifold: pinched, with sheets that meet at an edge, one-sided, with
/// faces twice, with faces or components without area, or several of these.
/// \param base an ordinary mesh to begin with; some kinds do without
SurfaceMesh anyTriangles(const SurfaceMesh& base, ByteSource& bytes);

} // namespace ricci::testing

#endif
