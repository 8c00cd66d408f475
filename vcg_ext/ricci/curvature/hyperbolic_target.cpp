// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperbolic_target.h"

#include "../base/numbers.h"
#include "../base/text.h"
#include "../error.h"
#include "admissible.h"

#include <cmath>
#include <string>

namespace ricci {

namespace {

void setCones(const Topology& topology, const HyperbolicRequest& request, Target& target)
{
	if (!(request.coneAngle > 0.0) || !std::isfinite(request.coneAngle))
		throw InvalidOption(InvalidOption::ConeAngle, request.coneAngle);
	const std::vector<Vertex> cones = selectedCones(request.selected);
	for (const Vertex v : cones)
		target.curvature[v] = (topology.boundary[v] ? kPi : 2 * kPi) - request.coneAngle;
	target.notes.push_back(
		std::to_string(cones.size()) + " cones of angle " +
		numberText(request.coneAngle * 180.0 / kPi, 9) + " degrees each.");
}

void freeTheBoundary(const Topology& topology, Target& target)
{
	target.fixed = topology.boundary;
	for (const Vertex v : target.fixed.indices())
		if (target.fixed[v])
			target.curvature[v] = 0.0;
	target.notes.push_back(
		"Free boundary: the boundary's circles keep their radii, at the scale at which the mesh "
		"has "
		"the area " +
		numberText(freeBoundaryArea(topology.type.eulerCharacteristic()), 9) + ".");
}

/// Gauss-Bonnet: the area is positive.
void checkSum(const Topology& topology, HyperbolicTarget mode, const Target& target)
{
	const double sum = target.curvature.sum();
	const double bound = 2 * kPi * topology.type.eulerCharacteristic();
	if (sum > bound)
		return;
	throw InadmissibleCurvature(
		mode == HyperbolicTarget::HyperbolicMetric ? InadmissibleCurvature::HyperbolicSurface
												   : InadmissibleCurvature::HyperbolicSum,
		sum,
		bound,
		0,
		topology.type);
}

} // namespace

Target chooseHyperbolicTarget(const Topology& topology, const HyperbolicRequest& request)
{
	Target target = zeroTarget(topology);
	switch (request.mode) {
	case HyperbolicTarget::HyperbolicMetric:
		break;
	case HyperbolicTarget::SelectedCones:
		setCones(topology, request, target);
		break;
	case HyperbolicTarget::Prescribed:
		setPrescribed(request.prescribed, request.prescribedPrecision, target);
		break;
	}
	if (request.freeBoundary && !topology.type.isClosed())
		freeTheBoundary(topology, target);
	checkVertexBounds(topology, target);
	if (target.hasFixed())
		checkFreeBoundary(topology, target);
	else
		checkSum(topology, request.mode, target);
	return target;
}

} // namespace ricci
