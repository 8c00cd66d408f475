// SPDX-License-Identifier: GPL-3.0-or-later
// The remedy of paper 5.4 where the flow breaks the triangle inequality.
#ifndef RICCI_SWAPPED_FLOW_H
#define RICCI_SWAPPED_FLOW_H

#include "../mesh/component.h"
#include "../mesh/flow_domain.h"
#include "ricci_flow.h"

#include <functional>
#include <vector>

namespace ricci {

/// A flow with the remedy of paper 5.4 for triangles that break: inner edges are swapped, boundary
/// edges are split, after which the flow starts again.
struct SwappedFlow
{
	FlowDomain domain; ///< with the boundary edges split, before any swap
	/// Its iterations are those of all starts, the triangulation of its metric is swapped.
	FlowResult flow;
	int swaps = 0; ///< over all starts
	int splits = 0;
};

/// Chooses the target of one start of the flow.
using ChooseTarget = std::function<Target(const EmbeddedSurface&, InitialPacking&)>;

/// \param states those before each Newton step of all starts are appended
/// \throw NotConverged, what \p chooseTarget throws
SwappedFlow flowWithEdgeSwaps(
	const Component& component,
	const FlowOptions& options,
	const ChooseTarget& chooseTarget,
	std::vector<FlowState>& states);

} // namespace ricci

#endif
