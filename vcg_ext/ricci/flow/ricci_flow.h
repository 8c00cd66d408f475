// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_RICCI_FLOW_H
#define RICCI_RICCI_FLOW_H

#include "../metric/delaunay_start.h"
#include "../options.h"
#include "../surface/triangulation.h"
#include "newton.h"
#include "target_curvature.h"

#include <functional>
#include <memory>
#include <vector>

namespace ricci {

/// The flow with intrinsic flips: what leads from the input's triangles to those of the result.
struct FlipHistory
{
	Triangulation input;            ///< the surface, or its double
	IntrinsicMesh start;            ///< the input's metric on the triangulation of the first step
	std::vector<double> startDelta; ///< [edge of start] inversive distance less one
	std::vector<double> startRadii; ///< [vertex] Euclidean, in the input's metric
	std::vector<int> startFlips;    ///< from the input's triangulation to the start's, in order
	std::vector<int> flowFlips;     ///< from the start's triangulation to the last, in order
	double lengthened = 0.0;        ///< added to every edge of a degenerate mesh, see mollify()
};

/// The metric of constant curvature (with cones) that the flow found on one connected surface.
struct FlowResult
{
	/// Triangulation, lengths and angles at the end; of the double of the surface if doubled.
	std::shared_ptr<const CurvatureMap> metric;
	bool doubled = false;

	Eigen::VectorXd u;         ///< [vertex of metric] Eq. 6: ln radius, or ln tanh(radius / 2)
	Eigen::VectorXd curvature; ///< [vertex of the surface] K at the end, radians
	Target target;             ///< as reached (a disk adapts its boundary)
	double area = 0.0;         ///< of the surface in the metric
	double residual = 0.0;     ///< max |target - K|
	double floor = 0.0;        ///< what rounding lets the residual reach
	int iterations = 0;
	CholeskyWork work; ///< of the linear solver, on the surface the result is from
	int edgeSwaps = 0;
	std::vector<char> swapped;     ///< [edge] 1 where it is not an edge of the input
	std::vector<int> edgesToSplit; ///< boundary edges; the flow must start anew if any
	FlipHistory history;           ///< Surgery::IntrinsicFlips only
};

/// Runs the flow from the metric \p lengths on \p t to \p target.
///
/// The start is the same in both backgrounds: the Euclidean inversive distances, which have no
/// scale, on the weighted Delaunay triangulation of the flat triangles. So the Euclidean and the
/// hyperbolic flow find metrics of one discrete conformal class. The hyperbolic start has about
/// the area that Gauss-Bonnet gives to the target, sum K - 2 pi chi, which must be positive.
///
/// With intrinsic flips the boundary's edges stay at first. If that breaks a triangle or fails, or
/// leaves edges of a prescribed boundary that are not Delaunay (which costs conformality there),
/// the flow runs on the double of the surface, which is closed, so that every admissible target is
/// reached; the solution is symmetric, and the surface is one half of it.
///
/// \param positions read by Surgery::EdgeSwap alone
/// \param boundaryLoop the one boundary loop of a circular target
/// \param report gets the number of Newton steps so far and the residual before each step
/// \throw NotConverged if the target is not reached within the options' limits
FlowResult runRicciFlow(
	Background background,
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<Point3>& positions,
	const Target& target,
	const std::vector<int>& boundaryLoop,
	const FlowOptions& options,
	const std::function<void(int, double)>& report);

/// [edge] About how long the edges of \p t are in the metric that a hyperbolic flow with intrinsic
/// flips has found on it: Eq. 4 for the circles at their ends, which is exact for edges that no flip
/// has touched. \p lengths as in runRicciFlow().
std::vector<double> hyperbolicLengths(
	const FlowResult& flow, const Triangulation& t, const std::vector<double>& lengths);

} // namespace ricci

#endif
