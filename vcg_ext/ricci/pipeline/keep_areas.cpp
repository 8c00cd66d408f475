// SPDX-License-Identifier: GPL-3.0-or-later
#include "keep_areas.h"

#include "../base/numbers.h"
#include "../base/task.h"
#include "../curvature/area_change.h"
#include "../flow/ricci_flow.h"
#include "flatten_steps.h"

#include <memory>
#include <optional>
#include <utility>

namespace ricci {

namespace {

/// Flows after the first one, and those in a row that may bring nothing: where areas are to be kept so
/// far, and where the map is to cost little.
constexpr int kMaxRounds = 6, kMaxVainRounds = 2, kMaxCheaper = 2, kMaxVainCheaper = 1;

} // namespace

void keepAreas(
	const EmbeddedSurface& surface,
	const TargetRequest& request,
	const Options& options,
	ComponentMap& map)
{
	FlowResult& best = map.flow;
	std::unique_ptr<const FlowResult> last; // where it is not the best
	const auto propose = [&]() -> std::optional<FlowResult> {
		const FlowResult& before = last ? *last : best;
		if (keepsAreas(surface, before))
			return std::nullopt; // without the cost of another start
		auto next = attempt("the metric before it stays", [&]() -> std::optional<FlowResult> {
			InitialPacking start = initialPacking(surface, options);
			const auto target = targetToKeepAreas(surface, start, before, request);
			if (!target)
				return std::nullopt;
			return runFlow(surface, std::move(start), *target, options, map);
		});
		return next ? std::move(*next) : std::nullopt;
	};
	const auto take = [&](FlowResult next) {
		const bool isBest = areaCost(surface, next) <= areaCost(surface, best);
		last.reset();
		if (isBest)
			best = std::move(next);
		else
			last = std::make_unique<const FlowResult>(std::move(next));
		return isBest;
	};
	const bool isForCost = best.target.expected.has_value();
	const int round = improve(
		isForCost ? kMaxCheaper : kMaxRounds,
		isForCost ? kMaxVainCheaper : kMaxVainRounds,
		propose,
		take);
	if (!isForCost && round == kMaxRounds) {
		++map.report.endedEarly;
		logLine("The search for cones that keep areas has ended at the bound on its flows.");
	}
	if (round > 0) {
		const AreaChange change = areaChange(surface, flowFactor(best));
		logLine(
			"The spread of the logarithm of the area factor is " + numberText(change.spread, 3) +
			", the mean of the factor or its inverse " + numberText(change.mean, 3) +
			", the energy " + numberText(change.energy, 3) + ".");
	}
}

} // namespace ricci
