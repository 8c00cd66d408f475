// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MOEBIUS_BALANCING_H
#define RICCI_MOEBIUS_BALANCING_H

#include "../base/points.h"

#include <vector>

namespace ricci {

/// Moves points x_i of the unit sphere by the Moebius transformation that brings their conformal
/// barycentre to the centre: sum w_i x_i = 0 afterwards. It exists and is unique up to a rotation
/// while no point has half of the total weight or more [Springborn 2005],
/// [Baden Crane Kazhdan 2018]. Newton's method with a line search finds it as the minimum of the
/// convex function
/// sum w_i log((1 - x_i . c) / sqrt(1 - |c|^2)) of a point c of hyperbolic space (the unit ball).
/// \param weights [point] not negative
/// \return |sum w_i x_i| / sum w_i at the end; 0 where there is no weight, and nothing is moved
double balanceByMoebius(std::vector<Point3>& points, const std::vector<double>& weights);

} // namespace ricci

#endif
