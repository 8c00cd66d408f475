// SPDX-License-Identifier: GPL-3.0-or-later
#include "overlap_check.h"

#include "../base/floating_point.h"
#include "../base/task.h"
#include "../charts/chart_overlap.h"
#include "../numerics/disk_isometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace ricci {

namespace {

/// Coordinates rounded to float. \param step receives that of the largest one
Array<Point2> inFloats(Array<Point2> places, double& step)
{
	double largest = 0.0;
	for (Point2& p : places)
		for (double& x : p) {
			x = roundedToFloat(x);
			largest = std::max(largest, std::abs(x));
		}
	step = floatStep(largest);
	return places;
}

/// Edges of seams whose sides differ by more than kUnequalShare and the \p rounding of their four ends.
template<class Length, class Rounding>
int countUnequal(const FlatMesh& mesh, const Length& length, const Rounding& rounding)
{
	int count = 0;
	for (const Corner side : seams(mesh).edges) {
		const Corner other = mesh.across[side];
		const double own = length(side), across = length(other);
		const double allowed =
			rounding(side) + rounding(side.next()) + rounding(other) + rounding(other.next());
		count += std::abs(own - across) > std::max(kUnequalShare * std::max(own, across), allowed);
	}
	return count;
}

} // namespace

OverlapsInFloats overlapsInFloats(const FlatMesh& mesh)
{
	checkpoint();
	double step = 0.0;
	FlatMesh stored = mesh;
	stored.place = inFloats(std::move(stored.place), step);
	const OverlapSearch search(stored, kTouchingSteps * step);
	const Array<char> overlaps = search.overlapping();
	OverlapsInFloats count;
	std::set<int> charts;
	for (const int f : overlaps.indices())
		if (overlaps[f]) {
			++count.faces;
			charts.insert(stored.chart[f]);
		}
	count.charts = static_cast<int>(charts.size());
	return count;
}

int unequalSeams(const FlatMesh& mesh)
{
	double step = 0.0;
	const Array<Point2> stored = inFloats(mesh.place, step);
	const auto length = [&](Corner side) {
		return distance(stored[mesh.points[side]], stored[mesh.points[side.next()]]);
	};
	return countUnequal(mesh, length, [&](Corner) { return 0.25 * kTouchingSteps * step; });
}

int unequalSeamsInDisk(const Parametrization& map)
{
	double step = 0.0;
	const Array<Point2> stored = inFloats(map.mesh.place, step);
	const auto square = [&](Corner c) -> const Box2& {
		return map.charts[positionOf(map.mesh.chart[c.face()])].box;
	};
	const auto inDisk = [&](Corner c) {
		const Point2 fromCentre = stored[map.mesh.points[c]] - square(c).centre();
		return asComplex(fromCentre) / (0.5 * square(c).width());
	};
	const auto length = [&](Corner side) {
		return 2.0 * std::asinh(0.5 * chordLength(inDisk(side), inDisk(side.next())));
	};
	// The metric is 2 |dz| / (1 - |z|^2).
	const auto rounding = [&](Corner end) {
		const double moved = 0.25 * kTouchingSteps * step / (0.5 * square(end).width());
		return 2.0 * moved / std::max(1.0 - std::norm(inDisk(end)), 0.0);
	};
	return countUnequal(map.mesh, length, rounding);
}

} // namespace ricci
