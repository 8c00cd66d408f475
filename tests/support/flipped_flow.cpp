// SPDX-License-Identifier: GPL-3.0-or-later
#include "flipped_flow.h"

#include "intrinsic.h"
#include "shapes.h"

#include <ricci/metric/circle_packing.h>
#include <ricci/result_assembly.h>
#include <ricci/surface/double_surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace ricci::testing {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr long double kExtendedPi = 3.14159265358979323846264338327950288L;

/// Curvature above which a vertex counts as a cone.
constexpr double kCone = 1e-9;

} // namespace

FlippedFlow::FlippedFlow(const SurfaceMesh& m, const TargetRequest& request, double epsilon) :
		mesh(m), base(glued(m)), lengths(edgeLengths(base, m.positions))
{
	run(request, epsilon);
}

FlippedFlow::FlippedFlow(
	const IntrinsicMesh& metric, const TargetRequest& request, double epsilon) :
		base(metric.triangulation),
		lengths(metric.lengths)
{
	run(request, epsilon);
}

FlippedFlow::FlippedFlow(const SurfaceMesh& m, const HyperbolicRequest& request, double epsilon) :
		mesh(m), background(Background::HyperbolicPlane), base(glued(m)),
		lengths(edgeLengths(base, m.positions))
{
	run(request, epsilon);
}

FlippedFlow::FlippedFlow(
	const IntrinsicMesh& metric, const HyperbolicRequest& request, double epsilon) :
		background(Background::HyperbolicPlane),
		base(metric.triangulation), lengths(metric.lengths)
{
	run(request, epsilon);
}

void FlippedFlow::run(HyperbolicRequest request, double epsilon)
{
	topology = topologyOf(base);
	request.selected.resize(at(base.vertexCount()), 0);
	request.prescribed.resize(at(base.vertexCount()), 0.0);
	run(chooseHyperbolicTarget(topology, base.vertexCount(), request), epsilon);
}

void FlippedFlow::run(TargetRequest request, double epsilon)
{
	topology = topologyOf(base);
	const auto vertexCount = at(base.vertexCount());
	request.selected.resize(vertexCount, 0);
	request.prescribed.resize(vertexCount, 0.0);
	if (request.prescribedPrecision == 0.0)
		request.prescribedPrecision = std::numeric_limits<double>::epsilon();
	run(chooseTarget(base, topology, lengths, mesh.positions, request), epsilon);
}

void FlippedFlow::run(const Target& target, double epsilon)
{
	FlowOptions options;
	options.surgery = Surgery::IntrinsicFlips;
	options.epsilon = epsilon;
	result = runRicciFlow(
		background,
		base,
		lengths,
		mesh.positions,
		target,
		topology.loops.empty() ? std::vector<int>() : topology.loops.front(),
		options,
		[](int, double) {});
}

std::vector<char> FlippedFlow::cones() const
{
	std::vector<char> cone(at(base.vertexCount()), 0);
	for (std::size_t v = 0; v < cone.size(); ++v)
		cone[v] = !topology.boundary[v] &&
				  std::abs(result.target.curvature[static_cast<Eigen::Index>(v)]) > kCone;
	return cone;
}

CutGraph FlippedFlow::cut() const
{
	return cutToDisk(base, lengths, cones(), {});
}

CutGraph FlippedFlow::cutAnywhere(Random& random) const
{
	std::vector<double> costs(lengths.size());
	for (double& cost : costs)
		cost = random.real(0.0, 1.0);
	return cutToDisk(base, costs, cones(), {});
}

CommonRefinement FlippedFlow::refinement(const CutGraph& cutGraph) const
{
	return overlayOfFlow(
		result,
		background,
		base,
		mesh.positions,
		cutGraph.isCut,
		result.doubled,
		false,
		[](double, std::size_t) {});
}

TargetRequest requestOf(TargetCurvature mode, bool freeBoundary)
{
	TargetRequest request;
	request.mode = mode;
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
	request.prescribed = std::move(curvature);
	return request;
}

HyperbolicRequest hyperbolicMetric(bool freeBoundary)
{
	HyperbolicRequest request;
	request.freeBoundary = freeBoundary;
	return request;
}

HyperbolicRequest hyperbolicPrescribed(std::vector<double> curvature)
{
	HyperbolicRequest request;
	request.mode = HyperbolicTarget::Prescribed;
	request.prescribed = std::move(curvature);
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

HyperbolicMeasure::HyperbolicMeasure(const Triangulation& t, const std::vector<double>& lengths) :
		curvature(at(t.vertexCount()), 2 * kExtendedPi), sensitivity(at(t.vertexCount()), 0.0L)
{
	const std::vector<char> boundary = t.boundaryVertices();
	for (std::size_t v = 0; v < boundary.size(); ++v)
		if (boundary[v])
			curvature[v] = kExtendedPi;
	for (int f = 0; f < t.faceCount(); ++f) {
		const auto h = t.halfedges(f);
		std::array<long double, 3> l;
		for (std::size_t k = 0; k < 3; ++k)
			l[k] = lengths[at(Triangulation::edge(h[k]))];
		const long double s = (l[0] + l[1] + l[2]) / 2;
		if (!(std::max({l[0], l[1], l[2]}) < s)) {
			++broken;
			continue;
		}
		long double sum = 0.0L, cotangents = 0.0L;
		for (std::size_t k = 0; k < 3; ++k) {
			// Half the angle between sides k and k - 1, opposite side k + 1.
			const long double opposite = l[(k + 1) % 3];
			const long double tangent = std::sqrt(
				std::sinh(s - l[k]) * std::sinh(s - l[(k + 2) % 3]) /
				(std::sinh(s) * std::sinh(s - opposite)));
			curvature[at(t.origin(h[k]))] -= 2 * std::atan(tangent);
			sum += 2 * std::atan(tangent);
			cotangents += 1 / tangent + tangent;
		}
		area += kExtendedPi - sum;
		// The flat triangle's bound, times what a length adds in the hyperbolic plane.
		for (int side : h)
			sensitivity[at(t.origin(side))] += 2 * cotangents * (1 + s) * std::cosh(s);
	}
}

IndependentError::IndependentError(const FlippedFlow& flow)
{
	if (flow.background == Background::HyperbolicPlane)
		compare<HyperbolicMeasure>(flow);
	else
		compare<MetricMeasure>(flow);
}

template<class Measure>
void IndependentError::compare(const FlippedFlow& flow)
{
	const Triangulation& t = flow.result.metric->triangulation();
	const Measure measure(t, flow.result.metric->lengths());
	for (int v = 0; v < flow.base.vertexCount(); ++v) {
		if (flow.result.target.fixed[at(v)])
			continue;
		long double k = measure.curvature[at(v)];
		if (flow.result.doubled && flow.topology.boundary[at(v)])
			k /= 2;
		const long double target = flow.result.target.curvature[v];
		error = std::max(error, static_cast<double>(std::abs(k - target)));
		rounding = std::max(rounding, static_cast<double>(measure.sensitivity[at(v)]));
	}
	rounding *= std::numeric_limits<double>::epsilon();
}

} // namespace ricci::testing
