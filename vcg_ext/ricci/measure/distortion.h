// SPDX-License-Identifier: GPL-3.0-or-later
// The folder measure: numbers of a finished map, and its checks by other formulas. It repairs nothing.
#ifndef RICCI_DISTORTION_H
#define RICCI_DISTORTION_H

#include "../base/points.h"
#include "../flow/target.h"
#include "../layout/flat_mesh.h"
#include "../mesh/surface_mesh.h"
#include "../report.h"

#include <array>
#include <vector>

namespace ricci {

/// Quasi-conformal distortion (dilatation) of the linear map from a triangle in space to one in the
/// plane: the quotient sigma1 / sigma2 of its singular values, at least 1 (paper 5.1).
/// \return NaN where the triangle in space has no area (its smallest height is below 1e-9 of its
/// longest side); infinity where the one in the plane has none
double quasiConformalDistortion(const std::array<Point3, 3>& surface, const Triangle2& plane);

/// Area of a triangle in space.
double triangleArea(const std::array<Point3, 3>& p);

/// Areas of the triangles of a surface.
/// \param lengths see SurfaceMesh
std::vector<double> triangleAreas(
	const std::vector<Point3>& positions,
	const std::vector<Triangle>& triangles,
	const std::vector<std::array<double, 3>>& lengths);

/// The smallest of \p values that at least a share \p share of them does not exceed (nearest rank),
/// 0 < \p share <= 1; NaN where there are none. None of them is NaN.
double percentile(std::vector<double> values, double share);

/// Measures the linear maps of triangles to the plane. Triangles without area in space are kept out of the means,
/// and so are those of infinite distortion.
/// \param surface [vertex] its place in space
/// \param plane [triangle][corner]
/// \param vertexQC receives [vertex] the mean of qc over the triangles at it, weighted by their areas in space (paper
/// 5.1); 1 where none has any
DistortionReport measureDistortion(
	const Array<Triangle>& vertices,
	const std::vector<Point3>& surface,
	const Array<Triangle2>& plane,
	std::vector<double>& vertexQC);

/// The same of a surface that is given by the lengths of its sides.
DistortionReport measureDistortion(
	const FlatMesh& mesh, const Array<Triangle2>& plane, std::vector<double>& vertexQC);

/// Orders of magnitude between the largest and the smallest of a map's scale factors.
double scalesApart(const DistortionReport& distortion);

/// Of a map to the Poincaré disk, what is measured is the map to the flat triangles with the corners of the
/// geodesic ones on the hyperboloid, whose sides are its chords, 2 sinh(d / 2) for the distance d.
/// \return [triangle] these flat triangles
Array<Triangle2> chordTriangles(const FlatMesh& mesh);

/// Geodesic triangles in the Poincaré disk of the wrong orientation, or without area, as far as rounding can tell.
int flippedInDisk(const FlatMesh& mesh);

/// Triangles with an area that no texture shows: lower than a texel of the largest one, and all together of less area
/// than a row of its texels. Where more are so low, the lowest ones. In increasing order.
std::vector<int> unseenTriangles(const FlatMesh& mesh);

/// Integrals of |J|^2 and |J^-1|^2 over a surface (FlatMesh::stretch()), and its area. unseenTriangles() are left out:
/// a few needles would else decide which map is taken.
std::array<double, 3> stretchIntegrals(const FlatMesh& mesh);

/// The energy of a map, see MapCost, by these; infinite where a triangle has no area in the plane. Orientation does
/// not count.
double stretchEnergy(const FlatMesh& mesh);

/// \param seamLength on the surface
MapCost costOf(const FlatMesh& mesh, double seamLength);

/// The number of triangles that are not counter-clockwise in the plane. Exact.
int countFlipped(const FlatMesh& mesh);

/// How many more these are with coordinates rounded to float.
int countFlippedByRounding(const FlatMesh& mesh);

} // namespace ricci

#endif
