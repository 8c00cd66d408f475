// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_LEAST_STRETCH_H
#define RICCI_LEAST_STRETCH_H

#include "../layout/flat_mesh.h"

namespace ricci {

/// What leastStretch() has done.
struct LeastStretch
{
	int steps = 0;
	double before = 0.0, after = 0.0; ///< mean energy by area: 4 for an isometry
	bool endedEarly = false;          ///< by the number of steps; it may become smaller still
};

/// Moves all points of a map to the plane, so that its mean symmetric Dirichlet energy
/// |J|^2 + |J^-1|^2 by area becomes small [Smith Schaefer 2015]: the map that trades angles for areas, and
/// stretches nothing much in any direction. The two sides of a seam move freely, so that they differ
/// afterwards, and so does the boundary.
///
/// Newton's method with each triangle's Hessian made positive semidefinite [Smith de Goes Kim 2019]. Steps
/// are shortened until no triangle is flipped, by an exact test, and the energy falls enough. They end when
/// one gains less than a thousandth of what is above 4. A chart may cover itself afterwards.
/// \param flat one component; it gets the area that it has on the surface. Its triangles that are not
/// counter-clockwise do not count.
LeastStretch leastStretch(FlatMesh& flat);

} // namespace ricci

#endif
