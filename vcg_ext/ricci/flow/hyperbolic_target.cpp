// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperbolic_target.h"

#include "../error.h"
#include "../numbers.h"
#include "../text.h"

#include <cmath>

namespace ricci {

namespace {

/// Prescribed values below this many units of their precision are no cones.
constexpr double kRoundingShare = 4.0;

std::string number(double x)
{
	return numberText(x, 9);
}

void setCones(const Topology& topology, const HyperbolicRequest& request, Target& target)
{
	if (!(request.coneAngle > 0.0) || !std::isfinite(request.coneAngle))
		throw InvalidOption(
			"cone_angle must be greater than 0 degrees, not " +
			number(request.coneAngle * 180.0 / kPi) + ".");
	int count = 0;
	for (std::size_t v = 0; v < request.selected.size(); ++v) {
		if (!request.selected[v])
			continue;
		++count;
		target.curvature[static_cast<Eigen::Index>(v)] =
			(topology.boundary[v] ? kPi : 2 * kPi) - request.coneAngle;
	}
	if (count == 0)
		throw InvalidOption(
			"'Cones at selected vertices' needs selected vertices, but none is selected.");
	target.notes.push_back(
		std::to_string(count) + " cones of angle " + number(request.coneAngle * 180.0 / kPi) +
		" degrees each.");
}

void setPrescribed(const HyperbolicRequest& request, Target& target)
{
	std::size_t notFinite = 0;
	for (std::size_t v = 0; v < request.prescribed.size(); ++v) {
		const double K = request.prescribed[v];
		notFinite += !std::isfinite(K);
		target.curvature[static_cast<Eigen::Index>(v)] =
			std::abs(K) <= kRoundingShare * request.prescribedPrecision ? 0.0 : K;
	}
	if (notFinite > 0)
		throw InadmissibleCurvature(
			std::to_string(notFinite) +
			" vertices have a quality that is not a finite number: 'From vertex quality' needs the "
			"target curvature in radians at every vertex.");
}

void checkAdmissible(const Topology& topology, HyperbolicTarget mode, const Target& target)
{
	int tooLarge = 0, worst = -1;
	double sum = 0.0;
	for (int v = 0; v < static_cast<int>(target.fixed.size()); ++v) {
		if (target.fixed[at(v)])
			continue;
		const double K = target.curvature[v];
		sum += K;
		if (K >= (topology.boundary[at(v)] ? kPi : 2 * kPi)) {
			++tooLarge;
			if (worst < 0 || K > target.curvature[worst])
				worst = v;
		}
	}
	if (tooLarge > 0) {
		const bool onBoundary = topology.boundary[at(worst)] != 0;
		throw InadmissibleCurvature(
			"No metric has curvature " + number(target.curvature[worst]) + " at " +
			(onBoundary ? "a boundary" : "an interior") + " vertex (" + std::to_string(tooLarge) +
			" such): it must be less than " +
			(onBoundary ? "pi = 3.14159265 on the boundary" : "2 pi = 6.28318531 inside") + ".");
	}
	const double bound = 2 * kPi * topology.eulerCharacteristic;
	if (sum > bound)
		return;
	if (mode == HyperbolicTarget::HyperbolicMetric)
		throw InadmissibleCurvature(
			"A hyperbolic metric without cones needs an Euler characteristic below 0, but the "
			"surface is " +
			topology.name() + " with Euler characteristic " +
			std::to_string(topology.eulerCharacteristic) +
			": use 'Generalized Ricci Flow (Euclidean)', or choose 'Cones at selected vertices' "
			"with "
			"small angles.");
	throw InadmissibleCurvature(
		"The target curvature adds up to " + number(sum) +
		", but a hyperbolic metric on this surface needs more than 2 pi chi = " + number(bound) +
		" (Gauss-Bonnet: the difference is the area): choose more or sharper cones, or "
		"'Generalized "
		"Ricci Flow (Euclidean)'.");
}

} // namespace

Target
chooseHyperbolicTarget(const Topology& topology, int vertexCount, const HyperbolicRequest& request)
{
	Target target;
	target.curvature = Eigen::VectorXd::Zero(vertexCount);
	target.fixed.assign(at(vertexCount), 0);
	if (request.mode == HyperbolicTarget::SelectedCones)
		setCones(topology, request, target);
	else if (request.mode == HyperbolicTarget::Prescribed)
		setPrescribed(request, target);
	if (request.freeBoundary && !topology.isClosed()) {
		target.fixed = topology.boundary;
		for (std::size_t v = 0; v < target.fixed.size(); ++v)
			if (target.fixed[v])
				target.curvature[static_cast<Eigen::Index>(v)] = 0.0;
		target.notes.push_back("Free boundary: the boundary's circles keep their radii.");
	}
	checkAdmissible(topology, request.mode, target);
	return target;
}

} // namespace ricci
