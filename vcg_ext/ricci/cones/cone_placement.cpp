// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_placement.h"

#include "../base/parallel.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "area_change.h"
#include "cone_model.h"
#include "mirrored_cones.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace ricci {

namespace {

/// By this factor the distortion of a given number of cones may grow for shorter seams.
constexpr double kSeamAllowance = 1.05;

/// Where the distortion decides how many cones are placed, there are at most this many, or as many as
/// lower energy and price of seams, if those are more, up to the second number and while there are no
/// more than so many numbers to keep, one for each cone and vertex. For the least cost they are no more than half of the
/// vertices, either: at nearly all, one does what its neighbours do. The search takes time in proportion to
/// them, and less is worth while where there is another map: far less beside one that costs no more than kPoorMap. The
/// longer search beside a poorer one changes four of 66 meshes: E 5.57 -> 5.23, 5.57 -> 5.64, 6.03 -> 5.52, 5.31 -> 5.01.
constexpr int kMaxPlacedCones = 64, kMaxNeededCones = 512, kMaxConeNumbers = 64000000,
			  kMaxConeNumbersBeside = 600000, kMaxConeNumbersBesidePoor = 5000000;
constexpr double kPoorMap = 5.0;

/// On more vertices than the first number, cones are searched for on at most so many aggregates of them as the
/// second. For the least cost, that begins above the third number; up to the first, the cones that are found are then
/// dropped and moved on the surface itself. On 35 meshes between the two the whole takes x 0.90 by it, and the objective
/// is lower by 0.006 in the mean.
constexpr int kMaxSearched = 20000, kMaxAggregates = 12000, kMaxSearchedForCost = 5000;

/// Searches on aggregates, each for the distortion that the surface itself missed; and rounds in which
/// cones move on the surface itself.
constexpr int kMaxCoarseRounds = 3, kMaxFineRounds = 2;

/// Steps that fit the curvatures found on aggregates to the surface.
constexpr int kMaxFitSteps = 20;

void checkCount(const TargetRequest& request, int least, const ConeSites& sites)
{
	const int count = request.goal.count, wanted = std::max(count, least);
	if (request.goal.kind == ConeGoal::Count && count < least)
		throw InvalidOption(InvalidOption::TooFewCones, count, least);
	if (wanted > sites.count())
		throw InvalidOption(
			InvalidOption::TooFewVertices, count, wanted, static_cast<std::size_t>(sites.count()));
}

/// Adds cones up to the number that is asked for.
void placeCount(int count, ConeModel& model, const ConeSites& sites)
{
	while (model.size() < count &&
		   addCones(model, sites, std::min(count - model.size(), 1 + model.size() / 8))) {
	}
	relocateCones(model, sites);
}

/// How many cones \p model can work with.
int maxCones(const ConeModel& model, const TargetRequest& request)
{
	// There are none if all lie on a boundary that is free.
	const auto vertices = static_cast<int>(model.area().size());
	const int numbers = !(request.alternative < kInfinity) ? kMaxConeNumbers
						: request.alternative > kPoorMap   ? kMaxConeNumbersBesidePoor
														   : kMaxConeNumbersBeside;
	const int most = request.goal.kind == ConeGoal::LeastCost
						 ? std::clamp(vertices / 2, kMaxPlacedCones, kMaxNeededCones)
						 : kMaxNeededCones;
	return std::clamp(numbers / std::max(1, vertices), kMaxPlacedCones, most);
}

/// In a search for the objective, cones move first when there are so many, and again whenever there are
/// twice as many; afterwards, those that are not worth their seams go in so many rounds.
constexpr int kFirstRelocated = 16, kMaxObjectiveRounds = 3;

/// Adds cones while that lowers the energy that is expected and the price of seams and cones together.
class Growth
{
public:
	Growth(const TargetRequest& request, ConeModel& model, const ConeSites& sites) :
			m_model(model), m_sites(sites), m_tree(sites, model.vertices()),
			m_most(maxCones(model, request)), m_best(model.size()), m_least(objective())
	{
	}

	/// Whether some of the last cones lowered it.
	bool mayGoOn() const
	{
		return m_model.size() < m_most && m_model.size() - m_best <= kMaxVain + m_best / kShareVain;
	}

	/// Whether a map with more cones, each at its price, may cost less than \p alternative, if energy falls and
	/// seams grow as since the last call, when there were about half as many. The first call does not tell.
	bool mayFallBelow(double alternative)
	{
		MapCost cost{4.0 + m_model.priceOf(m_model.energy()), m_tree.length()};
		const MapCost last = std::exchange(m_last, cost);
		const double pace = (cost.energy - 4.0) / (last.energy - 4.0);
		bool mayFall = !std::isfinite(last.energy);
		for (int n = m_model.size(); n <= m_most && !mayFall; n *= 2) {
			mayFall = cost.total() + kConePrice * n < alternative;
			cost.energy = 4.0 + pace * (cost.energy - 4.0);
			cost.seams += m_last.seams - last.seams;
		}
		return mayFall;
	}

	/// Lets the cones move.
	void relocate()
	{
		relocateCones(m_model, m_sites, 1);
		m_tree = SeamTree(m_sites, m_model.vertices());
	}

	/// Adds one cone, or some at a time where there are many already, and fits the curvatures.
	/// \return false if no vertex is left
	bool add()
	{
		const int before = m_model.size();
		if (!addCones(m_model, m_sites, 1 + before / kShareAtOnce))
			return false;
		for (int i = before; i < m_model.size(); ++i)
			m_tree.add(m_model.vertex(i));
		if (objective() < m_least) {
			m_least = objective();
			m_best = m_model.size();
		}
		return true;
	}

private:
	static constexpr int kMaxVain = 8, kShareVain = 4, kShareAtOnce = 8;

	double objective() const
	{
		return coneCost(m_model.priceOf(m_model.energy()), m_tree.length(), m_model.size());
	}

	ConeModel& m_model;
	const ConeSites& m_sites;
	SeamTree m_tree;
	int m_most, m_best; // numbers of cones
	double m_least;
	MapCost m_last{kInfinity}; // at the last call of mayFallBelow()
};

/// Adds more cones than lower the energy and the price of the seams together.
void growForObjective(const TargetRequest& request, ConeModel& model, const ConeSites& sites)
{
	Growth growth(request, model, sites);
	// Where a map has shown what energy costs, cones are known that come near the other map.
	const double alternative = request.energyFactor > 1.0 ? kInfinity : request.alternative;
	for (int relocated = kFirstRelocated; growth.mayGoOn() && growth.add();)
		if (model.size() >= relocated) {
			growth.relocate();
			relocated = 2 * model.size();
			if (!growth.mayFallBelow(alternative))
				break;
		}
	relocateCones(model, sites, 2);
}

/// Takes out the cones that are not worth their seams, and shortens the others'.
void tidyForObjective(ConeModel& model, const ConeSites& sites)
{
	for (int round = 0; round < kMaxObjectiveRounds; ++round) {
		SeamTree tree(sites, model.vertices());
		if (!dropCostlyCones(model, tree) && round > 0)
			return;
		shortenConeTree(model, tree, sites, kInfinity);
	}
}

/// Adds cones until they reach the spread. Free curvatures show where to put them; the rounded
/// ones have to reach it.
void addForSpread(const TargetRequest& request, ConeModel& model, const ConeSites& sites)
{
	const double spread = request.goal.spread;
	model.setRounding(request.rounding);
	Growth growth(request, model, sites);
	while (model.distortion() > spread && (model.size() < kMaxPlacedCones || growth.mayGoOn())) {
		model.setRounding(ConeRounding::Free);
		if (!growth.add())
			break;
		if (model.distortion() <= kSpreadSlack * spread)
			relocateCones(model, sites);
		model.setRounding(request.rounding);
	}
}

/// Adds cones until areas are expected to be kept as is asked for.
void addForAreas(
	const EmbeddedSurface& surface,
	const TargetRequest& request,
	ConeModel& model,
	const ConeSites& sites)
{
	const int limit = std::min(model.size() + kMaxPlacedCones, maxCones(model, request));
	model.setRounding(request.rounding);
	while (model.size() < limit &&
		   areaExcess(areaChange(surface, model.factor()), request.goal.spread) > 1.0) {
		model.setRounding(ConeRounding::Free);
		if (!addCones(model, sites))
			break;
		model.setRounding(request.rounding);
	}
}

/// All of the search, from the cones that \p model has. For the least cost, none are added to any that were found
/// elsewhere.
void search(const TargetRequest& request, ConeModel& model, const ConeSites& sites)
{
	startCones(model, sites);
	const ConeGoal& goal = request.goal;
	switch (goal.kind) {
	case ConeGoal::LeastCost:
		if (model.size() <= model.minSize())
			growForObjective(request, model, sites);
		tidyForObjective(model, sites);
		break;
	case ConeGoal::Count:
		placeCount(goal.count, model, sites);
		break;
	case ConeGoal::Spread:
		addForSpread(request, model, sites);
		if (model.distortion() <= goal.spread && model.size() <= kMaxPlacedCones)
			dropCones(model, sites, goal.spread);
		break;
	}
	if (request.rounding != ConeRounding::Free) {
		model.setRounding(request.rounding); // also where no vertex was left for one more cone
		relocateCones(model, sites);
	}
	removeWeakCones(model);
	if (goal.kind != ConeGoal::LeastCost) {
		SeamTree tree(sites, model.vertices());
		const double most =
			goal.kind == ConeGoal::Count ? kSeamAllowance * model.distortion() : goal.spread;
		shortenConeTree(model, tree, sites, most);
		removeWeakCones(model);
	}
}

PlacedCones result(
	const ConeSites& sites,
	const std::vector<Vertex>& vertices,
	const Eigen::VectorXd& curvatures,
	double distortion,
	double seams)
{
	PlacedCones placed;
	placed.distortion = distortion;
	placed.seams = seams;
	placed.seamsWithout = sites.cutLength();
	std::vector<std::pair<Vertex, double>> cones;
	for (std::size_t i = 0; i < vertices.size(); ++i)
		if (const double k = curvatures[static_cast<Eigen::Index>(i)]; k != 0.0)
			cones.emplace_back(vertices[i], k);
	std::sort(cones.begin(), cones.end());
	for (const auto& [vertex, curvature] : cones) {
		placed.vertices.push_back(vertex);
		placed.curvatures.push_back(curvature);
	}
	return placed;
}

PlacedCones result(ConeModel& model, const ConeSites& sites)
{
	const std::vector<Vertex>& vertices = model.vertices();
	return result(
		sites,
		vertices,
		model.curvatures(),
		model.exactDistortion(),
		SeamTree(sites, vertices).length());
}

/// [aggregate] what its root has.
VertexVector at(const VertexArray<Vertex>& roots, const VertexVector& values)
{
	VertexVector result(roots.size());
	for (const Vertex c : roots.indices())
		result[c] = values[roots[c]];
	return result;
}

/// The search for a number of cones or a spread on aggregates, and then on the surface itself as far as its own
/// spread asks for it.
void searchFromCoarse(
	const TargetRequest& request, LinearFlow& flow, ConeModel& model, const ConeSites& sites)
{
	VertexArray<Vertex> roots;
	LinearFlow coarse = onAggregates(flow.system(roots), kMaxAggregates, roots);
	const ConeSites coarseSites(sites, roots);
	ConeModel coarseModel(coarse, model.total(), 1.0, at(roots, flow.curvature()));
	TargetRequest coarseRequest = request;
	const bool isCounted = request.goal.kind == ConeGoal::Count;
	model.setRounding(request.rounding);
	double excess = 0.0; // of the spread on the surface itself
	for (int round = 0; round < kMaxCoarseRounds; ++round) {
		search(coarseRequest, coarseModel, coarseSites);
		std::vector<Vertex> cones = coarseModel.vertices();
		for (Vertex& v : cones)
			v = roots[v];
		setCones(std::move(cones), model);
		excess = model.distortion() / request.goal.spread;
		if (isCounted || excess <= 1.0)
			break;
		coarseRequest.goal.spread /= excess;
	}
	if (isCounted || excess > 1.0)
		relocateCones(model, sites, kMaxFineRounds);
	if (!isCounted)
		addForSpread(request, model, sites);
	removeWeakCones(model);
}

/// The search on the surface itself, from cones that may be known, for a number or a spread on aggregates first if
/// there are many vertices.
PlacedCones placeOnSurface(
	const EmbeddedSurface& surface,
	LinearFlow& flow,
	const TargetRequest& request,
	const ConeSites& sites,
	std::vector<Vertex> known)
{
	ConeModel model(
		flow, surface.topology.type.totalCurvature(), request.energyFactor, flow.curvature());
	checkCount(request, model.minSize(), sites);
	if (!known.empty())
		setCones(std::move(known), model);
	if (flow.vertexCount() <= kMaxSearched)
		search(request, model, sites);
	else
		searchFromCoarse(request, flow, model, sites);
	mirrorCones(request, sites, {}, surface.positions, model);
	PlacedCones placed = result(model, sites);
	placed.atLimit = model.size() >= maxCones(model, request);
	mirrorCurvatures(request, placed);
	return placed;
}

/// All of the search on aggregates of vertices, for what is the least cost there, while another thread
/// factorises the flow. On the surface itself the cones are tidied or, where there are too many vertices for that,
/// their curvatures are fitted by conjugate gradients, with the equation on the aggregates as the preconditioner: each
/// step costs two linear solutions, however many cones there are.
PlacedCones
placeOnAggregates(const EmbeddedSurface& surface, LinearFlow& flow, const TargetRequest& request)
{
	const double total = surface.topology.type.totalCurvature();
	VertexArray<Vertex> roots;
	LinearSystem whole = flow.system(roots);
	std::optional<ConeSites> sites, coarseSites;
	std::optional<LinearFlow> coarse;
	std::optional<ConeModel> found;
	besides(
		defaultThreads(),
		[&] {
			sites.emplace(surface, request.coneVertices());
			checkCount(request, minConeCount(flow, total), *sites);
		},
		[&] {
			const int most = std::min(kMaxAggregates, flow.vertexCount() / 2);
			coarse.emplace(onAggregates(std::move(whole), most, roots));
			found.emplace(*coarse, total, request.energyFactor, at(roots, flow.curvature()));
		});
	besides(
		defaultThreads(),
		[&] {
			coarseSites.emplace(*sites, roots);
			search(request, *found, *coarseSites);
		},
		[&] { flow.factorize(); });
	ConeModel& model = *found;
	if (flow.vertexCount() <= kMaxSearched) {
		std::vector<Vertex> known = model.vertices();
		for (Vertex& v : known)
			v = roots[v];
		return placeOnSurface(surface, flow, request, *sites, std::move(known));
	}
	const std::vector<Vertex> vertices =
		mirrorCones(request, *coarseSites, roots, surface.positions, model);
	const auto spread = [&](const Eigen::VectorXd& k) {
		return spreadOut(vertices, k, flow.vertexCount());
	};
	const auto slope = [&](const VertexVector& u) { // half that of the energy
		checkpoint();
		const VertexVector phi = flow.gradient(u);
		Eigen::VectorXd result(model.size());
		for (std::size_t i = 0; i < vertices.size(); ++i)
			result[static_cast<Eigen::Index>(i)] = phi[vertices[i]];
		return result;
	};
	const Eigen::VectorXd start = model.curvatures();
	const Eigen::VectorXd most = start.cwiseMax(kMaxConeCurvature);
	Eigen::VectorXd k = start;
	VertexVector u;
	const auto fit = [&] {
		u = flow.factor(spread(k));
		if (request.rounding != ConeRounding::Free || model.size() == 0)
			return;
		Eigen::VectorXd rest = -slope(u), step = model.descent(rest), way = step;
		double gain = rest.dot(step);
		for (int i = 0; i < kMaxFitSteps && gain > kSmall * flow.meanSquare(u); ++i) {
			const Eigen::VectorXd pull = slope(flow.solve(spread(way)));
			const double length = gain / way.dot(pull);
			k += length * way;
			rest -= length * pull;
			step = model.descent(rest);
			way = step + rest.dot(step) / gain * way;
			gain = rest.dot(step);
		}
		// As far as no bound is passed: the energy falls all the way.
		double share = 1.0;
		for (Eigen::Index i = 0; i < k.size(); ++i)
			if (k[i] > most[i])
				share = std::min(share, (most[i] - start[i]) / (k[i] - start[i]));
		k = (start + share * (k - start)).cwiseMin(most);
		u = flow.factor(spread(k));
	};
	double seams = 0.0;
	besides(defaultThreads(), fit, [&] { seams = SeamTree(*sites, vertices).length(); });
	PlacedCones placed = result(*sites, vertices, k, 2.0 * std::sqrt(flow.meanSquare(u)), seams);
	mirrorCurvatures(request, placed);
	return placed;
}

} // namespace

PlacedCones
placeCones(const EmbeddedSurface& surface, InitialPacking& start, const TargetRequest& request)
{
	LinearFlow flow(surface, start, request.boundary());
	return placeCones(surface, flow, request);
}

PlacedCones
placeCones(const EmbeddedSurface& surface, LinearFlow& flow, const TargetRequest& request)
{
	advance(0.0, "Placing cones");
	if (request.goal.kind == ConeGoal::LeastCost && flow.vertexCount() > kMaxSearchedForCost)
		return placeOnAggregates(surface, flow, request);
	return placeOnSurface(surface, flow, request, ConeSites(surface, request.coneVertices()), {});
}

PlacedCones
moreCones(const EmbeddedSurface& surface, const FlowResult& flow, const TargetRequest& request)
{
	advance(0.0, "Placing cones");
	LinearFlow linear(surface, flow, request.boundary(), tailWeights(surface, flowFactor(flow)));
	if (request.goal.kind == ConeGoal::LeastCost) {
		PlacedCones placed = placeCones(surface, linear, request);
		const auto k = Eigen::Map<const Eigen::VectorXd>(
			placed.curvatures.data(), static_cast<Eigen::Index>(placed.curvatures.size()));
		const VertexVector whole = spreadOut(placed.vertices, k, linear.vertexCount());
		placed.distortion = areaChange(surface, linear.factor(whole)).spread;
		return placed;
	}
	const ConeSites sites(surface, request.coneVertices());
	ConeModel model(linear, surface.topology.type.totalCurvature());
	std::vector<Vertex> cones;
	for (const Vertex v : surface.triangulation.vertices())
		if (sites.isAllowed(v) && flow.target.curvature[v] != 0.0)
			cones.push_back(v);
	model.append(cones);
	model.fit();
	addForAreas(surface, request, model, sites);
	removeWeakCones(model);
	PlacedCones placed = result(model, sites);
	placed.distortion = areaChange(surface, model.factor()).spread;
	return placed;
}

} // namespace ricci
