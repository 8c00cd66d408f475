// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PIECE_TRIANGULATION_H
#define RICCI_PIECE_TRIANGULATION_H

#include "../math/points.h"
#include "../surface/surface_mesh.h"

#include <array>
#include <cstddef>
#include <vector>

namespace ricci {

/// Triangulates a polygon that is convex both in the plane and in space (where it is flat too); some
/// of its corners may be straight. The worst triangle, in the plane or in space, is as good as it can
/// be (quality: area over the square of the longest side), so that straight corners never make a
/// triangle of their own. By dynamic programming over the diagonals [Klincsek 1980], cubic in the
/// number of corners.
/// \param plane, space the corners, counter-clockwise; at least 3
/// \return triangles as indices into the corners, counter-clockwise
std::vector<std::array<std::size_t, 3>>
triangulatePiece(const std::vector<Point2>& plane, const std::vector<Point3>& space);

} // namespace ricci

#endif
