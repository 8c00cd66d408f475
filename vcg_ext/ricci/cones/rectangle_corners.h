// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_RECTANGLE_CORNERS_H
#define RICCI_RECTANGLE_CORNERS_H

#include "../base/points.h"
#include "../mesh/elements.h"

#include <array>
#include <vector>

namespace ricci {

/// Four vertices of the boundary \p loop for the corners of a rectangle, in the order of the loop:
/// those nearest to the corners of the rectangle of minimum area around the loop, in the plane that
/// fits the loop best, so that a patch with a four-cornered outline gets its own corners. Where these
/// are not four different vertices in order, the loop is divided into quarters of equal length.
/// \pre \p loop has at least four vertices
std::array<Vertex, 4>
rectangleCorners(const std::vector<Vertex>& loop, const VertexArray<Point3>& positions);

} // namespace ricci

#endif
