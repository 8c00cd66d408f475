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
	OverlayPieces overlay,
	const HyperbolicOptions& options,
	const FlowResult& flow,
	CutGraph& cut)
{
	advance(1.0 - kAfterFlow, "Laying out the triangles");
	const Triangulation& t = domain.surface.triangulation;
	SurfaceLayout layout = layOutSurface(domain, std::move(overlay), options, flow, cut.isCut);
	if (const double radius = radiusOf(layout.corners); radius > kMaxTileDistance) {
		cut = cutAroundCentre(t, cutCost(domain, flow, options.method), std::move(cut.cones));
		layout =
			layOutSurface(domain, flowOverlay(domain, options, flow), options, flow, cut.isCut);
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

	const int threads = threadsFor(domain.surface.triangulation.faceCount());
	OverlayPieces overlay;
	CutGraph cut;
	besides(
		threads,
		[&] { overlay = flowOverlay(domain, options, flow); },
		[&] { // 4.3
			cut = cutDomain(
				domain,
				cutCost(domain, flow, options.method),
				conesOf(domain.surface, flow.target));
		});
	SurfaceLayout layout;
	double relationError = 0.0;
	FuchsianGroup group;
	InvariantReport invariants;
	besides(
		threads,
		[&] {
			const Triangulation& t = domain.surface.triangulation;
			layout = layOut(domain, std::move(overlay), options, flow, cut); // 4.3
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
