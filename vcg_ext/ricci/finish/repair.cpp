// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair.h"

#include "../base/parallel.h"
#include "patch_energy.h"
#include "untangle.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace ricci {

namespace {

/// Rings of the patches, one size after another.
constexpr int kRings[] = {1, 2, 3, 5, 8, 13, 21, 34};

/// Those of the largest patches that move points inside alone.
constexpr int kMaxInsideRings = 13;

/// A patch that failed is tried again once it has so many times the triangles, or for
/// RestShapes::OfSurfaceEvenly, the area: triangles round a limb that has shrunk are few and large.
constexpr double kPatchGrowth = 1.4;
constexpr double kAreaGrowth = 4.0;

/// Strain (untangle.h) above which a mended patch is evened out, and the rings of the larger patches.
constexpr double kMaxStrain = 3.0;
constexpr int kEasedRings[] = {2, 5, 13};

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

/// What a patch has to work with.
struct PatchSize
{
	double triangles = 0.0, area = 0.0;
};

PatchSize sizeOf(const FlatMesh& flat, const Patch& patch)
{
	PatchSize size{static_cast<double>(patch.triangles.size()), 0.0};
	for (const int f : patch.triangles)
		size.area += 0.5 * std::abs(doubledArea(flat.at(f)));
	return size;
}

/// Whether a patch has failed that was nearly as large, in area too if that counts; or for a free patch,
/// as large.
bool isHardlyLarger(
	const FlatMesh& flat, const Patch& patch, const Array<PatchSize>& failed, bool byArea)
{
	PatchSize largest;
	for (const int f : patch.triangles) {
		largest.triangles = std::max(largest.triangles, failed[f].triangles);
		largest.area = std::max(largest.area, failed[f].area);
	}
	const PatchSize size = sizeOf(flat, patch);
	if (patch.isFree())
		return size.triangles <= largest.triangles;
	return size.triangles < kPatchGrowth * largest.triangles &&
		   (!byArea || size.area < kAreaGrowth * largest.area);
}

/// Puts the points of a patch in their places, unless the test refuses the patch there.
bool apply(
	FlatMesh& flat, const Patch& patch, const std::vector<Point2>& places, const PatchTest& accepts)
{
	std::vector<Point2> before;
	for (std::size_t k = 0; k < places.size(); ++k) {
		before.push_back(flat.place[patch.points[k]]);
		flat.place[patch.points[k]] = places[k];
	}
	if (!accepts || accepts(flat, patch))
		return true;
	for (std::size_t k = 0; k < places.size(); ++k)
		flat.place[patch.points[k]] = before[k];
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

/// What has become of the places that were found for a patch.
enum class Outcome { Useless, Refused, TakenOver };

/// Takes over the patches that are valid, or better than before if that will do.
/// \return [patch]
std::vector<Outcome> takeOver(
	const std::vector<Patch>& patches,
	const std::vector<Untangled>& found,
	const RepairRules& rules,
	FlatMesh& flat,
	Repair& result)
{
	std::vector<Outcome> outcomes(patches.size(), Outcome::Useless);
	for (std::size_t i = 0; i < patches.size(); ++i) {
		if (found[i].points.empty() || !(found[i].valid || rules.partly))
			continue;
		if (!apply(flat, patches[i], found[i].points, rules.accepts)) {
			outcomes[i] = Outcome::Refused;
			continue;
		}
		outcomes[i] = Outcome::TakenOver;
		for (std::size_t k = 0; k < patches[i].points.size(); ++k)
			if (patches[i].variable[static_cast<int>(k)] >= 0)
				result.moved[patches[i].points[k]] = 1;
	}
	return outcomes;
}

bool isAnyTakenOver(const std::vector<Outcome>& outcomes)
{
	return std::count(outcomes.begin(), outcomes.end(), Outcome::TakenOver) > 0;
}

/// Whether a patch is a whole chart, and none of its triangles is valid: nothing that could be lost.
bool isInvalidWhole(const PatchSetting& setting, const Patch& patch)
{
	return patch.isFree() &&
		   std::none_of(patch.triangles.begin(), patch.triangles.end(), [&](int f) {
			   return setting.rules.validity.isValid(setting.flat.at(f));
		   });
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

/// A stage of a repair.
struct Stage
{
	std::function<PointGroups()> groups; ///< what may move
	RestShapes shapes;
	int maxRings;
	bool partly; ///< see RepairRules
};

/// Repairs in stages, each for what those before have left.
/// \param groups receives those of the last stage that was needed
Repair
run(const std::vector<Stage>& stages,
	RepairRules rules,
	WorkLimit& limit,
	FlatMesh& flat,
	PointGroups& groups)
{
	Repair result;
	result.bad = result.left = static_cast<int>(badTriangles(flat, rules.validity).size());
	for (const Stage& stage : stages) {
		if (result.left == 0)
			break;
		groups = stage.groups();
		rules.shapes = stage.shapes;
		rules.maxRings = stage.maxRings;
		rules.partly = stage.partly;
		result.add(repair(flat, groups, rules, limit));
	}
	return result;
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
	Array<PatchSize> failed(flat.points.size(), PatchSize{}); // [triangle] of its last patch
	std::set<std::vector<int>> tried; // triangles of patches, since the map last changed
	std::int64_t work = limit.ofStage();
	const std::int64_t before = work;
	for (const int rings : kRings) {
		if (rings > rules.maxRings)
			break;
		std::vector<Patch> patches = finder.patches(bad, rings);
		patches.erase(
			std::remove_if(
				patches.begin(),
				patches.end(),
				[&](const Patch& patch) {
					return tried.count(patch.triangles) > 0 ||
						   isHardlyLarger(
							   flat, patch, failed, rules.shapes == RestShapes::OfSurfaceEvenly) ||
						   isHopeless(setting, patch);
				}),
			patches.end());
		std::stable_sort(patches.begin(), patches.end(), [](const Patch& a, const Patch& b) {
			return a.triangles.size() < b.triangles.size();
		});
		const std::vector<Untangled> found = solveAll(setting, untangle, patches, work);
		for (std::size_t i = 0; i < patches.size(); ++i)
			if (!found[i].valid) {
				const PatchSize size = sizeOf(flat, patches[i]);
				for (const int f : patches[i].triangles)
					failed[f] = size;
			}
		for (const Patch& patch : patches)
			tried.insert(patch.triangles);
		const std::vector<Outcome> outcomes = takeOver(patches, found, rules, flat, result);
		bool isAny = isAnyTakenOver(outcomes);
		// Where a chart crosses itself now, its convex layout does not.
		std::vector<Patch> refused;
		for (std::size_t i = 0; i < patches.size(); ++i)
			if (outcomes[i] == Outcome::Refused && found[i].valid &&
				isInvalidWhole(setting, patches[i]))
				refused.push_back(patches[i]);
		const std::vector<Untangled> unfolded = solveAll(setting, unfold, refused, work);
		isAny = isAnyTakenOver(takeOver(refused, unfolded, rules, flat, result)) || isAny;
		if (!isAny)
			continue;
		tried.clear();
		bad =
			badTriangles(flat, rules.validity); // a patch mended partly may have others than before
		if (bad.empty())
			break;
	}
	limit.spend(before - work);
	result.left = static_cast<int>(bad.size());
	return result;
}

Repair repairInStages(
	FlatMesh& flat,
	SeamGeometry seams,
	const BoundaryRule& boundaryMoves,
	const RepairRules& rules,
	WorkLimit& limit)
{
	const RestShapes shapes = rules.shapes;
	const Validity& validity = rules.validity;
	const int maxRings = rules.maxRings;
	const auto inside = [&] { return insidePoints(flat); };
	const auto asAllowed = [&] { return joinedPoints(flat, seams, boundaryMoves); };
	const auto everywhere = [&] { return joinedPoints(flat, seams, [](int) { return true; }); };
	std::vector<Stage> stages{
		{inside, shapes, kMaxInsideRings, false},
		{asAllowed, shapes, maxRings, false},
		{everywhere, shapes, maxRings, false}};
	const Stage partly{everywhere, shapes, maxRings, true};
	// Half a repair stretches what is right for fewer flipped triangles. In the plane, where those that
	// are left get charts of their own, that is worth it only where it leads to a whole one.
	const bool allOrNothing = seams == SeamGeometry::Plane && shapes == RestShapes::OfSurface;
	if (!allOrNothing)
		stages.push_back(partly);
	// A limb that the map has shrunk below any height needs room from all round it. That bends the
	// map, so only what is stored as it is gets it: floats, not text.
	if (validity.asFloats && validity.step == 0.0) {
		stages.push_back({everywhere, RestShapes::OfSurfaceEvenly, maxRings, true});
		stages.push_back(partly);
	}
	PointGroups groups;
	Repair result = run(stages, rules, limit, flat, groups);
	if (result.left > 0 && allOrNothing) {
		Array<Point2> before = flat.place;
		const Repair last = run({partly}, rules, limit, flat, groups);
		if (last.left == 0)
			result.add(last);
		else
			flat.place.swap(before);
	}
	if (result.bad > 0 && shapes == RestShapes::OfSurface)
		easeStrained(flat, groups, rules, limit, result);
	return result;
}

Repair repairFreely(FlatMesh& flat, const RepairRules& rules, WorkLimit& limit)
{
	const RestShapes shapes = rules.shapes;
	const auto inside = [&] { return insidePoints(flat); };
	const auto all = [&] { return allPoints(flat); };
	PointGroups groups;
	return run(
		{{inside, shapes, kMaxInsideRings, false},
		 {all, shapes, rules.maxRings, false},
		 {all, shapes, rules.maxRings, true}},
		rules,
		limit,
		flat,
		groups);
}

} // namespace ricci
