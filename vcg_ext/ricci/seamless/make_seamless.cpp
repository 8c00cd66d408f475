// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_seamless.h"

#include "../base/attempt.h"
#include "../base/task.h"
#include "seamless_cones.h"

#include <optional>
#include <utility>

namespace ricci {

namespace {

/// Flows after the first one, and those in a row that may bring less than a share of what the
/// holonomies cost.
constexpr int kMaxRounds = 4, kMaxVainRounds = 2;
constexpr double kMinGain = 0.1;

/// How far a cone may move at once, as a share of the square root of the area, and the factor by which
/// that is less after a flow that has brought nothing.
constexpr double kFirstRadius = 0.3, kShorter = 0.3;

/// Holonomies that cost less, by the mean square of the Beltrami coefficient, need no other cones:
/// angles change by about a hundredth.
constexpr double kCheap = 2.5e-5;

} // namespace

HolonomyRounding makeSeamless(
	const EmbeddedSurface& surface,
	const TargetRequest& request,
	double epsilon,
	const FlowTo& flowTo,
	FlowResult& flow)
{
	if (!flow.target.isSeamless || flow.doubled)
		return {};
	Holonomy present = holonomy(flow);
	SeamlessCost lowest = seamlessCost(surface, flow, present);
	double radius = kFirstRadius;
	const auto propose = [&]() -> std::optional<FlowResult> {
		if (lowest.angles <= kCheap)
			return std::nullopt;
		const auto target = attempt("the cones stay", [&]() -> std::optional<Target> {
			const auto cones = seamlessCones(surface, flow, present, coneRequest(request), radius);
			return cones ? std::optional(targetWithCones(surface, *cones, request)) : std::nullopt;
		});
		std::optional<FlowResult> next = target && *target ? flowTo(**target) : std::nullopt;
		return next && !next->doubled ? std::move(next) : std::nullopt;
	};
	const auto take = [&](FlowResult next) {
		Holonomy other = holonomy(next);
		const SeamlessCost cost = seamlessCost(surface, next, other);
		const double gain = lowest.total() - cost.total();
		const bool isEnough = gain >= kMinGain * lowest.angles;
		if (gain > 0.0) {
			flow = std::move(next);
			present = std::move(other);
			lowest = cost;
		}
		else
			radius *= kShorter; // the linear problem reaches no farther
		return isEnough;
	};
	improve(kMaxRounds, kMaxVainRounds, propose, take);
	advance(0.0, "Rounding the rotations");
	return roundHolonomy(flow, epsilon);
}

} // namespace ricci
