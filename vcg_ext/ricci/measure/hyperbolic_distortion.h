// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HYPERBOLIC_DISTORTION_H
#define RICCI_HYPERBOLIC_DISTORTION_H

#include "distortion.h"

namespace ricci {

/// measureDistortion() for a map to the Poincaré disk. What is measured is the map to the flat
/// triangles with the corners of the geodesic ones on the hyperboloid, whose sides are its chords,
/// 2 sinh(d / 2) for the distance d. flippedFaces counts the geodesic triangles of the wrong
/// orientation, or without area, as far as rounding can tell.
DistortionField measureHyperbolicDistortion(
	const FlatMesh& mesh, const std::vector<Point3>& surface, Report& report);

} // namespace ricci

#endif
