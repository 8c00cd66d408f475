// SPDX-License-Identifier: GPL-3.0-or-later
#include "keep_areas.h"

#include "../base/attempt.h"
#include "../base/task.h"
#include "../base/text.h"
#include "../base/tolerances.h"
#include "../curvature/area_change.h"
#include "../flow/improve.h"
#include "stages.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace ricci {

namespace {

/// Flows after the first one, and those in a row that may bring nothing.
constexpr int kMaxRounds = 6, kMaxVainRounds = 2;

AreaChange areaChange(const EmbeddedSurface& surface, const FlowResult& flow)
{
	return areaChange(surface, flowFactor(flow));
}

/// As targetToKeepAreas() measures it.
double areaExcess(const EmbeddedSurface& surface, const FlowResult& flow, double spread)
{
	return areaExcess(areaChange(surface, flow), spread, kSpreadSlack);
}

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
		return attempt([&] {
			InitialPacking start = initialPacking(surface, options);
			const Target target = targetToKeepAreas(surface, start, before, request);
			return runFlow(surface, std::move(start), target, options, map);
		});
	};
	const auto take = [&](FlowResult next) {
		const double spread = *next.target.maxSpread;
		const bool isBest = areaExcess(surface, next, spread) <= areaExcess(surface, best, spread);
		last.reset();
		if (isBest)
			best = std::move(next);
		else
			last = std::make_unique<const FlowResult>(std::move(next));
		return isBest;
	};
	const int round = improve(best, kMaxRounds, kMaxVainRounds, propose, take);
	if (round > 0) {
		const AreaChange change = areaChange(surface, best);
		logLine(
			"The spread of the logarithm of the area factor is " + numberText(change.spread, 3) +
			" now, the mean of the factor or its inverse " + numberText(change.mean, 3) + ".");
	}
}

} // namespace ricci
