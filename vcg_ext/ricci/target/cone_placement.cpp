// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_placement.h"

#include "../base/numbers.h"
#include "../error.h"
#include "cone_search.h"
#include "cone_tree.h"

#include <algorithm>
#include <utility>

namespace ricci {

namespace {

/// Cones move once the distortion is within this factor of the wanted one.
constexpr double kNearlyEnough = 1.1;

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

/// Adds cones until they reach the distortion. Free curvatures show where to put them; the rounded
/// ones have to reach it.
void placeForDistortion(const ConeRequest& request, ConeModel& model, const ConeSites& sites)
{
	model.setRounding(request.rounding);
	while (model.distortion() > request.distortion && model.size() < kMaxPlacedCones) {
		model.setRounding(ConeRounding::Free);
		if (!addCone(model, sites))
			break;
		if (model.distortion() <= kNearlyEnough * request.distortion)
			relocateCones(model, sites);
		model.setRounding(request.rounding);
	}
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

PlacedCones placeCones(const EmbeddedSurface& surface, FlowStart& start, const ConeRequest& request)
{
	const SurfaceType& type = surface.topology.type;
	const ConeSites sites(surface, request.vertices);
	LinearFlow flow(surface, start, request.boundary);
	ConeModel model(flow, 2 * kPi * type.eulerCharacteristic());
	checkCount(request, model, sites);

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
	return result(model);
}

} // namespace ricci
