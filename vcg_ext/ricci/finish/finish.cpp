// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish.h"

#include "../base/task.h"
#include "../base/tolerances.h"
#include "least_distortion.h"
#include "repair.h"

namespace ricci {

namespace {

/// Extent of the disk.
constexpr double kDiskExtent = 2.0;

bool isInDisk(const FlatMesh& flat, const Patch& patch)
{
	for (const int p : patch.points)
		if (!(std::norm(asComplex(flat.place[p])) < 1.0))
			return false;
	return true;
}

FinishCounts
repaired(FlatMesh& flat, const BorderMoves& moves, RestShapes shapes, const Soundness& soundness)
{
	WorkLimit limit(flat.points.size());
	const Repair repair = repairInStages(flat, moves, shapes, soundness, limit);
	return {repair.movedCount(), repair.left};
}

} // namespace

FinishCounts finishInPlane(
	FlatMesh& flat,
	const VertexArray<char>& cones,
	bool freeBoundary,
	const VertexArray<char>& onHole,
	Finish finish)
{
	checkpoint();
	const auto boundaryMoves = [&](int v) {
		return freeBoundary || (!onHole.empty() && onHole[Vertex(v)]);
	};
	const double height = kMinHeight * flat.box().extent();
	const FinishCounts counts = repaired(
		flat,
		{SeamGeometry::Plane, boundaryMoves, nullptr},
		RestShapes::OfSurface,
		{height, kWantedHeights * height, false});
	if (finish == Finish::LeastDistortion)
		leastDistortion(flat, cones, freeBoundary);
	return counts;
}

FinishCounts finishInDisk(FlatMesh& flat, bool freeBoundary)
{
	const BorderMoves moves{
		SeamGeometry::Disk, [freeBoundary](int) { return freeBoundary; }, isInDisk};
	constexpr double height = kMinHeight * kDiskExtent;
	if (!flat.source.empty())
		return repaired(
			flat, moves, RestShapes::OfDrawing, {kMinRefinedHeight * kDiskExtent, height, false});
	return repaired(flat, moves, RestShapes::OfSurface, {height, kWantedHeights * height, false});
}

} // namespace ricci
