// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_EUCLIDEAN_FLOW_H
#define RICCI_EUCLIDEAN_FLOW_H

#include "../options.h"
#include "../progress.h"
#include "../metric/delaunay_start.h"
#include "../surface/triangulation.h"
#include "newton.h"
#include "target_curvature.h"

#include <memory>
#include <string>
#include <vector>

namespace ricci {

/// The flat metric (with cones) that the flow found on one connected surface.
struct FlowResult
{
	std::shared_ptr<const CurvatureMap> metric; ///< triangulation, lengths, angles at the end
	Eigen::VectorXd                     u;
	Target                              target; ///< as reached (a disk adapts its boundary)
	double                              residual   = 0.0;
	double                              floor      = 0.0;
	int                                 iterations = 0;
	int                                 edgeSwaps  = 0;
	std::vector<char>                   swapped;      ///< [edge] 1 where it is not an edge of the input
	std::vector<int>                    edgesToSplit; ///< boundary edges; the flow must start anew if any

	// Intrinsic flips only.
	IntrinsicMesh       start;      ///< the input's metric on the triangulation of the first step
	std::vector<double> startDelta; ///< [edge] of start: inversive distance less one
	Eigen::VectorXd     startU;
	std::vector<int>    startFlips; ///< from the input's triangulation to the start's, in order
	double              lengthened = 0.0; ///< added to every edge of a degenerate mesh, see mollify()
	std::vector<int>    flowFlips;  ///< from the start's triangulation to the last, in order
};

/// Runs the flow from the metric \p lengths to \p target.
/// \p positions are read by Surgery::EdgeSwap alone. \p report gets the number of Newton steps so
/// far and the residual before each step.
/// \throw NotConverged if the target is not reached within the options' limits
FlowResult runEuclideanFlow(
	const Triangulation&                    t,
	const std::vector<double>&              lengths,
	const std::vector<Point3>&              positions,
	Target                                  target,
	const std::vector<int>&                 boundaryLoop,
	const Options&                          options,
	const std::function<void(int, double)>& report);

} // namespace ricci

#endif
