// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish_in_floats.h"

#include "../base/floating_point.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../finish/repair.h"
#include "chart_overlap.h"
#include "divide_disks.h"
#include "separate_charts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <vector>

namespace ricci {

namespace {

/// Charts are packed so many times in all.
constexpr int kMaxPackings = 4;

/// Steps on all triangles that a stage of the repair of disks may spend.
constexpr std::int64_t kMaxSteps = 50;

/// What the triangles of a map have to be once they are stored.
struct Wanted
{
	Validity validity;
	Validity inText; ///< also for coordinates with six decimals, in the unit square

	Wanted(const FlatMesh& mesh, bool forText)
	{
		double largest = 0.0;
		for (const Point2& p : mesh.place)
			for (const double x : p)
				largest = std::max(largest, std::abs(x));
		const double height = kMinFloatSteps * floatStep(largest);
		validity = {height, kWantedHeights * height, true};
		inText = validity;
		if (forText && largest > 0.5 && largest <= 1.0)
			inText = {height, kWantedHeights * kTextStep, true, kTextStep};
	}
};

/// Counts the triangles of a patch that cover a part of the plane together with another one.
class OverlapCount
{
public:
	/// \param apart whether each chart lies in a plane of its own
	OverlapCount(const FlatMesh& mesh, bool apart, double touching) :
			m_apart(apart), m_touching(touching), m_inside(insidePoints(mesh).inside)
	{
	}

	double operator()(const FlatMesh& flat, const Patch& patch) const
	{
		bool movesBorder = false;
		for (std::size_t i = 0; i < patch.points.size(); ++i)
			movesBorder = movesBorder || (patch.variable[static_cast<int>(i)] >= 0 &&
										  m_inside[patch.points[i]] == 0);
		if (!movesBorder) // the triangles round the patch stay where they are
			return 0.0;
		std::map<int, Box2> boxes; // of the patch, by plane
		for (const int f : patch.triangles)
			boxes[planeOf(flat, f)].add(boxOf(flat.at(f)));
		int count = 0;
		for (const auto& [plane, box] : boxes) {
			Array<Triangle2> near;
			std::vector<char> isOwn;
			for (const int f : flat.points.indices())
				if (planeOf(flat, f) == plane && box.meets(boxOf(flat.at(f)))) {
					near.push_back(flat.at(f));
					isOwn.push_back(
						std::binary_search(patch.triangles.begin(), patch.triangles.end(), f));
				}
			const Array<char> overlaps = OverlapSearch(std::move(near), m_touching).overlapping();
			for (const int i : overlaps.indices())
				count += overlaps[i] != 0 && isOwn[positionOf(i)] != 0;
		}
		return count;
	}

private:
	int planeOf(const FlatMesh& flat, int f) const { return m_apart ? flat.chart[f] : 0; }

	bool m_apart;
	double m_touching;
	Array<char> m_inside; // [point]
};

/// Makes triangles charts of their own, which are high enough.
void setApart(const std::vector<int>& triangles, const Validity& validity, Parametrization& map)
{
	cutOff(triangles, map);
	for (const int f : triangles) {
		Patch patch;
		patch.triangles = {f};
		patch.points = {map.mesh.points[f][0], map.mesh.points[f][1], map.mesh.points[f][2]};
		patch.corners.push_back({0, 1, 2});
		const RestShape shape =
			restShapes(map.mesh, patch, RestShapes::OfDrawing, validity).front();
		const Point2 first = map.mesh.place[patch.points[0]];
		map.mesh.place[patch.points[1]] = first + Point2{shape.base, 0.0};
		map.mesh.place[patch.points[2]] = first + asPoint(shape.apex);
	}
}

/// Mends triangles of charts in the unit disk.
Repair repairDisks(const DiskFinish& finish, Parametrization& map)
{
	const Validity validity = diskValidity(map.charts.size());
	const OverlapCount overlaps(map.mesh, true, validity.height / kMinFloatSteps);
	const auto cost = [&](const FlatMesh& flat, const Patch& patch) {
		for (const int p : patch.points)
			if (!(std::norm(asComplex(flat.place[p])) < 1.0))
				return std::numeric_limits<double>::infinity();
		return overlaps(flat, patch);
	};
	WorkLimit limit(map.mesh.size(), kMaxSteps);
	return repairInStages(
		map.mesh,
		SeamGeometry::Disk,
		[&](int) { return finish.freeBoundary; },
		{finish.isRefined ? RestShapes::OfDrawing : RestShapes::OfSurface, validity, cost},
		limit);
}

} // namespace

void finishInFloats(const FloatFinish& finish, Parametrization& map)
{
	for (int packings = 1;; ++packings) {
		const Wanted wanted(map.mesh, finish.forText);
		const OverlapCount overlaps(map.mesh, false, wanted.validity.height / kMinFloatSteps);
		WorkLimit limit(map.mesh.size());
		Repair result;
		// Where there is no room for text, floats have to do.
		for (const Validity& validity : {wanted.inText, wanted.validity})
			result.add(repairInStages(
				map.mesh,
				SeamGeometry::Plane,
				[](int) { return false; },
				{RestShapes::OfDrawing, validity, overlaps},
				limit));
		map.report.finishMoved += result.movedCount();
		if (result.movedCount() > 0)
			finish.measure();
		if (result.left == 0 || !finish.packAgain || packings == kMaxPackings)
			return;
		setApart(badTriangles(map.mesh, wanted.validity), wanted.inText, map);
		finish.packAgain();
		finish.measure();
	}
}

bool finishDisks(const DiskFinish& finish, Parametrization& map)
{
	Parametrization divided = map;
	Repair result = repairDisks(finish, map);
	const bool isDivided = result.left > 0 && divideDisks(divided);
	if (isDivided) {
		const Repair ofDivided = repairDisks(finish, divided);
		if (ofDivided.left < result.left) {
			logLine(
				"Floats cannot hold the disks, which reach too far out: they are divided into " +
				std::to_string(divided.charts.size()) + ", each with its own middle.");
			map = std::move(divided);
			result = ofDivided;
		}
	}
	map.report.finishMoved += result.movedCount();
	return result.movedCount() > 0 || isDivided;
}

} // namespace ricci
