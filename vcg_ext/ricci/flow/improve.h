// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_IMPROVE_H
#define RICCI_IMPROVE_H

#include "ricci_flow.h"

#include <functional>
#include <optional>
#include <utility>

namespace ricci {

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

} // namespace ricci

#endif
