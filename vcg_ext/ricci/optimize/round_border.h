// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_ROUND_BORDER_H
#define RICCI_ROUND_BORDER_H

#include "../layout/flat_mesh.h"
#include "patches.h"

namespace ricci {

/// Puts the border of a disk, which the flow has made round as far as it went, on a circle.
void makeRound(FlatMesh& flat);

/// Moves points of borders that are circles along these, where triangles with all corners on one, or sides of it, are not
/// valid, until they are as high as they should be: three points of a circle in their order have an area. Of all
/// ways to keep the order at such distances it is the one with the least squares of the turns.
/// \param moved [point] set to 1 where they have moved
/// \return [vertex] 1 on a circle, where moving off it is not needed
Array<char> slideOnCircles(const Validity& validity, FlatMesh& flat, Array<char>& moved);

} // namespace ricci

#endif
