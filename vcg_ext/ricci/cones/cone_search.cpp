// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_model.h"

#include "../base/graphs.h"
#include "../base/numbers.h"
#include "../base/task.h"
#include "../flow/target.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace ricci {

namespace {

/// A cone this weak, in radians, is better removed and placed again than moved.
constexpr double kNegligible = 0.3;

/// Places down the gradient that are tried, and rounds in which every cone may move.
constexpr int kMaxTrials = 4, kMaxRounds = 4;

/// Cones of which one may be dropped, and trials of one cone's move.
constexpr std::size_t kMaxDropTrials = 3, kMaxAttempts = 3;

/// Of several cones that are added at once, each gains at least about this share of the best.
constexpr double kMinPeak = 0.5;

/// A move must lower the energy by this share.
constexpr double kMinGain = 0.005;

/// A cone weaker than this, in radians, is not worth its seam.
constexpr double kMinCurvature = 0.02;

/// How far a cone moves at once: not far beyond the next ones, where there are many.
constexpr double kMaxStep = 0.25, kMaxStepOfMany = 2.0; // this over the root of their number

/// A move must lower energy and price of seams together by this.
constexpr double kMinObjectiveGain = 0.1 * kConePrice;

/// The free vertex with the lowest \p value(v), the first of equals; invalid if there is none. \p
/// freed counts as free though it is a cone.
template<class Value>
Vertex lowest(const ConeModel& model, const ConeSites& sites, const Value& value, Vertex freed = {})
{
	Vertex found;
	double min = kInfinity;
	for (const Vertex v : model.area().indices()) {
		if (!sites.isAllowed(v) || (model.isCone(v) && v != freed))
			continue;
		const double there = value(v);
		if (there < min) {
			min = there;
			found = v;
		}
	}
	return found;
}

/// The value of the gradient \p phi at which a cone gains nothing. Where the sum of the curvatures is
/// fixed, only differences of the gradient count: it is the value at the cones that are there.
double level(const ConeModel& model, const VertexVector& phi, Vertex freed)
{
	if (!model.hasFixedSum())
		return 0.0;
	double sum = 0.0;
	int count = 0;
	for (int i = 0; i < model.size(); ++i)
		if (model.curvature(i) < model.maxCurvature(model.vertex(i)) - 1e-9 &&
			model.vertex(i) != freed) {
			sum += phi[model.vertex(i)];
			++count;
		}
	return count > 0 ? sum / count : model.area().dot(phi);
}

/// The vertices where one more cone gains most of all places around, those first where it gains most of
/// all: where the gradient is farthest from its level. At least one if a vertex is left, \p count at most.
/// \param phi the gradient
/// \param freed is not a cone there
std::vector<Vertex> maxGains(
	const ConeModel& model,
	const ConeSites& sites,
	const VertexVector& phi,
	int count,
	Vertex freed = {})
{
	const double base = level(model, phi, freed);
	const auto isFree = [&](Vertex v) {
		return sites.isAllowed(v) && (!model.isCone(v) || v == freed);
	};
	// The first of equals counts as higher.
	const auto isHigher = [&](Vertex a, Vertex b) {
		const double x = std::abs(phi[a] - base), y = std::abs(phi[b] - base);
		return x != y ? x > y : a < b;
	};
	std::vector<Vertex> peaks;
	for (const Vertex v : phi.indices()) {
		const auto isAbove = [&](const ConeSites::Way& way) {
			return way.first == v || !isFree(way.first) || isHigher(v, way.first);
		};
		if (isFree(v) && std::all_of(sites.ways(v).begin(), sites.ways(v).end(), isAbove))
			peaks.push_back(v);
	}
	std::sort(peaks.begin(), peaks.end(), isHigher);
	while (static_cast<int>(peaks.size()) > count ||
		   (peaks.size() > 1 &&
			std::abs(phi[peaks.back()] - base) < kMinPeak * std::abs(phi[peaks.front()] - base)))
		peaks.pop_back();
	return peaks;
}

/// Moves cone \p i to the first of \p places where that lowers the energy \p present enough.
bool move(ConeModel& model, int i, const std::vector<Vertex>& places, double& present)
{
	const double most = (1.0 - kMinGain) * present;
	if (!model.tryMove(i, places, [&](Vertex, double energy) { return energy < most; }))
		return false;
	present = model.energy();
	return true;
}

/// Moves cone \p i to where it gains most, or else down the gradient.
bool relocate(ConeModel& model, const ConeSites& sites, int i, double& present)
{
	const double own = model.curvature(i);
	const Vertex old = model.vertex(i);
	// Half the energy changes by about own (phi[new] - phi[old]). For a place far away, phi is the
	// field of the others, because the cone's own field is about the same around every place; for a
	// place beside the old one, it is the whole field.
	const double enough = 0.5 * kMinGain * present;
	const VertexVector &whole = model.gradient(), &field = model.field(i);
	const auto others = [&](Vertex v) { return own * (whole[v] - own * field[v]); };
	const Vertex far = lowest(model, sites, others, old);
	std::vector<Vertex> places;
	if (far.isValid() && others(old) - others(far) > enough)
		places.push_back(far);
	// Down the whole field, as far as it falls and then less far: it changes with the cone.
	std::vector<Vertex> path{old};
	for (;;) {
		Vertex near = path.back();
		for (const auto& [to, length] : sites.ways(path.back()))
			if (!model.isCone(to) && sites.isAllowed(to) && own * whole[to] < own * whole[near])
				near = to;
		if (near == path.back())
			break;
		path.push_back(near);
	}
	std::size_t n = path.size() - 1;
	for (int trial = 0; trial < kMaxTrials && n > 0; ++trial, n /= 2)
		if (path[n] != far && own * (whole[old] - whole[path[n]]) > enough)
			places.push_back(path[n]);
	return move(model, i, places, present);
}

/// Takes the weak cone \p i out and puts it where one more cone gains most.
bool replant(ConeModel& model, const ConeSites& sites, int i, double& present)
{
	if (model.size() <= model.minSize())
		return false;
	const Vertex old = model.vertex(i);
	const std::vector<Vertex> best = maxGains(model, sites, model.gradientWithout(i), 1, old);
	return !best.empty() && best.front() != old && move(model, i, best, present);
}

/// The sites around \p site where a cone may lie, nearest first, with the lengths of the shortest ways there.
/// \param far how far they go
/// \param front scratch
std::vector<ConeSites::Way>
sitesAround(const ConeSites& sites, Vertex site, double far, SearchFront<Vertex, Vertex>& front)
{
	std::vector<ConeSites::Way> around;
	front.clear();
	front.offer(site, 0.0);
	for (Vertex v = front.next(far); v.isValid(); v = front.next(far)) {
		if (sites.isAllowed(v))
			around.emplace_back(v, front[v]);
		for (const auto& [to, length] : sites.ways(v))
			front.offer(to, front[v] + length, v);
	}
	return around;
}

/// Takes out the cone without which energy and prices fall most by ConeModel::needs(), of those without which they do
/// fall.
/// \param tree of the cones
/// \param needed cones that are not tried; takes those that were tried and have stayed: mostly they are needed more as
/// others go
/// \return false if no cone is out
bool dropDearest(ConeModel& model, SeamTree& tree, std::set<Vertex>& needed)
{
	const double present = model.energy();
	const Eigen::VectorXd needs = model.needs();
	const auto price = [&](int i) {
		return kConePrice + kSeamPrice * tree.ownLength(model.vertex(i));
	};
	std::vector<std::pair<double, int>> most; // of what they fall by, and without which cone
	for (int i = 0; i < model.size(); ++i)
		if (const double fall = price(i) - model.priceOf(needs[i]);
			fall > 0.0 && needed.count(model.vertex(i)) == 0)
			most.emplace_back(-fall, i);
	std::sort(most.begin(), most.end());
	return std::any_of(most.begin(), most.end(), [&](const std::pair<double, int>& next) {
		const Vertex cone = model.vertex(next.second);
		const double saved = price(next.second);
		const bool isOut = model.tryWithout(
			next.second, [&] { return model.priceOf(model.energy() - present) < saved; });
		if (isOut)
			tree.remove(cone);
		else
			needed.insert(cone);
		return isOut;
	});
}

/// Moves cone \p i to a place around where energy and price of seams are lower.
/// \param tree without the cone, \p own shorter than with it
/// \param around sitesAround() the cone
/// \return whether it has moved
bool moveNearby(
	ConeModel& model,
	const SeamTree& tree,
	const std::vector<ConeSites::Way>& around,
	int i,
	double own,
	double maxEnergy)
{
	const double present = model.energy(), curvature = model.curvature(i);
	const Vertex old = model.vertex(i);
	const VertexVector& phi = model.gradient();
	std::vector<std::pair<double, Vertex>> places; // change that is predicted
	for (const auto& [v, r] : around) {
		if (model.isCone(v))
			continue;
		// The factor of curvature that goes the distance r is that of a dipole, with the mean square
		// r^2 (ln(1 / r) + 1 / 2) / (4 pi) in a flat disk of radius 1.
		const double dipole = curvature * curvature * r * r * (0.5 - std::log(r)) / (8.0 * kPi);
		const double rise = 2.0 * curvature * (phi[v] - phi[old]) + dipole;
		const double change = coneCost(model.priceOf(rise), tree.distance(v) - own, 0);
		if (change < -kMinObjectiveGain && present + rise <= maxEnergy)
			places.emplace_back(change, v);
	}
	const std::size_t count = std::min(places.size(), kMaxAttempts);
	const auto end = places.begin() + static_cast<std::ptrdiff_t>(count);
	std::partial_sort(places.begin(), end, places.end());
	std::vector<Vertex> best;
	for (auto place = places.begin(); place != end; ++place)
		best.push_back(place->second);
	return model.tryMove(i, best, [&](Vertex v, double energy) {
		const double saved = kSeamPrice * (own - tree.distance(v)) - kMinObjectiveGain;
		return energy <= std::min(maxEnergy, present + saved / model.priceOf(1.0));
	});
}

} // namespace

void startCones(ConeModel& model, const ConeSites& sites)
{
	const int count = model.minSize();
	const double sign = model.total() < 0.0 ? -1.0 : 1.0;
	while (model.size() < count) {
		const VertexVector phi =
			model.gradientAt(Eigen::VectorXd::Constant(model.size(), model.total() / count));
		const Vertex v = lowest(model, sites, [&](Vertex w) { return sign * phi[w]; });
		if (!v.isValid())
			break;
		model.append({v});
	}
	model.fit();
}

bool addCones(ConeModel& model, const ConeSites& sites, int count)
{
	checkpoint();
	const std::vector<Vertex> places = maxGains(model, sites, model.gradient(), count);
	model.append(places);
	model.fit();
	return !places.empty();
}

void relocateCones(ConeModel& model, const ConeSites& sites, int rounds)
{
	double present = model.energy();
	for (int round = 0; round < rounds; ++round) {
		bool hasMoved = false;
		for (int i = 0; i < model.size(); ++i)
			hasMoved |= std::abs(model.curvature(i)) > kNegligible
							? relocate(model, sites, i, present)
							: replant(model, sites, i, present);
		if (!hasMoved)
			return;
	}
}

void dropCones(ConeModel& model, const ConeSites& sites, double distortion)
{
	const auto isEnough = [&] {
		relocateCones(model, sites);
		return model.distortion() <= distortion;
	};
	const auto dropOne = [&] {
		std::vector<int> cones(positionOf(model.size()));
		std::iota(cones.begin(), cones.end(), 0);
		const Eigen::VectorXd needs = model.needs();
		std::stable_sort(
			cones.begin(), cones.end(), [&](int a, int b) { return needs[a] < needs[b]; });
		cones.resize(std::min(cones.size(), kMaxDropTrials));
		return std::any_of(
			cones.begin(), cones.end(), [&](int i) { return model.tryWithout(i, isEnough); });
	};
	while (model.size() > model.minSize() && dropOne()) {
	}
}

bool dropCostlyCones(ConeModel& model, SeamTree& tree)
{
	const int before = model.size();
	std::set<Vertex> needed;
	while (model.size() > model.minSize() && dropDearest(model, tree, needed)) {
	}
	return model.size() < before;
}

void removeWeakCones(ConeModel& model)
{
	std::vector<int> weak;
	for (int i = model.size() - 1; i >= 0; --i)
		if (std::abs(model.curvature(i)) <= kMinCurvature)
			weak.push_back(i);
	for (const int i : weak) // from the last, so that the others keep their numbers
		if (model.size() > model.minSize())
			model.remove(i);
	model.fit();
}

void shortenConeTree(ConeModel& model, SeamTree& tree, const ConeSites& sites, double maxDistortion)
{
	const double maxEnergy = 0.25 * maxDistortion * maxDistortion;
	const double far = std::min(kMaxStep, kMaxStepOfMany / std::sqrt(model.size()));
	SearchFront<Vertex, Vertex> front(sites.toCut().size());
	std::map<Vertex, std::vector<ConeSites::Way>>
		around; // most cones stay where they are for several rounds
	for (int round = 0; round < kMaxRounds; ++round) {
		bool hasMoved = false;
		for (int i = 0; i < model.size(); ++i) {
			const Vertex cone = model.vertex(i);
			const auto [known, isNew] = around.try_emplace(cone);
			if (isNew)
				known->second = sitesAround(sites, cone, far, front);
			const double own = tree.remove(cone);
			hasMoved |= moveNearby(model, tree, known->second, i, own, maxEnergy);
			tree.add(model.vertex(i));
		}
		if (!hasMoved)
			return;
	}
}

} // namespace ricci
