// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TEST_RUN_FLOW_H
#define RICCI_TEST_RUN_FLOW_H

#include <ricci/flow/ricci_flow.h>

#include <utility>
#include <vector>

namespace ricci::testing {

/// The flow with its states forgotten.
inline FlowResult runRicciFlow(
	const EmbeddedSurface& surface,
	InitialPacking start,
	const Target& target,
	const FlowOptions& options)
{
	std::vector<FlowState> states;
	return ricci::runRicciFlow(surface, std::move(start), target, options, states);
}

} // namespace ricci::testing

#endif
