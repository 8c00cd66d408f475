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

/// A disk whose vertices lie at \p places in the plane.
inline FlatMesh flatDisk(const SurfaceMesh& mesh, std::vector<Point2> places)
{
	FlatMesh flat = flatMesh(mesh, std::vector<Triangle2>(mesh.triangles.size()));
	flat.points = flat.vertices;
	flat.place = Array<Point2>(std::move(places));
	return flat;
}

/// The vertices of a mesh as they are seen from above.
inline std::vector<Point2> fromAbove(const SurfaceMesh& mesh)
{
	std::vector<Point2> places;
	for (const Point3& p : mesh.positions)
		places.push_back({p[0], p[1]});
	return places;
}

/// A mesh over the plane as it is seen from above.
inline FlatMesh flatMesh(const SurfaceMesh& mesh)
{
	return flatDisk(mesh, fromAbove(mesh));
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
