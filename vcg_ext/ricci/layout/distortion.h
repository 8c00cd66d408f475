// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DISTORTION_H
#define RICCI_DISTORTION_H

#include "../report.h"
#include "../surface/surface_mesh.h"
#include "planar_layout.h"

#include <array>
#include <vector>

namespace ricci {

/// Quasi-conformal distortion of the linear map from a 3D triangle to a plane one: sigma1 / sigma2,
/// at least 1 (paper 5.1). A 3D triangle without area (its least height
/// is below 1e-9 of its longest side) has none: NaN. A plane one without area:
/// infinity.
double
quasiConformalDistortion(const std::array<Point3, 3>& surface, const std::array<Point2, 3>& plane);

/// Area of a triangle in space.
double triangleArea(const std::array<Point3, 3>& p);

/// Distortion of a whole map.
struct DistortionField
{
	std::vector<double> face; ///< sigma1 / sigma2; NaN where the 3D face has no area
	std::vector<double>
		vertex; ///< mean over the faces at the vertex, weighted by 3D area (paper 5.1)
};

/// Change of area by a map of triangles: their areas before and after, each relative to its total.
struct AreaDistortion
{
	double mean = 1.0;   ///< of max(s, 1/s) for the area factors s, weighted by the area before
	double spread = 0.0; ///< standard deviation of ln s, weighted by the area before
	Histogram histogram; ///< of log2 s over the triangles
};

/// \param before, after [triangle] areas, not negative. Triangles where either is 0 are left out,
/// of the totals too.
AreaDistortion areaDistortion(const std::vector<double>& before, const std::vector<double>& after);

/// Measures the map that sends corner k of face f to plane[f][k], fills the qc and area distortion
/// fields and flippedFaces of \p report. Faces without 3D area, or with infinite distortion, are kept out of
/// the means. Orientation is exact; the plane image of face f should be counter-clockwise unless
/// reversed[f].
DistortionField measureDistortion(
	const SurfaceMesh& mesh,
	const std::vector<std::array<Point2, 3>>& plane,
	const std::vector<char>& reversed,
	Report& report);

/// Sets flippedFaces, the number of triangles that are not properly oriented as given, and
/// flippedByRounding, how many more are not with coordinates rounded to float. Exact.
void countFlipped(
	const std::vector<std::array<Point2, 3>>& plane,
	const std::vector<char>& reversed,
	Report& report);

} // namespace ricci

#endif
