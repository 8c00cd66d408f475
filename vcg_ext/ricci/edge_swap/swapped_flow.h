// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SWAPPED_FLOW_H
#define RICCI_SWAPPED_FLOW_H

#include "../curvature/target_curvature.h"
#include "../flow/ricci_flow.h"
#include "boundary_split.h"

#include <functional>
#include <string>

namespace ricci {

/// A flow with the remedy of paper 5.4 for triangles that break: inner edges are swapped, boundary
/// edges are split, after which the flow starts again.
struct SwappedFlow
{
	SplitMesh mesh;
	EmbeddedSurface surface;   ///< of the mesh, before any swap
	FlowResult flow;           ///< its iterations are those of all starts
	EdgeArray<char> forbidden; ///< 1 where an edge is not one of the component's; empty if all are
	int swaps = 0;             ///< over all starts
};

/// What the loop of starts tells its caller.
struct SwapListener
{
	std::function<Target(const EmbeddedSurface&, const InitialPacking&)> chooseTarget;
	FlowListener step;                          ///< Newton steps over all starts, residual
	std::function<void(const FlowResult&)> end; ///< after a start that reached its target
	std::function<void(int)> split;             ///< boundary edges split so far
};

/// \throw NotConverged, what chooseTarget throws
SwappedFlow
flowWithEdgeSwaps(const Component& component, const Options& options, const SwapListener& listener);

} // namespace ricci

#endif
