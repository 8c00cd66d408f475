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

/// Where a repair raises the mean distortion by more than this factor, the map that it starts from is too
/// far from what its triangles would have: it is repaired once that is made better, if that costs less.
constexpr double kMaxRepairCost = 2.0;

/// Steps on all triangles that a stage of a repair may spend. Few maps that are not repaired by then are
/// repaired by more, and what is left can be cut off.
constexpr std::int64_t kMaxSteps = 50;

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
	const auto repair = [&] {
		const double height = kMinHeight * flat.box().extent();
		WorkLimit limit(flat.points.size(), kMaxSteps);
		const Repair result = repairInStages(
			flat,
			SeamGeometry::Plane,
			boundaryMoves,
			{RestShapes::OfSurface, {height, kWantedHeights * height}},
			limit);
		FinishCounts counts{result.movedCount(), result.left > 0 && limit.left() == 0};
		if (counts.endedEarly > 0)
			logLine(
				"The repair of flipped faces has ended at the bound on its work, with " +
				std::to_string(result.left) + " left.");
		return counts;
	};
	if (finish == Finish::Repair)
		return repair();
	Array<Point2> best = flat.place;
	FinishCounts counts = repair();
	if (counts.moved > 0) {
		flat.place.swap(best);
		const double before = meanDistortion(flat);
		flat.place.swap(best);
		if (const double after = meanDistortion(flat); after > kMaxRepairCost * before) {
			flat.place.swap(best);
			leastDistortion(flat, cones, freeBoundary);
			const FinishCounts next = repair();
			if (meanDistortion(flat) < after)
				counts = next;
			else
				flat.place.swap(best);
		}
	}
	const bool endedEarly = finish == Finish::LeastStretch
								? leastStretch(flat).endedEarly
								: leastDistortion(flat, cones, freeBoundary).endedEarly;
	if (endedEarly)
		logLine("The finish has ended at the bound on its steps: the map could still become a "
				"little better.");
	counts.endedEarly += endedEarly;
	return counts;
}

} // namespace ricci
