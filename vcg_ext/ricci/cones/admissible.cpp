// SPDX-License-Identifier: GPL-3.0-or-later
#include "admissible.h"

#include "../base/numbers.h"
#include "../error.h"

#include <cmath>

namespace ricci {

Target zeroTarget(const Topology& topology)
{
	Target target;
	target.curvature = VertexVector::Zero(topology.boundary.size());
	target.fixed.assign(topology.boundary.size(), 0);
	return target;
}

std::vector<Vertex> selectedVertices(const VertexArray<char>& selected)
{
	std::vector<Vertex> vertices;
	for (const Vertex v : selected.indices())
		if (selected[v])
			vertices.push_back(v);
	return vertices;
}

std::vector<Vertex> selectedCones(const VertexArray<char>& selected)
{
	std::vector<Vertex> cones = selectedVertices(selected);
	if (cones.empty())
		throw InvalidOption(InvalidOption::NothingSelected);
	return cones;
}

void setPrescribed(const TargetInput& input, Target& target)
{
	std::size_t notFinite = 0;
	const double rounding = kPrescribedRounding * input.prescribedPrecision;
	for (const Vertex v : input.prescribed.indices()) {
		const double K = input.prescribed[v];
		notFinite += !std::isfinite(K);
		target.curvature[v] = std::abs(K) <= rounding ? 0.0 : K;
	}
	if (notFinite > 0)
		throw InadmissibleCurvature(InadmissibleCurvature::NotFinite, 0.0, 0.0, notFinite);
}

void checkVertexBounds(const Topology& topology, const Target& target)
{
	if (target.circular)
		return;
	const auto bound = [&](Vertex v) { return topology.boundary[v] ? kPi : 2 * kPi; };
	std::size_t tooLarge = 0;
	Vertex worst;
	for (const Vertex v : target.fixed.indices()) {
		if (target.fixed[v] || !(target.curvature[v] >= bound(v)))
			continue;
		++tooLarge;
		if (!worst.isValid() || target.curvature[v] > target.curvature[worst])
			worst = v;
	}
	if (tooLarge > 0)
		throw InadmissibleCurvature(
			topology.boundary[worst] ? InadmissibleCurvature::TooLargeOnBoundary
									 : InadmissibleCurvature::TooLargeInside,
			target.curvature[worst],
			bound(worst),
			tooLarge);
}

void checkFreeBoundary(const Topology& topology, const Target& target)
{
	if (!target.hasFixed())
		return;
	double insideSum = 0.0;
	std::size_t boundaryCount = 0;
	for (const Vertex v : topology.boundary.indices()) {
		if (topology.boundary[v])
			++boundaryCount;
		else if (!target.fixed[v])
			insideSum += target.curvature[v];
	}
	const double bound = topology.type.totalCurvature() - kPi * static_cast<double>(boundaryCount);
	if (insideSum <= bound)
		throw InadmissibleCurvature(
			InadmissibleCurvature::FreeBoundary, insideSum, bound, boundaryCount);
}

} // namespace ricci
