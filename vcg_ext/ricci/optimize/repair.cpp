// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair.h"

#include "../base/parallel.h"
#include "patch_energy.h"
#include "untangle.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace ricci {

namespace {

/// Rings of the patches, one size after another.
constexpr int kRings[] = {1, 2, 3, 5, 8, 13, 21, 34};

/// A patch that failed is tried again once it has so many times the triangles.
constexpr double kPatchGrowth = 1.4;

/// Strain (untangle.h) above which a mended patch is evened out, and the rings of the larger patches.
constexpr double kMaxStrain = 3.0;
constexpr int kEasedRings[] = {2, 5, 13};

/// Share of the height that triangles need, below which one is flat: rounding alone has given it a height.
constexpr double kFlat = 0x1p-10;

/// Steps that a patch is expected to take to be untangled, or evened out.
constexpr std::int64_t kExpectedSteps = 30;

/// Triangles of a patch whose Hessian takes as long to factorise as to set up.
constexpr double kFactorSize = 7000.0;

/// Work of a Newton step on a patch: its triangles, and for the factorisation, whose operations
/// grow like n^1.5 on planar meshes, as many as take the same time.
std::int64_t workOfStep(const Patch& patch)
{
	const auto n = static_cast<double>(patch.triangles.size());
	return std::llround(n * (1.0 + std::sqrt(n / kFactorSize)));
}

/// What the patches of one repair have in common.
struct PatchSetting
{
	const FlatMesh& flat;
	const PointGroups& groups;
	const RepairRules& rules;

	PatchProblem problem(const Patch& patch, int maxSteps) const
	{
		return {
			flat,
			groups,
			patch,
			restShapes(flat, patch, rules.shapes, rules.validity),
			rules.validity,
			maxSteps};
	}
};

/// Whether no places of its variables make a patch valid: a triangle has a side that stays and is too
/// short; or the triangles need more than the area that the patch keeps where its border stays.
bool isHopeless(const PatchSetting& setting, const Patch& patch)
{
	const Validity& validity = setting.rules.validity;
	double area = 0.0;
	bool borderStays = true;
	for (std::size_t i = 0; i < patch.triangles.size(); ++i) {
		const Triangle2 p = setting.flat.at(patch.triangles[i]);
		const Triangle& local = patch.corners[static_cast<int>(i)];
		area += 0.5 * doubledArea(p);
		int staying = 0;
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t next = (k + 1) % 3;
			const bool stays = patch.variable[local[k]] < 0;
			staying += stays;
			if (stays && patch.variable[local[next]] < 0 &&
				distance(validity.stored(p[k]), validity.stored(p[next])) <= validity.height)
				return true;
			borderStays =
				borderStays && (stays || setting.groups.inside[patch.points[positionOf(local[k])]]);
		}
		if (staying == 3 && !validity.isValid(p))
			return true;
	}
	// An equilateral triangle has the least area of all with its height.
	const double minArea = validity.height * validity.height / std::sqrt(3.0);
	return borderStays && area <= minArea * static_cast<double>(patch.triangles.size());
}

/// Whether a patch has failed that was nearly as large, or for a free patch, as large.
/// \param failed [triangle] triangles of its last patch that failed
bool isHardlyLarger(const Patch& patch, const Array<std::size_t>& failed)
{
	std::size_t largest = 0;
	for (const int f : patch.triangles)
		largest = std::max(largest, failed[f]);
	const std::size_t size = patch.triangles.size();
	return patch.isFree() ? size <= largest
						  : static_cast<double>(size) < kPatchGrowth * static_cast<double>(largest);
}

/// Puts the points of a patch in their places, unless it costs more there.
bool apply(FlatMesh& flat, const Patch& patch, std::vector<Point2> places, const CostOfPatch& cost)
{
	const auto exchange = [&] {
		for (std::size_t k = 0; k < places.size(); ++k)
			std::swap(flat.place[patch.points[k]], places[k]);
	};
	const double before = cost ? cost(flat, patch) : 0.0;
	exchange();
	if (!cost || cost(flat, patch) <= before)
		return true;
	exchange();
	return false;
}

/// Solves patches side by side, the first ones that are expected to need no more than \p work; the others
/// are dropped. Each may take as many steps as all of them may.
/// \param work what is left after it
/// \return [patch] what \p solve gives
std::vector<Untangled> solveAll(
	const PatchSetting& setting,
	Untangled (*solve)(const PatchProblem&),
	std::vector<Patch>& patches,
	std::int64_t& work)
{
	std::int64_t ofStep = 0, triangles = 0;
	const auto fits = [&](const Patch& patch) {
		const std::int64_t more = ofStep + workOfStep(patch);
		if (more > work / kExpectedSteps)
			return false;
		ofStep = more;
		triangles += static_cast<std::int64_t>(patch.triangles.size());
		return true;
	};
	patches.erase(std::find_if_not(patches.begin(), patches.end(), fits), patches.end());
	std::vector<Untangled> found(patches.size());
	if (patches.empty())
		return found;
	const int maxSteps =
		static_cast<int>(std::min(work / ofStep, std::int64_t(std::numeric_limits<int>::max())));
	tasksInParallel(
		static_cast<int>(patches.size()), threadsFor(kExpectedSteps * triangles), [&](int i) {
			found[positionOf(i)] = solve(setting.problem(patches[positionOf(i)], maxSteps));
		});
	for (std::size_t i = 0; i < patches.size(); ++i)
		work -= found[i].steps * workOfStep(patches[i]);
	return found;
}

/// Takes over the patches that are valid.
/// \return whether there are any
bool takeOver(
	const std::vector<Patch>& patches,
	const std::vector<Untangled>& found,
	const RepairRules& rules,
	FlatMesh& flat,
	Repair& result)
{
	bool isAny = false;
	for (std::size_t i = 0; i < patches.size(); ++i) {
		if (found[i].points.empty() || !apply(flat, patches[i], found[i].points, rules.cost))
			continue;
		isAny = true;
		for (std::size_t k = 0; k < patches[i].points.size(); ++k)
			if (patches[i].variable[static_cast<int>(k)] >= 0)
				result.moved[patches[i].points[k]] = 1;
	}
	return isAny;
}

/// Triangles at points that were moved whose shape on the surface is far from that in the map.
std::vector<int>
strainedTriangles(const FlatMesh& flat, const Array<char>& moved, const Validity& validity)
{
	std::vector<int> strained;
	for (const int f : flat.points.indices()) {
		const Triangle& c = flat.points[f];
		if (!moved[c[0]] && !moved[c[1]] && !moved[c[2]])
			continue;
		Patch alone;
		alone.triangles = {f};
		alone.points = {c[0], c[1], c[2]};
		alone.corners.push_back({0, 1, 2});
		const RestShape shape = restShapes(flat, alone, RestShapes::OfSurface, validity).front();
		if (strain(shape, flat.at(f)) > kMaxStrain)
			strained.push_back(f);
	}
	return strained;
}

/// Makes the patches that were mended at a price larger and evens them out.
void easeStrained(
	FlatMesh& flat,
	const PointGroups& groups,
	const RepairRules& rules,
	WorkLimit& limit,
	Repair& result)
{
	PatchFinder finder(flat, groups);
	const PatchSetting setting{flat, groups, rules};
	std::int64_t work = limit.ofStage();
	const std::int64_t before = work;
	for (const int rings : kEasedRings) {
		const std::vector<int> strained = strainedTriangles(flat, result.moved, rules.validity);
		if (strained.empty())
			break;
		std::vector<Patch> patches = finder.patches(strained, rings);
		const std::vector<Untangled> found = solveAll(setting, ease, patches, work);
		takeOver(patches, found, rules, flat, result);
	}
	limit.spend(before - work);
}

} // namespace

int Repair::movedCount() const
{
	return static_cast<int>(std::count(moved.begin(), moved.end(), 1));
}

void Repair::add(const Repair& next)
{
	if (moved.empty())
		moved = next.moved;
	for (const int p : next.moved.indices())
		moved[p] = moved[p] || next.moved[p];
	left = next.left;
}

std::vector<int> badTriangles(const FlatMesh& flat, const Validity& validity)
{
	std::vector<int> bad;
	for (const int f : flat.points.indices())
		if (!validity.isValid(flat.at(f)))
			bad.push_back(f);
	return bad;
}

Repair repair(FlatMesh& flat, const PointGroups& groups, const RepairRules& rules, WorkLimit& limit)
{
	Repair result;
	std::vector<int> bad = badTriangles(flat, rules.validity);
	result.bad = result.left = static_cast<int>(bad.size());
	if (bad.empty())
		return result;
	result.moved.assign(flat.place.size(), 0);
	PatchFinder finder(flat, groups);
	const PatchSetting setting{flat, groups, rules};
	Array<std::size_t> failed(flat.points.size(), 0); // [triangle] size of its last patch
	std::int64_t work = limit.ofStage();
	const std::int64_t before = work;
	for (const int rings : kRings) {
		std::vector<Patch> patches = finder.patches(bad, rings);
		patches.erase(
			std::remove_if(
				patches.begin(),
				patches.end(),
				[&](const Patch& patch) {
					return isHardlyLarger(patch, failed) || isHopeless(setting, patch);
				}),
			patches.end());
		std::stable_sort(patches.begin(), patches.end(), [](const Patch& a, const Patch& b) {
			return a.triangles.size() < b.triangles.size();
		});
		const std::vector<Untangled> found = solveAll(setting, untangle, patches, work);
		takeOver(patches, found, rules, flat, result);
		for (const Patch& patch : patches)
			for (const int f : patch.triangles)
				failed[f] = patch.triangles.size();
		bad = badTriangles(flat, rules.validity);
		if (bad.empty())
			break;
	}
	limit.spend(before - work);
	result.left = static_cast<int>(bad.size());
	return result;
}

Repair repairInStages(
	FlatMesh& flat, const BoundaryRule& boundaryMoves, const RepairRules& rules, WorkLimit& limit)
{
	Repair result;
	result.bad = result.left = static_cast<int>(badTriangles(flat, rules.validity).size());
	PointGroups groups;
	Validity upright = rules.validity;
	upright.height *= kFlat;
	for (int stage = 0; stage < 3 && result.left > 0; ++stage) {
		if (stage == 2 && rules.keepsBoundary && badTriangles(flat, upright).empty())
			break;
		const auto moves = [&](int v) { return stage == 2 || boundaryMoves(v); };
		groups = stage == 0 ? insidePoints(flat) : joinedPoints(flat, moves);
		result.add(repair(flat, groups, rules, limit));
	}
	if (result.bad > 0 && rules.shapes == RestShapes::OfSurface)
		easeStrained(flat, groups, rules, limit, result);
	return result;
}

} // namespace ricci
