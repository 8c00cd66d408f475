// SPDX-License-Identifier: GPL-3.0-or-later
// The folder flow: from a start and a target to a metric, by Newton's method. Why it is this target is decided in
// cones.
#ifndef RICCI_RICCI_FLOW_H
#define RICCI_RICCI_FLOW_H

#include "../mesh/component.h"
#include "../metric/circle_packing.h"
#include "../options.h"
#include "newton.h"
#include "target.h"

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace ricci {

/// The initial packing (paper 4.1): with intrinsic flips on the weighted Delaunay triangulation,
/// else on the surface's own triangles.
InitialPacking initialPacking(const EmbeddedSurface& surface, const FlowOptions& options);

/// The metric of constant curvature (with cones) that the flow found on one connected surface.
struct FlowResult
{
	/// Triangulation, lengths and angles at the end; of the double of the surface if doubled.
	std::shared_ptr<const CurvatureMap> metric;
	bool doubled = false;

	VertexVector u;         ///< [vertex of metric] Eq. 6: ln radius, or ln tanh(radius / 2)
	VertexVector curvature; ///< [vertex of the surface] K at the end, radians
	Target target;          ///< as reached (a disk adapts its boundary)
	double area = 0.0;      ///< of the surface in the metric
	double residual = 0.0;  ///< max |target - K|
	double floor = 0.0;     ///< what rounding lets the residual reach
	int iterations = 0;
	int swaps = 0, splits = 0; ///< over all starts, see flowWithEdgeSwaps()
	CholeskyWork work;         ///< of the last linear solver, before the flow, too
	/// Of the linear solver: on the start's triangles where that has been factorised before, else on the last.
	EliminationOrder order;

	// What leads from the input's triangles to those of the result:
	Triangulation onDouble;  ///< of the surface, if doubled
	InitialPacking start;    ///< of the input
	std::vector<Edge> flips; ///< from the start's triangulation to the last, in order

	/// The triangulation of the surface on which the flow ran, or of its double.
	const Triangulation& input(const EmbeddedSurface& surface) const
	{
		return doubled ? onDouble : surface.triangulation;
	}

	int flipCount() const { return static_cast<int>(start.flips.size() + flips.size()); }
};

/// Runs the flow from \p start, the initial packing of \p surface, to \p target.
///
/// The start is the same in both backgrounds of \p target: the Euclidean inversive distances, which have no
/// scale, on the weighted Delaunay triangulation of the flat triangles. So the Euclidean and the
/// hyperbolic flow find metrics of one discrete conformal class. The hyperbolic start has about
/// the area that Gauss-Bonnet gives to the target, sum K - 2 pi chi, which must be positive; where u
/// is fixed on the boundary, that of freeBoundaryArea().
///
/// With intrinsic flips the boundary's edges stay at first. If that breaks a triangle or fails, or
/// leaves edges of a prescribed boundary that are not Delaunay (which costs conformality there),
/// the flow runs on the double of the surface, which is closed, so that every admissible target is
/// reached; the solution is symmetric, and the surface is one half of it.
///
/// \param states those before each Newton step are appended
/// \throw NotConverged if the target is not reached within the options' limits
FlowResult runRicciFlow(
	const EmbeddedSurface& surface,
	InitialPacking start,
	const Target& target,
	const FlowOptions& options,
	std::vector<FlowState>& states);

/// [vertex of the surface] Logarithm of the factor by which a flow with intrinsic flips has scaled
/// lengths: u at its end less u at its start.
VertexVector flowFactor(const FlowResult& flow);

/// [edge] About how long the edges of \p surface are in the metric that a hyperbolic flow with
/// intrinsic flips has found on it: Eq. 4 for the circles at their ends, which is exact for edges
/// that no flip has touched.
EdgeArray<double> hyperbolicLengths(const FlowResult& flow, const EmbeddedSurface& surface);

/// Runs the flow on the surface of another flow once more, to a new target; none if it fails.
using FlowTo = std::function<std::optional<FlowResult>(const Target&)>;

/// Asks for other metrics in place of a flow's, round after round.
/// \param propose () -> std::optional<FlowResult>: the next one; none ends the rounds
/// \param take (FlowResult) -> bool: takes the next one if it is better
/// \return rounds made. There are \p maxVain in a row at most in which \p take returns false
template<class Propose, class Take>
int improve(int maxRounds, int maxVain, Propose propose, Take take)
{
	int round = 0;
	for (int vain = 0; round < maxRounds && vain < maxVain; ++round) {
		std::optional<FlowResult> next = propose();
		if (!next)
			break;
		vain = take(std::move(*next)) ? 0 : vain + 1;
	}
	return round;
}

/// Chooses the target of one start of the flow.
using ChooseTarget = std::function<Target(const EmbeddedSurface&, InitialPacking&)>;

/// A flow with the remedy of paper 5.4 for triangles that break: inner edges are swapped, boundary
/// edges are split, after which the flow starts again.
/// \param domain receives that of the component with the boundary edges split, before any swap
/// \param states those before each Newton step of all starts are appended
/// \return its iterations are those of the last start, the triangulation of its metric is swapped
/// \throw NotConverged, what \p chooseTarget throws
FlowResult flowWithEdgeSwaps(
	const Component& component,
	const FlowOptions& options,
	const ChooseTarget& chooseTarget,
	FlowDomain& domain,
	std::vector<FlowState>& states);

} // namespace ricci

#endif
