// SPDX-License-Identifier: GPL-3.0-or-later
#include "pack.h"

#include "../base/numbers.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "chart_overlap.h"
#include "separate_charts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace ricci {

namespace {

/// A refinement of which more pieces are lost is not cut into so many charts.
constexpr std::size_t kMostLost = 1000;

/// What the triangles of a map have to be once they are stored: in the unit square also with six decimals, which
/// comes first; and as floats alone.
std::vector<Validity> wantedOf(const FlatMesh& mesh, bool keepsMesh)
{
	double largest = 0.0;
	for (const Point2& p : mesh.place)
		for (const double x : p)
			largest = std::max(largest, std::abs(x));
	const double height = kMinFloatSteps * floatStep(largest);
	const Validity inFloats{height, kWantedHeights * height, true};
	if (keepsMesh && largest > 0.5 && largest <= 1.0)
		return {{height, kWantedHeights * kTextStep, true, kTextStep}, inFloats};
	return {inFloats};
}

/// Whether a box lies in another one, both rounded to float.
bool isIn(const Box2& box, const Box2& other)
{
	for (std::size_t k = 0; k < 2; ++k)
		if (roundedToFloat(box.min[k]) < roundedToFloat(other.min[k]) ||
			roundedToFloat(box.max[k]) > roundedToFloat(other.max[k]))
			return false;
	return true;
}

/// How many triangles of a patch cover a part of the plane together with another one.
/// \param limits which no patch may leave, if there are any
CostOfPatch overlapCount(const FlatMesh& map, double touching, const std::optional<Box2>& limits)
{
	return [=, inside = insidePoints(map).inside](const FlatMesh& flat, const Patch& patch) {
		bool movesBorder = false;
		for (std::size_t i = 0; i < patch.points.size(); ++i)
			movesBorder = movesBorder || (patch.variable[static_cast<int>(i)] >= 0 &&
										  inside[patch.points[i]] == 0);
		if (!movesBorder) // the triangles round the patch stay where they are
			return 0.0;
		Box2 box;
		for (const int f : patch.triangles)
			box.add(boxAround(flat.at(f)));
		if (limits && !isIn(box, *limits))
			return kInfinity;
		Array<Triangle2> near;
		std::vector<char> isOwn;
		for (const int f : flat.points.indices())
			if (box.meets(boxAround(flat.at(f)))) {
				near.push_back(flat.at(f));
				isOwn.push_back(
					std::binary_search(patch.triangles.begin(), patch.triangles.end(), f));
			}
		const Array<char> overlaps = OverlapSearch(std::move(near), touching).overlapping();
		double count = 0.0;
		for (const int i : overlaps.indices())
			count += overlaps[i] != 0 && isOwn[positionOf(i)] != 0;
		return count;
	};
}

/// Makes triangles charts of their own, which are high enough.
void setApart(const std::vector<int>& triangles, const Validity& validity, Parametrization& map)
{
	cutOff(triangles, map);
	for (const int f : triangles) {
		const TriangleShape shape = restShape(map.mesh, f, RestShapes::OfDrawing, validity);
		const Triangle& points = map.mesh.points[f];
		const Point2 first = map.mesh.place[points[0]];
		map.mesh.place[points[1]] = first + Point2{shape.base, 0.0};
		map.mesh.place[points[2]] = first + asPoint(shape.apex);
	}
}

} // namespace

std::pair<int, bool> repairInFloats(const FloatRules& rules, Parametrization& map)
{
	Box2 limits;
	for (const Chart& chart : map.charts)
		for (const Point2& corner : {chart.box.min, chart.box.max})
			limits.add(corner);
	const std::vector<Validity> wanted = wantedOf(map.mesh, rules.keepsMesh);
	const Validity& inFloats = wanted.back();
	const CostOfPatch overlaps = overlapCount(
		map.mesh,
		inFloats.height / kMinFloatSteps,
		rules.mayGrow ? std::nullopt : std::optional<Box2>(limits));
	WorkLimit limit(map.mesh.size());
	Repair result;
	// Where there is no room for text, floats have to do.
	for (const Validity& validity : wanted)
		result.add(repairInStages(
			map.mesh,
			[](int) { return false; },
			{RestShapes::OfDrawing, validity, overlaps, rules.boundary},
			limit));
	const int moved = result.movedCount();
	if (!rules.mayGrow)
		return {moved, false};
	const bool cuts = result.left > 0 && rules.mayCut;
	const bool needsPacking = cuts || (moved > 0 && !isIn(map.mesh.box(), limits));
	if (cuts) {
		const std::vector<int> lost = badTriangles(map.mesh, inFloats);
		if (!rules.keepsMesh && lost.size() > kMostLost)
			throw NotConverged(NotConverged::PiecesLost, lost.size(), map.mesh.size());
		setApart(lost, wanted.front(), map);
	}
	return {moved, needsPacking};
}

} // namespace ricci
