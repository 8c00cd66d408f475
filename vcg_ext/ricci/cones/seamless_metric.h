// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SEAMLESS_METRIC_H
#define RICCI_SEAMLESS_METRIC_H

#include "../flow/ricci_flow.h"

#include <Eigen/Core>

#include <vector>

namespace ricci {

/// The holonomy of the loops (homologyLoops()) in the metric of a flow, and what changes it.
struct Holonomy
{
	Eigen::VectorXd errors;                ///< [loop] less the nearest multiple of pi / 2, radians
	std::vector<VertexVector> byCurvature; ///< [loop] holonomyByCurvature()
	/// C: a change of the holonomies by r costs a change of the metric with the mean square r C r of
	/// the Beltrami coefficient by area in space, where it is the least.
	Eigen::MatrixXd cost;
};

/// \pre \p flow is Euclidean, not on a double
Holonomy holonomy(const FlowResult& flow);

/// Changes the metric of \p flow, with the least distortion of angles, so that the holonomies of all
/// loops (homologyLoops()) are multiples of pi / 2, as the curvatures of the cones are taken to be: all
/// seams of a layout then are rotations by quarter turns. Curvatures stay those of the target, and
/// where u is fixed on the boundary, its lengths stay.
///
/// A metric with these cones and another holonomy is never conformal to this one, so that the lengths
/// of the last triangulation have to change [Capouellez Zorin 2024]. With the derivative g of a
/// holonomy by the logarithms x of the lengths, where u follows them to the target, x = W^-1 g c is the
/// change with the least x W x that reaches it, to first order; W holds the energies of the
/// distortion that each length alone makes, for areas in space. Newton's method in c, one solve of
/// the flow for each step.
///
/// Flips on the way go into the history with those of the flow: the overlay with the new triangles is
/// that of the conformal class of the flow, and so stays continuous.
///
/// The metric stays as it is where that fails, and on the double of a surface. What has become of the
/// holonomies is logged.
/// \param epsilon of the flow, radians
/// \pre Euclidean, with intrinsic flips
/// \return steps of Newton's method
int roundHolonomy(FlowResult& flow, double epsilon);

} // namespace ricci

#endif
