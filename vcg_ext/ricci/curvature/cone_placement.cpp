// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_placement.h"

#include "../base/numbers.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "area_change.h"
#include "coarse_flow.h"
#include "cone_search.h"
#include "cone_tree.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace ricci {

namespace {

/// Cones move once the distortion is within this factor of the wanted one.
constexpr double kNearlyEnough = 1.1;

/// On more vertices than the first number, cones are searched for on at most so many aggregates of
/// them as the second.
constexpr int kMaxSearched = 10000, kMaxAggregates = 7000;

/// Searches on aggregates, each for the distortion that the surface itself missed.
constexpr int kMaxCoarseRounds = 3;

void checkCount(const ConeRequest& request, const ConeModel& model, const ConeSites& sites)
{
	if (request.count > 0 && request.count < model.minSize())
		throw InvalidOption(InvalidOption::TooFewCones, request.count, model.minSize());
	const int wanted = std::max(request.count, model.minSize());
	if (wanted > sites.count())
		throw InvalidOption(
			InvalidOption::TooFewVertices,
			request.count,
			wanted,
			static_cast<std::size_t>(sites.count()));
}

/// Adds cones up to the number that is asked for.
void placeCount(const ConeRequest& request, ConeModel& model, const ConeSites& sites)
{
	while (model.size() < request.count && addCone(model, sites)) {
	}
	relocateCones(model, sites);
	model.setRounding(request.rounding);
}

/// How many cones \p model can work with.
int maxCones(const ConeModel& model)
{
	const auto vertices = static_cast<int>(model.area().size());
	return std::clamp(kMaxConeNumbers / vertices, kMaxPlacedCones, kMaxNeededCones);
}

/// Decides whether there may be more cones to bring the distortion down to what is wanted.
class Growth
{
public:
	Growth(const ConeModel& model, double wanted) :
			m_model(model), m_needed(std::max(kMaxPlainSpread, wanted))
	{
	}

	/// To be called once for each cone. Where cones are needed beyond kMaxPlacedCones, the distortion,
	/// which falls ever more slowly, must reach the limit with as many as there may be if it goes on
	/// as with the last ones.
	bool mayGoOn()
	{
		const double present = m_model.distortion();
		m_distortions.push_back(present);
		if (m_model.size() < kMaxPlacedCones)
			return true;
		const int left = maxCones(m_model) - m_model.size();
		if (present <= m_needed || left <= 0)
			return false;
		if (m_distortions.size() <= kPace)
			return true;
		const double fall = m_distortions[m_distortions.size() - 1 - kPace] - present;
		return fall * left >= (present - m_needed) * kPace;
	}

private:
	static constexpr int kPace = 32; // cones that show how fast the distortion falls

	const ConeModel& m_model;
	double m_needed;
	std::vector<double> m_distortions; // with each number of cones so far
};

/// Adds cones until they reach the distortion. Free curvatures show where to put them; the rounded
/// ones have to reach it.
void addForDistortion(const ConeRequest& request, ConeModel& model, const ConeSites& sites)
{
	model.setRounding(request.rounding);
	Growth growth(model, request.distortion);
	while (model.distortion() > request.distortion && growth.mayGoOn()) {
		model.setRounding(ConeRounding::Free);
		if (!addCone(model, sites))
			break;
		if (model.distortion() <= kNearlyEnough * request.distortion)
			relocateCones(model, sites);
		model.setRounding(request.rounding);
	}
}

/// The same, with no more cones than it takes.
void placeForDistortion(const ConeRequest& request, ConeModel& model, const ConeSites& sites)
{
	addForDistortion(request, model, sites);
	if (model.distortion() <= request.distortion && model.size() <= kMaxPlacedCones)
		dropCones(model, sites, request.distortion);
}

/// Adds cones until areas are expected to be kept as is asked for.
void addForAreas(
	const EmbeddedSurface& surface,
	const ConeRequest& request,
	ConeModel& model,
	const ConeSites& sites)
{
	const int limit = std::min(model.size() + kMaxMoreCones, maxCones(model));
	model.setRounding(request.rounding);
	while (model.size() < limit &&
		   areaExcess(areaChange(surface, model.factor()), request.distortion) > 1.0) {
		model.setRounding(ConeRounding::Free);
		if (!addCone(model, sites))
			break;
		model.setRounding(request.rounding);
	}
}

/// Puts the cones of \p coarse, on aggregates with these \p roots, into \p model in place of its own.
void copyCones(const ConeModel& coarse, const VertexArray<Vertex>& roots, ConeModel& model)
{
	VertexArray<char> isWanted(model.area().size(), 0);
	for (int i = 0; i < coarse.size(); ++i)
		isWanted[roots[coarse.vertex(i)]] = 1;
	for (int i = model.size() - 1; i >= 0; --i)
		if (!isWanted[model.vertex(i)])
			model.remove(i);
	std::vector<Vertex> missing;
	for (const Vertex v : isWanted.indices())
		if (isWanted[v] && !model.isCone(v))
			missing.push_back(v);
	model.append(missing);
	model.fit();
}

/// All of the search, from the cones that \p model has.
void search(
	const SurfaceType& type, const ConeRequest& request, ConeModel& model, const ConeSites& sites)
{
	startCones(model, sites);
	if (request.count > 0)
		placeCount(request, model, sites);
	else
		placeForDistortion(request, model, sites);
	if (request.rounding != ConeRounding::Free) {
		model.setRounding(request.rounding); // also where no vertex was left for one more cone
		relocateCones(model, sites);
	}
	removeWeakCones(model);

	// The cut of a sphere is the tree of its cones and nothing else.
	if (request.shortSeams && type.isSphere()) {
		shortenConeTree(
			model,
			sites,
			request.count > 0 ? kSeamAllowance * model.distortion() : request.distortion);
		removeWeakCones(model);
	}
}

/// The same on aggregates of vertices, then on the surface itself as far as its own distortion asks
/// for it.
void searchFromCoarse(
	const SurfaceType& type,
	const ConeRequest& request,
	LinearFlow& flow,
	ConeModel& model,
	const ConeSites& sites)
{
	CoarseFlow coarse(flow, kMaxAggregates);
	const ConeSites coarseSites(sites, coarse.roots);
	ConeModel coarseModel(coarse.flow, model.total());
	ConeRequest coarseRequest = request;
	model.setRounding(request.rounding);
	double excess = 0.0; // of the distortion on the surface itself
	for (int round = 0; round < kMaxCoarseRounds; ++round) {
		search(type, coarseRequest, coarseModel, coarseSites);
		copyCones(coarseModel, coarse.roots, model);
		excess = model.distortion() / request.distortion;
		if (request.count > 0 || excess <= 1.0)
			break;
		coarseRequest.distortion /= excess;
	}
	if (request.count > 0 || excess > 1.0)
		relocateCones(model, sites);
	if (request.count == 0)
		addForDistortion(request, model, sites);
	removeWeakCones(model);
}

PlacedCones result(ConeModel& model)
{
	PlacedCones placed;
	placed.distortion = model.exactDistortion();
	std::vector<std::pair<Vertex, double>> cones;
	for (int i = 0; i < model.size(); ++i)
		if (model.curvature(i) != 0.0)
			cones.emplace_back(model.vertex(i), model.curvature(i));
	std::sort(cones.begin(), cones.end());
	for (const auto& [vertex, curvature] : cones) {
		placed.vertices.push_back(vertex);
		placed.curvatures.push_back(curvature);
	}
	return placed;
}

} // namespace

PlacedCones
placeCones(const EmbeddedSurface& surface, const InitialPacking& start, const ConeRequest& request)
{
	LinearFlow flow(surface, start, request.boundary);
	return placeCones(surface, flow, request);
}

PlacedCones placeCones(const EmbeddedSurface& surface, LinearFlow& flow, const ConeRequest& request)
{
	advance(0.0, "Placing cones");
	const SurfaceType& type = surface.topology.type;
	const ConeSites sites(surface, request.vertices);
	ConeModel model(flow, 2 * kPi * type.eulerCharacteristic());
	checkCount(request, model, sites);
	if (surface.triangulation.vertexCount() <= kMaxSearched)
		search(type, request, model, sites);
	else
		searchFromCoarse(type, request, flow, model, sites);
	return result(model);
}

PlacedCones
moreCones(const EmbeddedSurface& surface, const FlowResult& flow, const ConeRequest& request)
{
	advance(0.0, "Placing cones");
	const ConeSites sites(surface, request.vertices);
	LinearFlow linear(surface, flow, request.boundary, tailWeights(surface, flowFactor(flow)));
	ConeModel model(linear, 2 * kPi * surface.topology.type.eulerCharacteristic());
	std::vector<Vertex> cones;
	for (const Vertex v : surface.triangulation.vertices())
		if (sites.isAllowed(v) && flow.target.curvature[v] != 0.0)
			cones.push_back(v);
	model.append(cones);
	model.fit();
	addForAreas(surface, request, model, sites);
	removeWeakCones(model);
	PlacedCones placed = result(model);
	placed.distortion = areaChange(surface, model.factor()).spread;
	return placed;
}

} // namespace ricci
