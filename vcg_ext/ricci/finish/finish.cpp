// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish.h"

#include "../base/task.h"
#include "../base/tolerances.h"
#include "least_distortion.h"
#include "repair.h"

#include <cstdint>
#include <string>

namespace ricci {

namespace {

/// Extent of the disk.
constexpr double kDiskExtent = 2.0;

/// Steps on all triangles that a stage of a repair may spend. Few maps that are not repaired by then are
/// repaired by more, and what is left can be cut off.
constexpr std::int64_t kMaxSteps = 50;

bool isInDisk(const FlatMesh& flat, const Patch& patch)
{
	for (const int p : patch.points)
		if (!(std::norm(asComplex(flat.place[p])) < 1.0))
			return false;
	return true;
}

FinishCounts repaired(
	FlatMesh& flat, SeamGeometry seams, const BoundaryRule& boundaryMoves, const RepairRules& rules)
{
	WorkLimit limit(flat.points.size(), kMaxSteps);
	const Repair repair = repairInStages(flat, seams, boundaryMoves, rules, limit);
	const bool endedEarly = repair.left > 0 && limit.left() == 0;
	if (endedEarly)
		logLine(
			"The repair of flipped faces has ended at the bound on its work, with " +
			std::to_string(repair.left) + " left.");
	return {repair.movedCount(), repair.left, endedEarly ? 1 : 0};
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
	FinishCounts counts = repaired(
		flat,
		SeamGeometry::Plane,
		boundaryMoves,
		{RestShapes::OfSurface, {height, kWantedHeights * height}});
	if (finish == Finish::Repair)
		return counts;
	const bool endedEarly = finish == Finish::LeastStretch
								? leastStretch(flat).endedEarly
								: leastDistortion(flat, cones, freeBoundary).endedEarly;
	if (endedEarly)
		logLine("The finish has ended at the bound on its steps: the map could still become a "
				"little better.");
	counts.endedEarly += endedEarly;
	return counts;
}

FinishCounts finishInDisk(FlatMesh& flat, bool freeBoundary)
{
	constexpr double height = kMinHeight * kDiskExtent;
	RepairRules rules{RestShapes::OfSurface, {height, kWantedHeights * height}, isInDisk};
	if (!flat.source.empty()) { // a refinement
		rules.shapes = RestShapes::OfDrawing;
		rules.validity = {kMinRefinedHeight * kDiskExtent, height};
	}
	return repaired(
		flat, SeamGeometry::Disk, [&](int) { return freeBoundary; }, rules);
}

} // namespace ricci
