// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SEAM_COST_H
#define RICCI_SEAM_COST_H

#include "../surface/triangulation.h"

#include <vector>

namespace ricci {

/// How far each vertex stands out of the surface round it, between 0 (deep in a hollow) and 1 (on a
/// ridge or tip); 1/2 on a plane. Measured by the height of the vertex along its normal over the
/// surface smoothed by one implicit step of mean curvature flow (Desbrun et al. 1999), as long as
/// features of a twentieth of the surface's size take to vanish.
/// \param lengths [edge] positive
std::vector<double> exposure(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<Point3>& positions);

/// [edge] What a seam along it costs: its length, times up to 10 by the exposure of its ends.
/// \param hiding 0: the length alone; 1: the full factor
std::vector<double> seamCost(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<Point3>& positions,
	double hiding);

} // namespace ricci

#endif
