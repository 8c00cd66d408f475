// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_distortion.h"

#include "../base/points.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../flow/target.h"
#include "../numerics/iteration.h"
#include "patch_energy.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace ricci {

namespace {

/// Steps at most, the share of what is above an isometry's energy that one must gain, and of itself that must be left.
constexpr int kMaxStretchSteps = 40;
constexpr double kMinStretchGain = 1e-3, kMinStretchStep = 1e-8;

} // namespace

bool leastStretch(FlatMesh& flat, const PointGroups& groups)
{
	checkpoint();
	const double height = kMinHeight * flat.box().extent();
	const Validity validity{height, kWantedHeights * height};
	const Patch whole = wholePatch(flat, groups);
	if (whole.variables == 0)
		return false;
	PatchEnergy energy(
		flat,
		groups,
		whole,
		restShapes(flat, whole, RestShapes::OfSurfaceEvenly, validity),
		PatchCost::SymmetricDirichlet);
	std::vector<int> counted; // triangles
	for (const int f : flat.points.indices())
		if (orientation(flat.at(f)) > 0)
			counted.push_back(f);
		else
			energy.stress(f, 0.0);
	const Array<Point2> start = flat.place;
	const auto placesAt = [&](const Eigen::VectorXd& x) {
		Array<Point2> places = start;
		for (const int p : places.indices())
			if (const int v = whole.variable[p]; v >= 0)
				places[p] = groups.displaced(p, start, {x[2 * v], x[2 * v + 1]});
		return places;
	};
	Eigen::VectorXd x = Eigen::VectorXd::Zero(energy.size()), trial, gradient, direction;
	double value = energy.value(x, 0.0);
	// By how much the energy falls in one step; 0 where there is no way down.
	const auto gainOfStep = [&] {
		if (!energy.newtonStep(x, 0.0, gradient, direction))
			return 0.0;
		double next = value;
		const double length = LineSearch{kMinStretchStep}.run(
			direction.dot(gradient),
			value,
			[&](double step) {
				trial = x + step * direction;
				return next = energy.value(trial, 0.0);
			},
			[&] {
				flat.place = placesAt(trial);
				return std::all_of(counted.begin(), counted.end(), [&](int f) {
					return orientation(flat.at(f)) > 0;
				});
			});
		if (length == 0.0)
			return 0.0;
		x.swap(trial);
		return std::exchange(value, next) - next;
	};
	const auto isWorthAStep = [&](double gain) {
		// It may be less than an isometry's where some triangles do not count.
		return gain > kMinStretchGain * std::abs(value - MapCost().energy);
	};
	int steps = 0;
	while (steps < kMaxStretchSteps && std::isfinite(value) && isWorthAStep(gainOfStep()))
		++steps;
	flat.place = placesAt(x);
	return steps == kMaxStretchSteps;
}

} // namespace ricci
