// SPDX-License-Identifier: GPL-3.0-or-later
#include "round_turns.h"

#include "../base/task.h"
#include "../base/text.h"
#include "../curvature/turn_search.h"
#include "../flow/quarter_turns.h"
#include "stages.h"

#include <optional>
#include <utility>

namespace ricci {

namespace {

/// Flows after the first one, and those in a row that may bring less than a share of what the turns
/// cost.
constexpr int kMaxRounds = 4, kMaxVainRounds = 2;
constexpr double kMinGain = 0.1;

/// How far a cone may move at once, as a share of the square root of the area, and the factor by which
/// that is less after a flow that has brought nothing.
constexpr double kFirstRadius = 0.3, kShorter = 0.3;

/// Turns that cost less, by the mean square of the Beltrami coefficient, need no other cones: angles
/// change by about a hundredth.
constexpr double kCheapTurns = 2.5e-5;

/// Brings the turns near to multiples of pi / 2.
void chooseCones(
	const EmbeddedSurface& surface,
	const TargetRequest& request,
	const Options& options,
	ComponentMap& map)
{
	FlowResult& best = map.flow;
	LoopTurns turns = loopTurns(best);
	TurnCost lowest = turnCost(surface, best, turns);
	int steps = best.iterations;
	double radius = kFirstRadius;
	for (int round = 0, vain = 0;
		 round < kMaxRounds && vain < kMaxVainRounds && lowest.angles > kCheapTurns;
		 ++round) {
		std::optional<FlowResult> next = flowAgain(
			surface,
			options,
			[&](const MakeStart&) {
				return targetToRoundTurns(surface, best, turns, request, radius);
			},
			steps,
			map.flowStates);
		if (!next || next->doubled)
			break;
		steps += next->iterations;
		LoopTurns nextTurns = loopTurns(*next);
		const TurnCost cost = turnCost(surface, *next, nextTurns);
		const double gain = lowest.total() - cost.total();
		vain = gain < kMinGain * lowest.angles ? vain + 1 : 0;
		if (gain > 0.0) {
			best = std::move(*next);
			turns = std::move(nextTurns);
			lowest = cost;
		}
		else
			radius *= kShorter; // the linear problem reaches no farther
	}
	best.iterations = steps;
}

} // namespace

void roundLoopTurns(
	const EmbeddedSurface& surface,
	const TargetRequest& request,
	const Options& options,
	ComponentMap& map)
{
	if (!map.flow.target.quarterTurns || options.method != Method::IntrinsicFlips ||
		map.flow.doubled)
		return;
	chooseCones(surface, request, options, map);
	advance(1.0 - kAfterFlow, "Rounding the turns");
	const TurnRounding done = roundTurns(map.flow, options);
	if (done.before > 0.0)
		logLine(
			"Turns of loops are up to " + numberText(done.before, 3) +
			" from a multiple of a quarter turn, and " + numberText(done.after, 3) +
			" once the metric has changed.");
}

} // namespace ricci
