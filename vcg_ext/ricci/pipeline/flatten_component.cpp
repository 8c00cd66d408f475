// SPDX-License-Identifier: GPL-3.0-or-later
#include "flatten_component.h"

#include "../base/attempt.h"
#include "../base/parallel.h"
#include "../base/task.h"
#include "../base/text.h"
#include "../curvature/hyperbolic_target.h"
#include "../curvature/target_curvature.h"
#include "../cut/cut_graph.h"
#include "../finish/finish.h"
#include "../layout/corner_layout.h"
#include "../layout/hyperbolic_layout.h"
#include "../measure/distortion.h"
#include "../measure/invariants.h"
#include "../seamless/make_seamless.h"
#include "../surface/flow_domain.h"
#include "../verify/flow_check.h"
#include "../verify/holonomy_check.h"
#include "../verify/result_check.h"
#include "keep_areas.h"
#include "stages.h"
#include "whole_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci {

namespace {

/// Hyperbolic distance from the centre of the disk beyond which a map is cut anew: a triangle of a
/// fiftieth there is as small as a step of floats.
constexpr double kWideRadius = 12.0;

// What differs by geometry.

Holes holesOf(const Options& options)
{
	return options.holes;
}

Holes holesOf(const HyperbolicOptions&)
{
	return Holes::Boundaries;
}

TargetRequest targetRequest(
	const FlowDomain& domain,
	const Component& component,
	const VertexInput& input,
	const Options& options)
{
	TargetRequest request =
		targetRequest(component, input, options, domain.solved().positions.size());
	return request;
}

TargetInput targetRequest(
	const FlowDomain&,
	const Component& component,
	const VertexInput& input,
	const HyperbolicOptions&)
{
	return targetInput(component, input, component.vertex.size());
}

Target chooseTarget(
	const FlowDomain& domain,
	const InitialPacking& start,
	const TargetRequest& request,
	const Options&)
{
	return chooseTarget(domain.solved(), start, request);
}

Target chooseTarget(
	const FlowDomain& domain,
	const InitialPacking&,
	const TargetInput& input,
	const HyperbolicOptions& options)
{
	return chooseHyperbolicTarget(domain.surface.topology, options, input);
}

/// Neither areas nor seamless maps play a part in the hyperbolic plane.
void keepAreas(const EmbeddedSurface&, const TargetInput&, const HyperbolicOptions&, ComponentMap&)
{
}

/// makeSeamless() as the options say.
void makeSeamless(
	const EmbeddedSurface& surface,
	const TargetRequest& request,
	const Options& options,
	ComponentMap& map)
{
	if (options.method != Method::IntrinsicFlips)
		return;
	const FlowTo flowTo = [&](const Target& target) {
		return attempt([&] {
			return flowAgain(surface, initialPacking(surface, options), target, options, map);
		});
	};
	const HolonomyRounding done = makeSeamless(surface, request, options.epsilon, flowTo, map.flow);
	if (done.before > 0.0)
		logLine(
			"The rotations across seams are up to " + numberText(done.before, 3) +
			" from a multiple of a quarter turn, and " + numberText(done.after, 3) +
			" once the metric has changed.");
}

void makeSeamless(
	const EmbeddedSurface&, const TargetInput&, const HyperbolicOptions&, ComponentMap&)
{
}

/// What a seam along each edge costs.
EdgeArray<double> cutCost(const FlowDomain& domain, const FlowResult&, const Options& options)
{
	return seamCost(
		domain.surface.triangulation,
		domain.surface.lengths,
		domain.surface.positions,
		options.seamHiding);
}

EdgeArray<double>
cutCost(const FlowDomain& domain, const FlowResult& flow, const HyperbolicOptions& options)
{
	return options.method == Method::IntrinsicFlips ? hyperbolicLengths(flow, domain.surface)
													: flow.metric->lengths();
}

/// Angles at cones, which bound the width of wedges in the plane (see shortenCut()). In the disk wedges
/// may be as wide as they like.
HalfedgeArray<double> cutCorners(const FlowDomain& domain, const ComponentMap& map, const Options&)
{
	return cornersOfCones(domain.surface, map.flow.target, map.cones);
}

HalfedgeArray<double> cutCorners(const FlowDomain&, const ComponentMap&, const HyperbolicOptions&)
{
	return {};
}

/// The layout of the corners of the component, open along the cut.
void placeCorners(
	const FlowDomain& domain, LinkedPieces overlay, const Options& options, ComponentMap& map)
{
	if (drawsPieces(options)) {
		map.refinement = refine(domain, map, std::move(overlay));
		map.layout = std::move(map.refinement.inputLayout);
	}
	else
		map.layout = layOutCorners(domain, map.flow, map.cut.isCut);
}

/// Area in the flow's metric of the triangles that are given back, without caps.
double areaInPlane(const FlowDomain& domain, const ComponentMap& map)
{
	if (domain.holes == 0)
		return map.flow.area;
	double area = 0.0;
	for (const Triangle2& p : map.refinement.uv)
		area += 0.5 * doubledArea(p[0], p[1], p[2]);
	if (map.refinement.uv.empty())
		for (const Triangle2& p : cornersOf(domain.surface.triangulation, map.layout))
			area += 0.5 * doubledArea(p[0], p[1], p[2]);
	return area;
}

void layOut(
	const Component& component,
	const FlowDomain& domain,
	LinkedPieces overlay,
	const Options& options,
	ComponentMap& map)
{
	const Triangulation& t = domain.surface.triangulation;
	const bool mayChangeCut = map.type.boundaryLoops > 1 && domain.holes == 0;
	placeCorners(domain, std::move(overlay), options, map);
	if (mayChangeCut) {
		// A hole round which the metric closes needs no seam.
		const int edges = map.cut.edgeCount;
		dropSeamsToHoles(
			t,
			domain.surface.lengths,
			loopsThatClose(t, map.layout, map.cut.isCut),
			map.cones,
			map.cut);
		if (map.cut.edgeCount < edges)
			placeCorners(domain, flowOverlay(domain, options, map), options, map);
	}
	if (!map.flow.target.hasFixed()) // else the boundary keeps its metric, which fixes the scale
		map.scale = std::sqrt(
			surfaceArea(component.positions.values(), component.triangles) /
			areaInPlane(domain, map));
	turnUpright(map.scale, map);
	map.uv = cornersOf(t, map.layout);
}

/// The layout of the corners in the disk, open along the cut.
/// \return what continues it across the edges of the cut
EdgeArray<SidePairing> placeInDisk(
	const FlowDomain& domain,
	LinkedPieces overlay,
	const HyperbolicOptions& options,
	ComponentMap& map)
{
	if (drawsPieces(options)) {
		map.refinement = refine(domain, map, std::move(overlay));
		map.layout = std::move(map.refinement.inputLayout);
		return std::move(map.refinement.pairing);
	}
	DiskLayout disk = layOutCornersInDisk(domain, map.flow, map.cut.isCut);
	map.layout = std::move(disk.corners);
	return std::move(disk.pairing);
}

/// Farthest point of a layout from the centre of the disk, in the hyperbolic metric.
double radiusOf(const PlanarLayout& layout)
{
	double r = 0.0;
	for (const Point2& p : layout.points)
		r = std::max(r, std::hypot(p[0], p[1]));
	return 2.0 * std::atanh(std::min(1.0, r));
}

void layOut(
	const Component&,
	const FlowDomain& domain,
	LinkedPieces overlay,
	const HyperbolicOptions& options,
	ComponentMap& map)
{
	const Triangulation& t = domain.surface.triangulation;
	EdgeArray<SidePairing> pairing = placeInDisk(domain, std::move(overlay), options, map);
	if (const double radius = radiusOf(map.layout); radius > kWideRadius) {
		map.cut = cutAroundCentre(t, cutCost(domain, map.flow, options), map.cones);
		pairing = placeInDisk(domain, flowOverlay(domain, options, map), options, map);
		logLine(
			"The short seams lead " + numberText(radius, 3) +
			" out in the disk, too far for floats. Longer ones around the middle lead " +
			numberText(radiusOf(map.layout), 3) + " out.");
	}
	map.uv = cornersOf(t, map.layout);
	pairing = pairingOfArcs(t, map.cut, pairing, map.cones);
	map.relationError = holonomyError(
		t, map.cut, pairing, map.layout, domain.surface.topology, map.cones, map.flow.target);
	advance(1.0 - kAfterFlow, "Canonical generators");
	map.group = fuchsianGroup(t, map.cut, pairing, map.cones, options.canonicalGenerators);
	if (options.canonicalGenerators && !map.group.isCanonical())
		logLine(
			"There are no canonical generators: they would move points farther than floating point "
			"numbers can tell.");
}

void measureInvariants(const FlowDomain& domain, const Options&, ComponentMap& map)
{
	conformalInvariants(domain.surface.triangulation, map);
}

void measureInvariants(const FlowDomain&, const HyperbolicOptions&, ComponentMap& map)
{
	map.hyperbolicArea = map.flow.area;
}

/// The finish of what is given back. The invariants are those of the flow's own layout.
void finish(const FlowDomain& domain, const Options& options, ComponentMap& map)
{
	if (!isFinished(options) || options.output == OutputTriangulation::CommonRefinement)
		return; // the refinement is exact
	FlatMesh flat = flatMeshOf(domain.surface, map.layout);
	map.finishMoved =
		finishInPlane(flat, map.cones, map.flow.target.hasFixed(), domain.onHole, options.finish)
			.moved;
	flat.place.swap(map.layout.points);
	if (map.layout.points != flat.place) // its border may have moved
		turnUpright(1.0, map);
	map.uv = cornersOf(domain.surface.triangulation, map.layout);
}

void finish(const FlowDomain& domain, const HyperbolicOptions& options, ComponentMap& map)
{
	if (!isFinished(options))
		return;
	const bool freeBoundary = map.flow.target.hasFixed();
	const bool refined = options.output == OutputTriangulation::CommonRefinement;
	FlatMesh flat = refined ? flatMeshOf(domain.surface, map.refinement)
							: flatMeshOf(domain.surface, map.layout);
	map.finishMoved = finishInDisk(flat, freeBoundary).moved;
	if (refined) {
		for (const int f : flat.points.indices())
			map.refinement.uv[positionOf(f)] = flat.at(f);
		return;
	}
	map.layout.points = std::move(flat.place);
	map.uv = cornersOf(domain.surface.triangulation, map.layout);
}

/// How far the seams of what is given back are from rotations by quarter turns.
void measureHolonomy(const FlowDomain& domain, const Options& options, ComponentMap& map)
{
	if (options.cones.rounding == ConeRounding::QuarterTurns)
		map.holonomyError =
			holonomyError(domain.surface.triangulation, map.layout, map.cut.isCut, map.cones);
}

void measureHolonomy(const FlowDomain&, const HyperbolicOptions&, ComponentMap&)
{
}

/// Whether straight triangles may be turned round in the flow's metric.
template<class AnyOptions>
bool mayBeTurned(const AnyOptions& options, const ComponentMap& map)
{
	return isBent(map, options.output) || map.finishMoved > 0;
}

void requireLayout(const Options& options, const ComponentMap& map)
{
	requireMap(map.mesh, map.flow, mayBeTurned(options, map));
}

void requireLayout(const HyperbolicOptions& options, const ComponentMap& map)
{
	requireDisk(map.mesh, map.flow, mayBeTurned(options, map));
}

template<class AnyOptions>
ComponentMap
flatten(const Component& component, const VertexInput& input, const AnyOptions& options)
{
	ComponentMap map;
	advance(0.0, "Circle packing");
	const FlowDomain domain = flowDomain(component, holesOf(options));
	map.type = domain.surface.topology.type;
	map.cappedHoles = domain.holes;
	logLine(description(component, map.type));
	advance(0.0, "Flipping edges");
	InitialPacking start = initialPacking(domain.solved(), options);
	advance(0.0, "Choosing the target");
	const auto request = targetRequest(domain, component, input, options);
	const Target target = chooseTarget(domain, start, request, options);
	for (const std::string& note : target.notes)
		logLine(note);
	FlowProgress flowProgress(options.epsilon, map.flowStates);
	advance(0.0, "Solving for the metric");
	map.flow = runRicciFlow(domain.solved(), std::move(start), target, options, flowProgress);
	measurePeriods(map);
	keepAreas(domain.solved(), request, options, map);
	makeSeamless(domain.solved(), request, options, map);
	logFlow(map.flow, options);

	advance(1.0 - kAfterFlow, "Cutting and layout");
	map.cones = conesOf(domain.surface, map.flow.target, domain.onHole);
	advance(1.0 - kAfterFlow, "Shortening the seams");
	EdgeArray<double> cost = cutCost(domain, map.flow, options);
	avoidDiagonals(domain.isDiagonal, cost);
	const HalfedgeArray<double> corners = cutCorners(domain, map, options);
	const int threads = threadsFor(domain.surface.triangulation.faceCount());
	LinkedPieces overlay;
	besides(
		threads,
		[&] { overlay = flowOverlay(domain, options, map); },
		[&]() { map.cut = cutThroughCones(domain, cost, map.cones, corners); });
	advance(1.0 - kAfterFlow, "Cutting and layout");
	layOut(component, domain, std::move(overlay), options, map);
	map.seamLength = lengthOf(map.cut, domain.surface.lengths);
	measureInvariants(domain, options, map);
	advance(1.0 - kAfterFlow, "Repairing the map");
	besides(
		threads,
		[&] { finish(domain, options, map); },
		[&]() { requireMetric(map.flow, domain.solved().topology.boundary); });

	measureHolonomy(domain, options, map);

	advance(1.0, "Checking the result");
	map.mesh = flatMesh(component, map, options.output);
	requireLayout(options, map);
	return map;
}

} // namespace

ComponentMap
flattenComponent(const Component& component, const VertexInput& input, const Options& options)
{
	return options.method == Method::EdgeSwaps ? flattenWithEdgeSwaps(component, input, options)
											   : flatten(component, input, options);
}

ComponentMap flattenComponent(
	const Component& component, const VertexInput& input, const HyperbolicOptions& options)
{
	return flatten(component, input, options);
}

} // namespace ricci
