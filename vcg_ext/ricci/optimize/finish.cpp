// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair.h"

#include "../base/numbers.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../flow/target.h"
#include "least_distortion.h"

#include <cmath>
#include <string>

namespace ricci {

namespace {

/// What a patch costs in the objective (MapCost) at the scale at which the whole map costs least, where the
/// triangles of it that are not valid are cut off.
CostOfPatch costWithCuts(const FlatMesh& map, const Validity& validity)
{
	double forth = 0.0, back = 0.0;
	for (const int f : map.points.indices())
		if (const auto [ahead, behind] = map.stretch(f); behind < kInfinity) {
			forth += ahead;
			back += behind;
		}
	const double scale = std::sqrt(back / forth), area = map.area();
	return [=](const FlatMesh& flat, const Patch& patch) {
		double energy = 0.0, seams = 0.0;
		for (const int f : patch.triangles) {
			const auto [ahead, behind] = flat.stretch(f);
			energy += scale * ahead + behind / scale;
			if (validity.isValid(flat.at(f)))
				continue;
			for (const Corner side : cornersOf(f))
				if (const Corner other = flat.joined(side);
					other.isValid() && validity.isValid(flat.at(other.face())))
					seams += flat.lengths[side];
		}
		return energy / area + kSeamPrice * seams / std::sqrt(area);
	};
}

} // namespace

Repair finishInPlane(
	FlatMesh& flat, bool freeBoundary, const VertexArray<char>& onHole, Finish finish, bool mayCut)
{
	checkpoint();
	const auto boundaryMoves = [&](int v) {
		return freeBoundary || (!onHole.empty() && onHole[Vertex(v)]);
	};
	const BoundaryRepair boundary = freeBoundary ? BoundaryRepair::Free
									: mayCut     ? BoundaryRepair::Kept
												 : BoundaryRepair::KeptOnCircles;
	const double height = kMinHeight * flat.box().extent();
	const Validity validity{height, kWantedHeights * height};
	const CostOfPatch cost = mayCut ? costWithCuts(flat, validity) : nullptr;
	WorkLimit limit(flat.points.size(), WorkLimit::kFew);
	Repair result = repairInStages(
		flat, boundaryMoves, {RestShapes::OfSurface, validity, cost, boundary}, limit);
	if (result.left > 0 && limit.left() == 0) {
		++result.endedEarly;
		logLine(
			"The repair of flipped faces stopped at its work limit, with " +
			std::to_string(result.left) + " left.");
	}
	if (finish == Finish::Repair)
		return result;
	bool endedEarly = false;
	if (finish == Finish::LeastStretch) {
		scaleToSurface(flat);
		endedEarly = leastStretch(flat, allPoints(flat));
	}
	else
		endedEarly = leastDistortion(flat, joinedPoints(flat, boundaryMoves), mayCut);
	if (endedEarly)
		logLine("The finish stopped at its step limit: the map could still be slightly better.");
	result.endedEarly += endedEarly;
	return result;
}

} // namespace ricci
