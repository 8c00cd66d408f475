// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperbolic_target.h"

#include "../base/numbers.h"
#include "../error.h"

#include <cmath>
#include <string>

namespace ricci {

namespace {

/// \param angle total angle at each selected vertex, radians
void setCones(
	const Topology& topology, double angle, const VertexArray<char>& selected, Target& target)
{
	if (!(angle > 0.0) || !std::isfinite(angle))
		throw InvalidOption(InvalidOption::ConeAngle, angle);
	const std::vector<Vertex> cones = selectedCones(selected);
	for (const Vertex v : cones)
		target.curvature[v] = (topology.boundary[v] ? kPi : 2 * kPi) - angle;
	target.notes.push_back(
		std::to_string(cones.size()) + " cones of angle " + numberText(angle * 180.0 / kPi, 9) +
		" degrees each.");
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
	const double bound = topology.type.totalCurvature();
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

Target chooseHyperbolicTarget(
	const Topology& topology, const HyperbolicTargetOptions& options, const TargetInput& input)
{
	Target target = zeroTarget(topology);
	target.background = Background::HyperbolicPlane;
	switch (options.target) {
	case HyperbolicTarget::HyperbolicMetric:
		break;
	case HyperbolicTarget::SelectedCones:
		setCones(topology, options.coneAngle, input.selected, target);
		break;
	case HyperbolicTarget::Prescribed:
		setPrescribed(input, target);
		break;
	}
	if (options.freeBoundary && !topology.type.isClosed())
		freeTheBoundary(topology, target);
	checkVertexBounds(topology, target);
	if (target.hasFixed())
		checkFreeBoundary(topology, target);
	else
		checkSum(topology, options.target, target);
	return target;
}

} // namespace ricci
