// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PIECE_TRIANGULATION_H
#define RICCI_PIECE_TRIANGULATION_H

#include "../surface/surface_mesh.h"
#include "planar_layout.h"

#include <array>
#include <cstddef>
#include <vector>

namespace ricci {

/// Triangles of a polygon that is convex both in the plane and in space (where it is plane too), some
/// of whose corners may be straight: the triangulation whose worst triangle, in either, is best, so
/// that straight corners never make a triangle of their own. Indices into the corners, which are
/// given counter-clockwise.
std::vector<std::array<std::size_t, 3>>
triangulatePiece(const std::vector<Point2>& plane, const std::vector<Point3>& space);

} // namespace ricci

#endif
