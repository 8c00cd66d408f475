// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_AREA_H
#define RICCI_AREA_H

#include "../surface/triangulation.h"

#include <array>

namespace ricci {

/// Area of a flat triangle with these sides, by Heron's formula in the order of operations of [Kahan
/// 2014]; 0 where they break the triangle inequality.
double euclideanArea(const std::array<double, 3>& sides);

/// Area of a surface of flat triangles with these side lengths.
double euclideanArea(const Triangulation& t, const EdgeArray<double>& lengths);

/// Area of a surface of triangles of curvature -1 with these side lengths: the sum of
/// hyperbolicArea(sides). It does not use the angles that the flow has summed, so that it can check
/// them by Gauss-Bonnet.
double hyperbolicArea(const Triangulation& t, const EdgeArray<double>& lengths);

/// Area of one triangle of curvature -1 (pi less its angles) from its sides a, b, c and s, half
/// their sum, by the hyperbolic form of L'Huilier's formula:
///
///   tan^2(area / 4) = tanh(s / 2) tanh((s - a) / 2) tanh((s - b) / 2) tanh((s - c) / 2).
///
/// 0 where the sides break the triangle inequality.
double hyperbolicArea(std::array<double, 3> sides);

} // namespace ricci

#endif
