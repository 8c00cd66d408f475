// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FLIPPED_TRIANGLES_H
#define RICCI_FLIPPED_TRIANGLES_H

#include "parametrization.h"

namespace ricci {

/// Reflects the triangles that the finish has left flipped: the corner opposite the longest side in that
/// side. All sides keep their lengths, the longest its place; the two others become seams, which the
/// report counts as overlapCuts. A corner that would move no farther than what counts as one place
/// (kOnePlace) stays: finishInFloats() mends such a triangle, and two sides of a seam in one place would
/// only be in its way.
void reflectFlipped(Parametrization& map);

} // namespace ricci

#endif
