// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair.h"

#include "../base/parallel.h"
#include "../numerics/iteration.h"
#include "patch_energy.h"

#include <cmath>
#include <limits>
#include <utility>

namespace ricci {

namespace {

using Complex = std::complex<double>;

/// Values of eps that are tried, and Newton steps with each of them; the steps that follow once all
/// triangles are valid, and those of ease().
constexpr int kMaxRounds = 40, kStepsPerRound = 3, kLastSteps = 10, kEasingSteps = 40;

/// The share of the energy that one of these must not leave to be followed by another.
constexpr double kMinImprovement = 0.9999;

/// Rounds without a gain after which a patch is given up; the weight of triangles that are not valid
/// after such a round grows by this factor.
constexpr int kMaxIdleRounds = 6;
constexpr double kStress = 8.0;

/// A round that leaves more than this share of the energy has gained nothing; one whose least determinant stays below
/// the other share of the one before has hardly brought it nearer to 0.
constexpr double kNoGain = 0.99, kMaxLeft = 0.9;

/// Steps of a search are halved, 29 times at most.
constexpr LineSearch kHalving{0x1p-29, 0.5, 0.5};

/// The search for a valid patch.
class Untangler
{
public:
	Untangler(const PatchProblem& p, const Patch& patch, int maxSteps) :
			m_flat(p.flat), m_groups(p.groups), m_validity(p.rules.validity), m_patch(patch),
			m_maxSteps(maxSteps), m_energy(
									  p.flat,
									  p.groups,
									  patch,
									  restShapes(p.flat, patch, p.rules.shapes, p.rules.validity)),
			m_x(Eigen::VectorXd::Zero(m_energy.size()))
	{
	}

	Untangled ease()
	{
		if (place(m_x))
			improve(kEasingSteps);
		return m_found;
	}

	Untangled run()
	{
		int idle = 0;
		bool gained = true;
		double soft = kFirstEps; // determinants above it do not need it
		double least = m_energy.minDeterminant(m_x), last = least;
		std::size_t before = m_patch.triangles.size();
		m_eps = std::max(soft, -kEpsShare * least);
		for (int round = 0; round < kMaxRounds; ++round) {
			// A positive determinant of the size of eps is as good as with eps = 0.
			if (least > soft)
				m_eps = kMinEps;
			else if (round > 0)
				m_eps = std::max(
					std::min(
						std::max(soft, -kEpsShare * least),
						gained && least > kMaxLeft * last ? m_eps : kEpsFall * m_eps),
					kMinEps);
			last = least;
			soft = std::max(kEpsFall * soft, kMinEps);
			double value = m_energy.value(m_x, m_eps);
			const double first = value;
			for (int i = 0; i < kStepsPerRound && descend(value, false); ++i)
				;
			if (place(m_x)) {
				improve(kLastSteps);
				break;
			}
			least = m_energy.minDeterminant(m_x);
			gained = value < kNoGain * first;
			const std::size_t bad = m_invalid.size();
			bool isIdle = false;
			if (least > m_eps) { // all are the right way round, but some too low
				for (const int i : m_invalid)
					m_energy.stress(i, kStress);
				isIdle = 10 * bad >= 9 * before;
			}
			else // more has been asked than can be had
				isIdle = !gained && m_eps < -kSmallEps * least;
			const bool many = 8 * bad > m_patch.triangles.size();
			idle = isIdle ? idle + 1 : 0;
			if (idle >= (many ? kMaxIdleRounds / 3 : kMaxIdleRounds))
				break;
			before = bad;
			if (m_found.steps == m_maxSteps)
				break;
		}
		return m_found;
	}

private:
	/// One Newton step that lowers the energy.
	/// \param validOnly the step must leave the patch valid
	bool descend(double& value, bool validOnly)
	{
		if (m_found.steps == m_maxSteps)
			return false;
		++m_found.steps;
		if (!m_energy.newtonStep(m_x, m_eps, m_gradient, m_step))
			return false;
		double next = value;
		const double length = kHalving.run(
			m_step.dot(m_gradient),
			value,
			[&](double trial) {
				m_trial = m_x + trial * m_step;
				return next = m_energy.value(m_trial, m_eps);
			},
			[&] { return !validOnly || place(m_trial); });
		if (length == 0.0)
			return false;
		m_x.swap(m_trial);
		value = next;
		return true;
	}

	/// Goes on from a valid patch to a better one.
	void improve(int steps)
	{
		m_eps = kMinEps;
		double value = m_energy.value(m_x, m_eps);
		for (int i = 0; i < steps; ++i) {
			const double before = value;
			if (!descend(value, true) || value > kMinImprovement * before)
				return;
		}
	}

	/// Lists the triangles that are not valid at \p x, and takes the places of the points over if there
	/// are none.
	/// \return whether all are valid
	bool place(const Eigen::VectorXd& x)
	{
		m_places.clear();
		for (std::size_t i = 0; i < m_patch.points.size(); ++i) {
			const int p = m_patch.points[i], variable = m_patch.variable[static_cast<int>(i)];
			m_places.push_back(
				variable < 0
					? m_flat.place[p]
					: m_validity.stored(m_groups.displaced(
						  p, m_flat.place, Complex(x[2 * variable], x[2 * variable + 1]))));
		}
		m_invalid.clear();
		for (const int i : m_patch.corners.indices()) {
			const Triangle& t = m_patch.corners[i];
			if (!m_validity.isValid(
					{m_places[positionOf(t[0])],
					 m_places[positionOf(t[1])],
					 m_places[positionOf(t[2])]}))
				m_invalid.push_back(i);
		}
		if (m_invalid.empty())
			m_found.points = m_places;
		return m_invalid.empty();
	}

	static constexpr double kEpsShare = 0.2, kMinEps = 1e-9, kFirstEps = 0.1, kEpsFall = 0.2,
							kSmallEps = 0.02;

	const FlatMesh& m_flat;
	const PointGroups& m_groups;
	const Validity& m_validity;
	const Patch& m_patch;
	const int m_maxSteps;
	PatchEnergy m_energy;
	Eigen::VectorXd m_x, m_trial, m_gradient, m_step;
	double m_eps = 1.0;
	std::vector<Point2> m_places; // of the last trial
	std::vector<int> m_invalid;   // triangles of the patch there
	Untangled m_found;
};

} // namespace

Untangled untangle(const PatchProblem& problem, const Patch& patch, int maxSteps)
{
	return Untangler(problem, patch, maxSteps).run();
}

Untangled ease(const PatchProblem& problem, const Patch& patch, int maxSteps)
{
	return Untangler(problem, patch, maxSteps).ease();
}

namespace {

/// Rings of the patches, one size after another.
constexpr int kRings[] = {1, 2, 3, 5, 8, 13, 21, 34};

/// A patch that failed is tried again once it has so many times the triangles.
constexpr double kPatchGrowth = 1.4;

/// strain() above which a mended patch is evened out, and the rings of the larger patches.
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

/// Whether no places of its variables make a patch valid: a triangle has a side that stays and is too
/// short; or the triangles need more than the area that the patch keeps where its border stays.
bool isHopeless(
	const FlatMesh& flat, const PointGroups& groups, const Patch& patch, const Validity& validity)
{
	double area = 0.0;
	bool borderStays = true;
	for (std::size_t i = 0; i < patch.triangles.size(); ++i) {
		const Triangle2 p = flat.at(patch.triangles[i]);
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
				borderStays && (stays || groups.inside[patch.points[positionOf(local[k])]]);
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
	const PatchProblem& problem,
	decltype(untangle)& solve,
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
			found[positionOf(i)] = solve(problem, patches[positionOf(i)], maxSteps);
		});
	for (std::size_t i = 0; i < patches.size(); ++i)
		work -= found[i].steps * workOfStep(patches[i]);
	return found;
}

/// Takes over the patches that are valid.
void takeOver(
	const std::vector<Patch>& patches,
	const std::vector<Untangled>& found,
	const RepairRules& rules,
	FlatMesh& flat,
	Repair& result)
{
	for (std::size_t i = 0; i < patches.size(); ++i) {
		if (found[i].points.empty() || !apply(flat, patches[i], found[i].points, rules.cost))
			continue;
		for (std::size_t k = 0; k < patches[i].points.size(); ++k)
			if (patches[i].variable[static_cast<int>(k)] >= 0)
				result.moved[patches[i].points[k]] = 1;
	}
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
		if (strain(restShape(flat, f, RestShapes::OfSurface, validity), flat.at(f)) > kMaxStrain)
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
	std::int64_t work = limit.ofStage();
	const std::int64_t before = work;
	for (const int rings : kEasedRings) {
		const std::vector<int> strained = strainedTriangles(flat, result.moved, rules.validity);
		if (strained.empty())
			break;
		std::vector<Patch> patches = finder.patches(strained, rings);
		const std::vector<Untangled> found = solveAll({flat, groups, rules}, ease, patches, work);
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
	if (bad.empty())
		return result;
	result.moved.assign(flat.place.size(), 0);
	PatchFinder finder(flat, groups);
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
					return isHardlyLarger(patch, failed) ||
						   isHopeless(flat, groups, patch, rules.validity);
				}),
			patches.end());
		std::stable_sort(patches.begin(), patches.end(), [](const Patch& a, const Patch& b) {
			return a.triangles.size() < b.triangles.size();
		});
		const std::vector<Untangled> found =
			solveAll({flat, groups, rules}, untangle, patches, work);
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
	result.left = static_cast<int>(badTriangles(flat, rules.validity).size());
	const bool wasValid = result.left == 0;
	PointGroups groups;
	Validity upright = rules.validity;
	upright.height *= kFlat;
	Array<char> stays(flat.vertexCount(), 0);
	if (rules.boundary == BoundaryRepair::KeptOnCircles && result.left > 0) {
		result.moved.assign(flat.place.size(), 0);
		stays = slideOnCircles(rules.validity, flat, result.moved);
	}
	for (int stage = 0; stage < 3 && result.left > 0; ++stage) {
		if (stage == 2 && rules.boundary != BoundaryRepair::Free &&
			badTriangles(flat, upright).empty())
			break;
		const auto moves = [&](int v) { return boundaryMoves(v) || (stage == 2 && !stays[v]); };
		groups = stage == 0 ? insidePoints(flat) : joinedPoints(flat, moves);
		result.add(repair(flat, groups, rules, limit));
	}
	if (!wasValid && rules.shapes == RestShapes::OfSurface)
		easeStrained(flat, groups, rules, limit, result);
	return result;
}

} // namespace ricci
