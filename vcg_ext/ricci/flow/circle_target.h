// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CIRCLE_TARGET_H
#define RICCI_CIRCLE_TARGET_H

#include "newton.h"

#include <functional>
#include <vector>

namespace ricci {

/// Polygon inscribed in a circle. Side i runs from corner i to corner i + 1 (cyclic).
struct InscribedPolygon
{
	double radius = 0.0;
	std::vector<double> arcs; ///< [side] central angle in radians; they add up to 2 pi
};

/// The one polygon inscribed in a circle with these side lengths, in this order. The centre may lie
/// outside the polygon.
/// \pre each side is less than the sum of the others
InscribedPolygon inscribedPolygon(const std::vector<double>& sides);

/// Exterior angle at each corner of the inscribed polygon with these arcs, radians: half the sum of
/// the two adjacent arcs.
std::vector<double> exteriorAngles(const std::vector<double>& arcs);

/// Arcs after the Moebius transformation of the disk that brings the conformal barycentre of the
/// corners, weighted by \p weights, to the centre [Douady Earle 1986]. It exists and is unique up
/// to rotation while no weight is half of the sum or more; otherwise \p arcs is returned.
std::vector<double>
centredArcs(const std::vector<double>& arcs, const std::vector<double>& weights);

/// Present lengths of the boundary's edges.
using BoundaryLengths = std::function<std::vector<double>()>;

/// Solves for exterior angles at the boundary's vertices, in radians, up to an epsilon.
using SolveForAngles =
	std::function<NewtonResult(const std::vector<double>& angles, double epsilon)>;

/// Solves for a disk that becomes round (paper 5.2): its boundary is inscribed in a circle. The
/// exterior angles follow the boundary's lengths, solve by solve (a fixed point, with Anderson
/// mixing), and the Moebius freedom of the disk is fixed by the conformal barycentre of the
/// original boundary, which is brought to the centre. It ends once the points on the circle stand
/// still, after one more solve, to \p epsilon.
///
/// All arrays follow the vertices of the boundary loop, and its edges from each one to the next.
/// \param sides lengths of the boundary's edges before the flow
/// \param arcs where to start, or empty; afterwards those of the last solve
/// \return the result of the last solve, which is the first one that did not converge if any
/// \throw NotConverged (CircleUnsettled), and what \p solve throws
NewtonResult solveForCircle(
	const std::vector<double>& sides,
	double epsilon,
	const BoundaryLengths& presentSides,
	const SolveForAngles& solve,
	std::vector<double>& arcs);

} // namespace ricci

#endif
