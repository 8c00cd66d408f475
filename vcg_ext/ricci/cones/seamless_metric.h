// SPDX-License-Identifier: GPL-3.0-or-later
// The holonomy of a flat metric with cones: how far directions turn on a walk round a loop.
#ifndef RICCI_SEAMLESS_METRIC_H
#define RICCI_SEAMLESS_METRIC_H

#include "../flow/ricci_flow.h"
#include "../mesh/elements.h"
#include "../mesh/triangulation.h"
#include "target_curvature.h"

#include <Eigen/Core>
#include <vector>

namespace ricci {

/// A closed walk from triangle to triangle: the halfedges by which they are left, in order.
using FaceLoop = std::vector<Halfedge>;

/// Loops on which the homology of the surface is based: two for each handle, from a spanning tree of
/// the triangles and one of the vertices [Erickson Whittlesey 2005]. Each passes no triangle twice.
/// \param roundHoles also one round each boundary loop but one
std::vector<FaceLoop> homologyLoops(const Triangulation& t, bool roundHoles);

/// Flips \p e in \p t, and in \p loops, which stay what they are up to homotopy.
void flip(Triangulation& t, std::vector<FaceLoop>& loops, Edge e);

/// The holonomy of the loops (homologyLoops()) in the metric of a flow, and what changes it.
struct Holonomy
{
	Eigen::VectorXd errors; ///< [loop] less the nearest multiple of pi / 2, radians
	std::vector<VertexVector>
		byCurvature; ///< [loop][vertex] derivative by the curvature to be reached
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

/// Makes the rotations across all seams of \p flow multiples of pi / 2, if its cones were placed with
/// such curvatures: runs the flow again to cones that bring the holonomies nearer to multiples of pi / 2,
/// as long as that helps, and then rounds those of the best metric, see roundHolonomy(). Does nothing
/// to another flow, nor on the double of a surface.
/// \param flow on \p surface, with intrinsic flips, to a target that was chosen for \p request
/// \param epsilon of the flow, radians
/// \param flowTo runs it again
/// \return steps of Newton's method that roundHolonomy() took
int makeSeamless(
	const EmbeddedSurface& surface,
	const TargetRequest& request,
	double epsilon,
	const FlowTo& flowTo,
	FlowResult& flow);

} // namespace ricci

#endif
