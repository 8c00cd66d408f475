// SPDX-License-Identifier: GPL-3.0-or-later
#include "flatten.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "base/task.h"
#include "cut/cut_graph.h"
#include "flatten_steps.h"
#include "hyperbolic/holonomy_check.h"
#include "hyperbolic/hyperbolic_target.h"
#include "layout/hyperbolic_layout.h"
#include "measure/chart_check.h"
#include "measure/metric_check.h"
#include "mesh/flow_domain.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci {

namespace {

/// Hyperbolic distance from the centre of the disk beyond which a map is cut anew: a triangle of a
/// fiftieth there is as small as a step of floats.
constexpr double kWideRadius = 12.0;

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

/// Lays the component out in the disk, with a longer cut if floats cannot hold the first one, and finds its
/// group.
void layOut(
	const FlowDomain& domain,
	OverlayPieces overlay,
	const HyperbolicOptions& options,
	ComponentMap& map)
{
	advance(1.0 - kAfterFlow, "Laying out the triangles");
	const Triangulation& t = domain.surface.triangulation;
	SurfaceLayout disk = placeCorners(domain, std::move(overlay), options, map);
	if (const double radius = radiusOf(disk.corners); radius > kWideRadius) {
		map.cut = cutAroundCentre(t, cutCost(domain, map.flow, options.method), map.cones);
		disk = placeCorners(domain, flowOverlay(domain, options, map), options, map);
		logLine(
			"The short seams lead " + numberText(radius, 3) +
			" out in the disk, too far for floats. Longer ones around the middle lead " +
			numberText(radiusOf(disk.corners), 3) + " out.");
	}
	disk.pairing = pairingOfArcs(t, map.cut, disk.pairing, map.cones);
	map.report.relationError = holonomyError(t, map.cut, disk, map.cones, map.flow.target);
	advance(1.0 - kAfterFlow, "Canonical generators");
	map.group = fuchsianGroup(t, map.cut, disk.pairing, map.cones, options.canonicalGenerators);
	map.layout = std::move(disk.corners);
	if (options.canonicalGenerators && !map.group.isCanonical())
		logLine(
			"There are no canonical generators: they would move points farther than floating point "
			"numbers can tell.");
}

} // namespace

ComponentMap flattenToDisk(
	const Component& component, const VertexInput& input, const HyperbolicOptions& options)
{
	ComponentMap map;
	advance(0.0, "Circle packing");
	const FlowDomain domain = flowDomain(component, Holes::Boundaries);
	describe(component, domain, map);
	InitialPacking start = initialPacking(domain.solved(), options); // 4.1
	advance(0.0, "Choosing the target");
	const TargetInput values = targetInput(component, input, component.vertex.size());
	const Target target =
		chooseHyperbolicTarget(domain.surface.topology, options, values);        // 5.2, 5.3
	map.flow = runFlow(domain.solved(), std::move(start), target, options, map); // 4.2
	logFlow(map.flow, options);

	map.cones = conesOf(domain.surface, map.flow.target);
	const int threads = threadsFor(domain.surface.triangulation.faceCount());
	OverlayPieces overlay;
	besides(
		threads,
		[&] { overlay = flowOverlay(domain, options, map); },
		[&] { // 4.3
			map.cut = cutDomain(domain, cutCost(domain, map.flow, options.method), map.cones);
		});
	besides(
		threads,
		[&] { layOut(domain, std::move(overlay), options, map); }, // 4.3
		[&] {
			measurePeriods(map);
			requireMetric(map.flow, domain.solved().topology.boundary);
		});
	map.report.seamLength = lengthOf(map.cut, domain.surface.lengths);
	map.report.hyperbolicArea = map.flow.area;

	advance(1.0, "Checking the result");
	if (!isRefined(options))
		map.mesh = flatMesh(component, domain, map.layout);
	requireDisk(map.mesh, map.flow, mayBeFlipped(map, options.output));
	return map;
}

} // namespace ricci
