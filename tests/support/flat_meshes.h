// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_FLAT_MESHES_H
#define RICCI_TESTS_FLAT_MESHES_H

#include "shapes.h"

#include <ricci/charts/chart_overlap.h>
#include <ricci/layout/flat_mesh.h>
#include <ricci/layout/parametrization.h>
#include <ricci/measure/distortion.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace ricci::testing {

/// A mesh whose corners lie at \p plane, one chart. Two corners are joined where sides lie on each other.
inline FlatMesh flatMesh(const SurfaceMesh& mesh, const std::vector<Triangle2>& plane)
{
	return flatMeshOf(Array<Triangle>(mesh.triangles), Array<Triangle2>(plane), mesh.positions);
}

/// A mesh over the plane: its own x and y are its place there.
inline FlatMesh flatMesh(const SurfaceMesh& mesh)
{
	std::vector<Triangle2> plane;
	for (const Triangle& t : mesh.triangles) {
		Triangle2 p;
		for (std::size_t k = 0; k < 3; ++k)
			p[k] = {mesh.positions[at(t[k])][0], mesh.positions[at(t[k])][1]};
		plane.push_back(p);
	}
	return flatMesh(mesh, plane);
}

/// The same with one of its vertices elsewhere.
inline FlatMesh flatMesh(const SurfaceMesh& mesh, int vertex, const Point2& place)
{
	FlatMesh flat = flatMesh(mesh);
	for (const int f : flat.points.indices())
		for (const Corner c : cornersOf(f))
			if (flat.vertices[c] == vertex)
				flat.place[flat.points[c]] = place;
	return flat;
}

/// With as many charts as \p mesh names.
inline Parametrization mapWith(FlatMesh mesh)
{
	Parametrization map;
	map.mesh = std::move(mesh);
	map.charts.resize(at(*std::max_element(map.mesh.chart.begin(), map.mesh.chart.end()) + 1));
	return map;
}

/// measureDistortion() of the map of face f to \p plane[f].
inline DistortionReport measured(const SurfaceMesh& mesh, const std::vector<Triangle2>& plane)
{
	std::vector<double> ofVertices;
	return measureDistortion(
		Array<Triangle>(mesh.triangles), mesh.positions, Array<Triangle2>(plane), ofVertices);
}

} // namespace ricci::testing

#endif
