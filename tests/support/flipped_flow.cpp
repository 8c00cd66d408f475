// SPDX-License-Identifier: GPL-3.0-or-later
#include "flipped_flow.h"

#include "intrinsic.h"
#include "shapes.h"

#include <ricci/metric/circle_packing.h>
#include <ricci/surface/double_surface.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ricci::testing {

namespace {

constexpr double kPi = 3.14159265358979323846;

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

void FlippedFlow::run(TargetRequest request, double epsilon)
{
	topology = topologyOf(base);
	const auto vertexCount = at(base.vertexCount());
	request.selected.resize(vertexCount, 0);
	request.prescribed.resize(vertexCount, 0.0);
	if (request.prescribedPrecision == 0.0)
		request.prescribedPrecision = std::numeric_limits<double>::epsilon();
	const Target target = chooseTarget(base, topology, lengths, mesh.positions, request);
	Options options;
	options.surgery = Surgery::IntrinsicFlips;
	options.epsilon = epsilon;
	result = runRicciFlow(
		Background::EuclideanPlane,
		base,
		lengths,
		mesh.positions,
		target,
		topology.loops.empty() ? std::vector<int>() : topology.loops.front(),
		options,
		[](int, double) {});
}

CutGraph FlippedFlow::cut() const
{
	std::vector<char> cones(at(base.vertexCount()), 0);
	for (std::size_t v = 0; v < cones.size(); ++v)
		cones[v] = !topology.boundary[v] &&
				   std::abs(result.target.curvature[static_cast<Eigen::Index>(v)]) > kCone;
	return cutToDisk(base, lengths, cones, {});
}

CommonRefinement FlippedFlow::refinement(const CutGraph& cutGraph) const
{
	const FlipHistory& history = result.history;
	FlippedSurface surface;
	surface.input = &history.input;
	surface.startFlips = &history.startFlips;
	surface.start = &history.start.triangulation;
	surface.startLengths = &history.start.lengths;
	surface.startDelta = &history.startDelta;
	surface.startRadii = &history.startRadii;
	surface.flowFlips = &history.flowFlips;
	surface.end = &result.metric->triangulation();
	surface.endLengths = &result.metric->lengths();
	surface.endAngles = &result.metric->angles();
	surface.endU = &result.u;
	surface.keptFaces = base.faceCount();
	std::vector<char> isCut = cutGraph.isCut;
	for (int e = 0; e < base.edgeCount(); ++e)
		if (result.doubled && base.isBoundaryEdge(e))
			isCut[at(e)] = 1;
	isCut.resize(at(history.input.edgeCount()), 0);
	return commonRefinement(surface, mesh.positions, isCut);
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

IndependentError::IndependentError(const FlippedFlow& flow)
{
	const Triangulation& t = flow.result.metric->triangulation();
	const MetricMeasure measure(t, flow.result.metric->lengths());
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
