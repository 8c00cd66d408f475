// SPDX-License-Identifier: GPL-3.0-or-later
#include "flipped_flow.h"

#include "shapes.h"

#include <ricci/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace ricci::testing {

namespace {

/// Curvature above which a vertex counts as a cone.
constexpr double kCone = 1e-9;

FlowDomain domainOf(const SurfaceMesh& mesh)
{
	FlowDomain domain;
	domain.surface = embeddedSurface(VertexArray<Point3>(mesh.positions), mesh.triangles);
	domain.onHole.assign(domain.surface.triangulation.vertexCount(), 0);
	return domain;
}

FlowOptions optionsOf(double epsilon)
{
	FlowOptions options;
	options.method = Method::IntrinsicFlips;
	options.epsilon = epsilon;
	return options;
}

} // namespace

FlippedFlow::FlippedFlow(const SurfaceMesh& m, const TargetRequest& request, double epsilon) :
		mesh(m), domain(domainOf(m))
{
	run(request, epsilon);
}

FlippedFlow::FlippedFlow(const SurfaceMesh& m, const HyperbolicRequest& request, double epsilon) :
		mesh(m), domain(domainOf(m))
{
	run(request, epsilon);
}

void FlippedFlow::run(HyperbolicRequest request, double epsilon)
{
	request.selected.resize(at(base().vertexCount()), 0);
	request.targetCurvature.resize(at(base().vertexCount()), 0.0);
	const FlowOptions options = optionsOf(epsilon);
	result = runRicciFlow(
		surface(),
		initialPacking(surface(), options),
		chooseHyperbolicTarget(surface().topology, request.options, request),
		options);
}

void FlippedFlow::run(TargetRequest request, double epsilon)
{
	request.selected.resize(at(base().vertexCount()), 0);
	request.targetCurvature.resize(at(base().vertexCount()), 0.0);
	const FlowOptions options = optionsOf(epsilon);
	InitialPacking start = initialPacking(surface(), options);
	const Target target = chooseTarget(surface(), start, request);
	result = runRicciFlow(surface(), std::move(start), target, options);
}

VertexArray<char> FlippedFlow::cones() const
{
	VertexArray<char> cone(base().vertexCount(), 0);
	for (const Vertex v : base().vertices())
		cone[v] = !surface().topology.boundary[v] && std::abs(result.target.curvature[v]) > kCone;
	return cone;
}

CutGraph FlippedFlow::cut() const
{
	return cutToDisk(base(), surface().lengths, cones());
}

CutGraph FlippedFlow::cutAnywhere(Random& random) const
{
	EdgeArray<double> costs(base().edgeCount());
	for (double& cost : costs)
		cost = random.real(0.0, 1.0);
	return cutToDisk(base(), costs, cones());
}

SurfaceLayout FlippedFlow::refinement(const CutGraph& cutGraph) const
{
	return layOutRefinement(domain, result, cutGraph.isCut);
}

TargetRequest requestOf(TargetCurvature mode, bool freeBoundary)
{
	TargetRequest request;
	request.target = mode;
	request.freeBoundary = freeBoundary;
	return request;
}

TargetRequest conesAt(const SurfaceMesh& mesh, const std::vector<int>& vertices)
{
	TargetRequest request = requestOf(TargetCurvature::SelectedCones, false);
	request.selected.assign(mesh.positions.size(), 0);
	for (int v : vertices)
		request.selected[at(v)] = 1;
	return request;
}

TargetRequest prescribed(std::vector<double> curvature, bool freeBoundary)
{
	TargetRequest request = requestOf(TargetCurvature::Prescribed, freeBoundary);
	request.targetCurvature = std::move(curvature);
	return request;
}

HyperbolicRequest hyperbolicMetric(bool freeBoundary)
{
	HyperbolicRequest request;
	request.options.freeBoundary = freeBoundary;
	return request;
}

HyperbolicRequest hyperbolicPrescribed(std::vector<double> curvature)
{
	HyperbolicRequest request;
	request.options.target = HyperbolicTarget::Prescribed;
	request.targetCurvature = std::move(curvature);
	return request;
}

std::vector<double>
randomCurvature(int vertexCount, int chi, double low, double high, double share, Random& random)
{
	std::vector<double> curvature(at(vertexCount), 0.0);
	std::vector<std::size_t> chosen(curvature.size());
	std::iota(chosen.begin(), chosen.end(), std::size_t(0));
	random.shuffle(chosen);
	chosen.resize(static_cast<std::size_t>(std::ceil(share * vertexCount)));
	for (std::size_t v : chosen)
		curvature[v] = random.real(low, high);
	for (int round = 0; round < 60; ++round) {
		const double sum = std::accumulate(curvature.begin(), curvature.end(), 0.0);
		const double move = (2 * kPi * chi - sum) / static_cast<double>(chosen.size());
		for (std::size_t v : chosen)
			curvature[v] = std::min(curvature[v] + move, high);
	}
	return curvature;
}

} // namespace ricci::testing
