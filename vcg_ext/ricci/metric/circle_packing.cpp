// SPDX-License-Identifier: GPL-3.0-or-later
#include "circle_packing.h"

#include "../numbers.h"
#include "euclidean.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ricci {

namespace {

template<class Clamp>
CirclePacking pack(
	Triangulation triangulation,
	const std::vector<double>& lengths,
	const std::vector<double>& radii,
	Clamp clamp)
{
	CirclePacking packing;
	packing.delta.resize(lengths.size());
	for (int e = 0; e < triangulation.edgeCount(); ++e) {
		const double gi = radii[at(triangulation.origin(2 * e))];
		const double gj = radii[at(triangulation.target(2 * e))];
		packing.delta[at(e)] = clamp(Euclidean::delta(lengths[at(e)], gi, gj));
	}
	packing.u.resize(radii.size());
	std::transform(
		radii.begin(), radii.end(), packing.u.begin(), [](double g) { return std::log(g); });
	packing.triangulation = std::move(triangulation);
	return packing;
}

} // namespace

std::vector<double>
edgeLengths(const Triangulation& triangulation, const std::vector<Point3>& positions)
{
	std::vector<double> lengths(at(triangulation.edgeCount()));
	for (int e = 0; e < triangulation.edgeCount(); ++e)
		lengths[at(e)] = distance(
			positions[at(triangulation.origin(2 * e))], positions[at(triangulation.target(2 * e))]);
	return lengths;
}

std::vector<double>
initialRadii(const Triangulation& triangulation, const std::vector<double>& lengths)
{
	std::vector<double> radii(
		at(triangulation.vertexCount()), std::numeric_limits<double>::infinity());
	for (int f = 0; f < triangulation.faceCount(); ++f) {
		const auto h = triangulation.halfedges(f);
		for (std::size_t k = 0; k < 3; ++k) {
			const double left = lengths[at(Triangulation::edge(h[k]))];
			const double opposite = lengths[at(Triangulation::edge(h[(k + 1) % 3]))];
			const double right = lengths[at(Triangulation::edge(h[(k + 2) % 3]))];
			double& radius = radii[at(triangulation.origin(h[k]))];
			radius = std::min(radius, 0.5 * (left + right - opposite));
		}
	}
	return radii;
}

CirclePacking inversiveDistancePacking(
	Triangulation triangulation,
	const std::vector<double>& lengths,
	const std::vector<double>& radii)
{
	return pack(std::move(triangulation), lengths, radii, [](double delta) {
		return std::max(delta, 0.0);
	});
}

CirclePacking thurstonPacking(
	Triangulation triangulation,
	const std::vector<double>& lengths,
	const std::vector<double>& radii)
{
	return pack(std::move(triangulation), lengths, radii, [](double delta) {
		return std::clamp(delta, -1.0, 0.0);
	});
}

} // namespace ricci
