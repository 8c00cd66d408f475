// SPDX-License-Identifier: GPL-3.0-or-later
#include "ricci.h"

#include "base/task.h"
#include "parametrize.h"

#include <optional>
#include <utility>

namespace ricci {

TextureCoordinates flatten(
	const std::vector<std::array<double, 3>>& positions,
	const std::vector<std::array<int, 3>>& triangles,
	const Options& options,
	Progress* progress)
{
	std::optional<Task> task;
	if (progress)
		task.emplace(*progress);
	Parametrization map = parametrizeEuclidean({positions, triangles}, {}, options);
	const Report& report = map.report;
	return {
		std::move(map.mesh.place.values()),
		std::move(map.mesh.points.values()),
		std::move(map.mesh.face.values()),
		std::move(map.mesh.chart.values()),
		report.objective.value_or(0.0),
		report.flippedFaces + report.flippedByRounding,
		report.overlappingFaces};
}

} // namespace ricci
