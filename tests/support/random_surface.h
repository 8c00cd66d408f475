// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_RANDOM_SURFACE_H
#define RICCI_TESTS_RANDOM_SURFACE_H

#include "random.h"

#include <ricci/mesh/surface_mesh.h>

#include <vector>

namespace ricci::testing {

/// Random triangulation of about the unit square at z = 0: a grid of n x n cells with jittered
/// vertices (cells stay convex) and a random diagonal in each. Counter-clockwise.
SurfaceMesh randomPlanarDisk(int n, Random& random);

/// Wavy disk over a grid whose n rows and n columns have widths from 10^-decades to 1, drawn
/// uniformly on the logarithmic scale: slivers of all directions.
SurfaceMesh sliverDisk(int n, double decades, Random& random);

/// Torus of revolution whose angles and radii are jittered, with a random diagonal in each cell.
SurfaceMesh bumpyTorus(int nu, int nv, Random& random);

/// Torus whose triangles lie over each other in the plane, with corners at random in the rectangle of
/// width 1 and this \p height: cones of large negative curvature at most vertices.
SurfaceMesh foldedTorus(int nu, int nv, double height, Random& random);

/// Every vertex moved by up to \p amount in each coordinate.
SurfaceMesh shaken(SurfaceMesh mesh, double amount, Random& random);

/// Genus 0 to 3, each closed, with one boundary loop and with two; a torus and an annulus.
std::vector<SurfaceMesh> surfacesOfEveryKind(Random& random);

/// The diagonal of each pair of triangles (2 i, 2 i + 1) that form a cell of grid() swapped at
/// random.
void swapDiagonalsAtRandom(SurfaceMesh& mesh, Random& random);

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
