// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TURN_OVER_H
#define RICCI_TURN_OVER_H

#include "../surface/surface_mesh.h"
#include "parametrization.h"

namespace ricci {

/// Turns over the triangles of the output that the finish has left turned round: the corner opposite
/// the longest side is reflected in that side. All sides keep their lengths, the longest its place;
/// the two others become seams, which the report counts as overlapCuts. A corner that would move no
/// farther than what counts as one place (kOnePlace) stays: finishInFloats() mends such a triangle, and
/// two sides of a seam in one place would only be in its way.
/// \param mesh that \p map is the map of
void turnOver(const SurfaceMesh& mesh, Parametrization& map);

} // namespace ricci

#endif
