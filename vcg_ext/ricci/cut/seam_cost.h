// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SEAM_COST_H
#define RICCI_SEAM_COST_H

#include "../base/points.h"
#include "../mesh/triangulation.h"

namespace ricci {

/// How far each vertex stands out of the surface round it, between 0 (deep in a hollow) and 1 (on a
/// ridge or tip); 1/2 on a plane.
///
/// Measured by the height of the vertex along its normal over the surface after one implicit step
/// of mean curvature flow [Desbrun et al. 1999], which is so long that features of a twentieth of
/// the surface's size vanish. With the root mean square s of all heights, the height h gives
/// (1 + tanh(h / s)) / 2, so that the scale of the surface does not matter.
/// \param lengths of the edges between \p positions, positive
/// \throw SolverFailed (SeamCost)
VertexArray<double> exposure(
	const Triangulation& t, const EdgeArray<double>& lengths, const VertexArray<Point3>& positions);

/// What a seam along each edge costs: its length, times a factor between 1 and 10 that grows
/// linearly with the mean exposure of its ends.
/// \param lengths of the edges between \p positions, positive
/// \param hiding 0: the length alone; 1: the full factor
/// \throw SolverFailed (SeamCost)
EdgeArray<double> seamCost(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const VertexArray<Point3>& positions,
	double hiding);

/// Raises the cost of seams along diagonals of polygons by a hundredth, so that of paths of about the
/// same cost the one along sides is taken.
/// \param isDiagonal see FlowDomain; may be empty
void avoidDiagonals(const EdgeArray<char>& isDiagonal, EdgeArray<double>& cost);

} // namespace ricci

#endif
