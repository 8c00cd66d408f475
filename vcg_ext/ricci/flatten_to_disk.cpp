// SPDX-License-Identifier: GPL-3.0-or-later
#include "flatten.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "base/task.h"
#include "base/tolerances.h"
#include "cut/cut_graph.h"
#include "flatten_steps.h"
#include "hyperbolic/group_of_cut.h"
#include "measure/map_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci {

namespace {

/// What a seam along each edge costs: its length in the metric of the flow.
EdgeArray<double> cutCost(const FlowDomain& domain, const FlowResult& flow, Method method)
{
	return method == Method::IntrinsicFlips ? hyperbolicLengths(flow, domain.surface)
											: flow.metric->lengths();
}

/// Farthest point of a layout from the centre of the disk, in the hyperbolic metric.
double radiusOf(const PlanarLayout& layout)
{
	double r = 0.0;
	for (const Point2& p : layout.points)
		r = std::max(r, length(p));
	return 2.0 * std::atanh(std::min(1.0, r));
}

/// Lays the component out in the disk, with a longer cut if floats cannot hold the first one.
SurfaceLayout layOut(
	const FlowDomain& domain,
	const HyperbolicOptions& options,
	const FlowResult& flow,
	CutGraph& cut)
{
	const Triangulation& t = domain.surface.triangulation;
	SurfaceLayout layout = layOutSurface(domain, options, flow, cut.isCut);
	if (const double radius = radiusOf(layout.corners); radius > kMaxTileDistance) {
		cut = cutAroundCentre(t, cutCost(domain, flow, options.method), std::move(cut.cones));
		layout = layOutSurface(domain, options, flow, cut.isCut);
		logLine(
			"The short seams reach " + numberText(radius, 3) +
			" out in the disk, too far for floats. Longer seams around the centre reach " +
			numberText(radiusOf(layout.corners), 3) + " out.");
	}
	layout.pairing = pairingOfArcs(t, cut, layout.pairing);
	return layout;
}

} // namespace

Parametrization flattenToDisk(
	const Component& component, const VertexInput& input, const HyperbolicOptions& options)
{
	advance(0.0, "Circle packing");
	const FlowDomain domain = flowDomain(component, Holes::Boundaries);
	const SurfaceType& type = domain.surface.topology.type;
	logComponent(component, type);
	InitialPacking start = initialPacking(domain.solved(), options); // 4.1
	advance(0.0, "Choosing the target");
	const VertexInput values = inputOf(component, input, component.vertex.size());
	const Target target =
		chooseHyperbolicTarget(domain.surface.topology, options, values); // 5.2, 5.3
	FlowLog log;
	const FlowResult flow = runFlow(domain.solved(), std::move(start), target, options, log); // 4.2
	logFlow(flow, options);

	CutGraph cut = cutDomain( // 4.3
		domain,
		cutCost(domain, flow, options.method),
		conesOf(domain.surface, flow.target));
	SurfaceLayout layout;
	double relationError = 0.0;
	FuchsianGroup group;
	InvariantReport invariants;
	besides(
		threadsFor(domain.surface.triangulation.faceCount()),
		[&] {
			const Triangulation& t = domain.surface.triangulation;
			layout = layOut(domain, options, flow, cut);
			relationError = closingError(t, cut, layout, flow.target);
			advance(1.0 - kAfterFlow, "Canonical generators");
			group = fuchsianGroup(t, cut, layout.pairing, options.canonicalGenerators);
			if (options.canonicalGenerators && !group.isCanonical())
				logLine("There are no canonical generators: they would move points farther than "
						"floating-point numbers can resolve.");
		},
		[&] {
			invariants = measurePeriods(type, flow);
			requireMetric(flow, domain.solved().topology.boundary);
		});
	invariants.hyperbolicArea = flow.area;
	invariants.relationError = relationError;

	advance(1.0, "Checking the result");
	const bool mayFlip = isBent(flow, options.output);
	Parametrization part = withoutMap(component, domain, flow, std::move(log), cut, 1.0);
	static_cast<InvariantReport&>(part.report) = std::move(invariants);
	part.charts.front().group = std::move(group);
	part.mesh = isRefined(options) ? std::move(layout.refinement)
								   : flatMeshOf(component, domain, layout.corners);
	requireDisk(part.mesh, flow, mayFlip);
	return part;
}

} // namespace ricci
