// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_HOSTILE_MESH_H
#define RICCI_TESTS_HOSTILE_MESH_H

#include "byte_source.h"

#include <ricci/mesh/surface_mesh.h>
#include <ricci/options.h>

#include <vector>

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

/// A mesh and parameters such as no user means but some program writes: random connectivity,
/// duplicated and collapsed faces, deleted elements, coordinates that are huge, denormal or no
/// numbers, stars of thousands of faces, thousands of components.
struct HostileMesh
{
	SurfaceMesh mesh;
	std::vector<char> deletedVertex, deletedFace; ///< stay in the vectors of a VCG mesh
	std::vector<char> selected;                   ///< [vertex]
	std::vector<double> quality;                  ///< [vertex]
	Options options;
	bool hyperbolic = false; ///< which of the two flows
	HyperbolicOptions hyperbolicOptions;
	bool normalizeUV = true;
	bool doublePrecision = false; ///< which of the hosts' scalar types
	double chartMargin = 0.0;
	int cancelAt = -1;        ///< number of the progress call that cancels; -1: none
	double memoryLimit = 0.0; ///< see Task::setMemoryLimit()
	bool sphere = false;      ///< map to the sphere in place of the plane
	int seamEvery = 0;        ///< about one in so many sides of faces is a seam; 0: none
	int seamSeed = 0;
	int rings = 0; ///< of the universal cover

	explicit HostileMesh(ByteSource& bytes);

private:
	void drawRarerOptions(ByteSource& bytes);
	void drawAnyTriangles(ByteSource& bytes);
	void mend();
};

} // namespace ricci::testing

#endif
