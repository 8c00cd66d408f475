// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_REST_SHAPE_H
#define RICCI_REST_SHAPE_H

#include "../layout/flat_mesh.h"
#include "patches.h"
#include "validity.h"

#include <complex>
#include <vector>

namespace ricci {

/// The shape that a triangle of the plane should have: corners 0, base > 0 and apex, whose
/// imaginary part is positive.
struct RestShape
{
	double base = 1.0;
	std::complex<double> apex;
};

/// Where the triangles of a patch have their shapes from.
enum class RestShapes {
	OfSurface,       ///< from their sides on the surface, scaled as the map scales them nearby
	OfSurfaceEvenly, ///< from their sides on the surface, all of the patch scaled alike
	OfDrawing        ///< as they are in the plane, if counter-clockwise; else OfSurface
};

/// The shapes of the triangles of \p patch. A triangle without a shape, or with a thin one, gets one that is
/// less thin. All are as high as \p validity wants.
std::vector<RestShape>
restShapes(const FlatMesh& flat, const Patch& patch, RestShapes from, const Validity& validity);

} // namespace ricci

#endif
