// SPDX-License-Identifier: GPL-3.0-or-later
#include "ricci.h"

#include "base/task.h"
#include "hyperbolic.h"
#include "parametrize.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace ricci {

namespace {

SurfaceMesh
surfaceOf(const std::vector<Triangle>& triangles, const std::vector<std::array<double, 3>>& lengths)
{
	int last = -1;
	for (const Triangle& t : triangles)
		last = std::max({last, t[0], t[1], t[2]});
	// Numbers that no face has: more vertices than corners make no surface, and need no room.
	const std::size_t most = 3 * triangles.size();
	SurfaceMesh mesh;
	mesh.positions.resize(std::min(most, static_cast<std::size_t>(last) + 1));
	mesh.triangles = triangles;
	mesh.lengths = lengths;
	if (lengths.empty() && !triangles.empty())
		throw InvalidMesh("lengths", 0, triangles.size());
	return mesh;
}

TextureCoordinates inPlane(const SurfaceMesh& mesh, const Options& options, Progress* progress)
{
	std::optional<Task> task;
	if (progress)
		task.emplace(*progress);
	Parametrization map = parametrizeEuclidean(mesh, {}, options);
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

DiskCoordinates
inDisk(const SurfaceMesh& mesh, const HyperbolicOptions& options, Progress* progress)
{
	std::optional<Task> task;
	if (progress)
		task.emplace(*progress);
	Parametrization map = parametrizeHyperbolic(mesh, {}, options);
	const Report& report = map.report;
	DiskCoordinates disk;
	const Array<int> chartOf = map.mesh.chartOfPoints();
	for (const int p : map.mesh.place.indices()) {
		if (chartOf[p] < 0) {
			disk.points.emplace_back();
			continue;
		}
		const Box2& box = map.charts[positionOf(chartOf[p])].box;
		disk.points.push_back(2.0 / box.extent() * asComplex(map.mesh.place[p] - box.centre()));
	}
	disk.triangles = std::move(map.mesh.points.values());
	disk.face = std::move(map.mesh.face.values());
	disk.chart = std::move(map.mesh.chart.values());
	for (Chart& chart : map.charts)
		disk.groups.push_back(std::move(chart.group));
	disk.relationError = report.relationError.value_or(0.0);
	disk.flippedFaces = report.flippedFaces + report.flippedByRounding;
	disk.overlappingFaces = report.overlappingFaces;
	disk.unequalSeams = report.unequalSeams;
	return disk;
}

} // namespace

TextureCoordinates flatten(
	const std::vector<std::array<double, 3>>& positions,
	const std::vector<std::array<int, 3>>& triangles,
	const Options& options,
	Progress* progress)
{
	return inPlane({positions, triangles}, options, progress);
}

TextureCoordinates flattenFromLengths(
	const std::vector<std::array<int, 3>>& triangles,
	const std::vector<std::array<double, 3>>& lengths,
	const Options& options,
	Progress* progress)
{
	return inPlane(surfaceOf(triangles, lengths), options, progress);
}

DiskCoordinates uniformize(
	const std::vector<std::array<double, 3>>& positions,
	const std::vector<std::array<int, 3>>& triangles,
	const HyperbolicOptions& options,
	Progress* progress)
{
	return inDisk({positions, triangles}, options, progress);
}

DiskCoordinates uniformizeFromLengths(
	const std::vector<std::array<int, 3>>& triangles,
	const std::vector<std::array<double, 3>>& lengths,
	const HyperbolicOptions& options,
	Progress* progress)
{
	return inDisk(surfaceOf(triangles, lengths), options, progress);
}

} // namespace ricci
