// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_INTRINSIC_H
#define RICCI_TESTS_INTRINSIC_H

#include <ricci/flow/curvature_map.h>
#include <ricci/mesh/component.h>
#include <ricci/mesh/opened_mesh.h>
#include <ricci/mesh/surface_mesh.h>
#include <ricci/mesh/triangulation.h>
#include <ricci/metric/circle_packing.h>
#include <ricci/metric/geometry.h>

#include <cmath>
#include <vector>

namespace ricci::testing {

Triangulation glued(const SurfaceMesh& mesh);

OpenedMesh opened(const SurfaceMesh& mesh);
std::vector<Component> componentsOf(const SurfaceMesh& mesh);

/// Triangles glued side by side. \p sides [side] number of the other side, or -1.
Triangulation
glued(int vertexCount, const std::vector<Triangle>& triangles, const std::vector<int>& sides);

/// The first edge between two vertices; none if there is none.
Edge edgeBetween(const Triangulation& t, Vertex a, Vertex b);

/// Lengths of the edges of a triangulation of the mesh.
EdgeArray<double> edgeLengths(const Triangulation& t, const SurfaceMesh& mesh);

/// The metric that a mesh has in space.
IntrinsicMesh intrinsicMesh(const SurfaceMesh& mesh);

/// A square with opposite sides glued: two triangles, three edges, one vertex.
Triangulation oneVertexTorus();

/// What the lengths of a triangulation's edges say of it, in extended precision and by formulas of
/// its own, so that nothing of the core is trusted.
struct MetricMeasure
{
	VertexArray<long double> curvature; ///< 2 pi (boundary: pi) less the angles
	long double area = 0.0L;

	MetricMeasure(const Triangulation& t, const EdgeArray<double>& lengths);
};

/// Curvature of the surface that a mesh is in space.
std::vector<double> curvatureInSpace(const SurfaceMesh& mesh);

/// Cone over a polygon with \p sides sides; a second, lower apex closes it.
SurfaceMesh fan(int sides, double height);
SurfaceMesh bipyramid(int sides, double height);

/// A mesh on its way to the flow: glued, measured, with the radii of paper 4.1.
struct Packed
{
	Triangulation triangulation;
	EdgeArray<double> lengths;
	VertexArray<double> radii;
	EdgeArray<double> delta;

	explicit Packed(const SurfaceMesh& mesh) : Packed(intrinsicMesh(mesh)) {}
	Packed(const Triangulation& t, const EdgeArray<double>& l) :
			triangulation(t), lengths(l), radii(initialRadii(t, l)),
			delta(inversiveDistancesLessOne(t, l, radii))
	{
	}

	VertexVector u() const
	{
		VertexVector u(radii.size());
		for (const Vertex v : radii.indices())
			u[v] = std::log(radii[v]);
		return u;
	}
	GeometricCurvatureMap<Euclidean> map() const
	{
		return GeometricCurvatureMap<Euclidean>(triangulation, delta);
	}

private:
	explicit Packed(const IntrinsicMesh& mesh) : Packed(mesh.triangulation, mesh.lengths) {}
};

} // namespace ricci::testing

#endif
