// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_AREA_H
#define RICCI_AREA_H

#include "../surface/triangulation.h"

#include <array>
#include <vector>

namespace ricci {

/// Area of a surface of flat triangles with these side lengths [edge] (Heron's formula).
double euclideanArea(const Triangulation& t, const std::vector<double>& lengths);

/// Area of a surface of triangles of curvature -1: pi less the angles, found from the lengths
/// [edge] alone by the hyperbolic form of L'Huilier's formula, tan^2(area / 4) = tanh(s / 2)
/// tanh((s - a) / 2) tanh((s - b) / 2) tanh((s - c) / 2), so that it is independent of the angles
/// that the flow has summed.
double hyperbolicArea(const Triangulation& t, const std::vector<double>& lengths);

/// The same for one triangle with these sides (L'Huilier's formula): 0 where it breaks.
double hyperbolicArea(std::array<double, 3> sides);

} // namespace ricci

#endif
