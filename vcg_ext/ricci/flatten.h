// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of the paper on one component.
#ifndef RICCI_FLATTEN_H
#define RICCI_FLATTEN_H

#include "cones/target_curvature.h"
#include "flow/ricci_flow.h"
#include "layout/parametrization.h"
#include "mesh/component.h"
#include "parametrize.h"

#include <optional>

namespace ricci {

/// What the flow of a component is to do.
struct FlowPlan
{
	FlowDomain domain;
	InitialPacking start; ///< 4.1
	TargetRequest request;
	Target target; ///< 5.2, 5.3; chosen again at each start where edges are swapped (5.4)
};

/// The domain of the flow to the plane, the initial packing, and what the target is chosen from.
FlowPlan startOfPlan(const Component& component, const VertexInput& input, const Options& options);

/// Chooses the target.
/// \throw as chooseTarget()
void completePlan(const Options& options, FlowPlan& plan);

/// One component in the plane: flow (4.2), cut and layout (4.3), invariants, the finish, and the checks of the result
/// by other formulas.
/// \return one chart, in the component's numbers
/// \throw what the stages throw
Parametrization flattenToPlane(const Component& component, FlowPlan plan, const Options& options);

/// The same with the target that is chosen without an alternative, and no values at the vertices.
Parametrization flattenToPlane(const Component& component, const Options& options);

/// The same in the Poincaré disk, where neither areas nor rotations across seams are asked for, and the side
/// pairings of the cut generate a Fuchsian group.
Parametrization flattenToDisk(
	const Component& component, const VertexInput& input, const HyperbolicOptions& options);

/// A map of a component in several charts without overlap, in the component's numbers.
///
/// Where nearly all curvature of a surface lies at its creases, what is between them is its own flat metric,
/// and a flow that has to spread that curvature over the surface distorts what could lie flat. The component
/// is cut along its creases, each piece is mapped by itself with a free boundary, and the pieces are joined
/// across creases again where they fit: a crease carries no curvature, only its corners do, so that
/// joining distorts nothing. Creases are all edges above an angle.
/// \param maxBetween share of the curvature that may be left between creases
/// \param first the map at the first angle, which is compared with those at other angles then (MapCost); without it
///        that map is made
/// \return none where more is left, there are no creases, or there is no memory for it (Task::memoryLimit())
/// \throw what the stages throw
std::optional<Parametrization> unfold(
	const Component& component,
	const Options& options,
	double maxBetween,
	std::optional<Parametrization> first = std::nullopt);

/// The charts of a component, without overlap unless they are to be those of the flow: Automatic takes the flow's or,
/// where that costs less, those of the surface unfolded between its creases. Where the component has a map that is
/// right, it takes that or, where it costs less and is one chart without further seams, the flow's.
Parametrization
mapToPlane(const Component& component, const VertexInput& input, const Options& options);

/// What a map of a component costs.
MapCost costOf(const Parametrization& map);

/// Divides charts that overlap, unless the charts are to be those of the flow.
void separateCharts(const Options& options, Parametrization& map);

/// Whether a component is to be one chart with the boundary that is asked for.
inline bool isOneChart(const Options& options)
{
	return options.target == TargetCurvature::Disk || options.target == TargetCurvature::Rectangle;
}

/// Whether charts may be cut where they cover themselves. A disk or a rectangle is asked for as one piece;
/// that it is none at a few faces, which the finish could not mend, is counted.
inline bool mayCutCharts(const Options& options)
{
	return options.charts != Charts::OfTheFlow && options.charts != Charts::AsGiven &&
		   !isOneChart(options);
}

} // namespace ricci

#endif
