// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MOEBIUS_CENTRING_H
#define RICCI_MOEBIUS_CENTRING_H

#include "../surface/surface_mesh.h"

#include <vector>

namespace ricci {

/// Moves points of the unit sphere by the Moebius transformation that brings their conformal
/// barycentre to the centre: afterwards sum w_i x_i = 0. It exists and is unique up to a rotation
/// while no point has half of the weight or more. Found by Newton's method on the convex function
/// sum w_i log (1 - x_i . c) / sqrt(1 - |c|^2) of hyperbolic space, with a line search (Springborn
/// 2005, A unique representation of polyhedral types; Baden, Crane and Kazhdan 2018).
/// \param weights [point] not negative
/// \return |sum w_i x_i| / sum w_i at the end
double centreByMoebius(std::vector<Point3>& points, const std::vector<double>& weights);

} // namespace ricci

#endif
