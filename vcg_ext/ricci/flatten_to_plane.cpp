// SPDX-License-Identifier: GPL-3.0-or-later
#include "flatten.h"

#include "base/convex_hull.h"
#include "base/parallel.h"
#include "base/task.h"
#include "cones/make_seamless.h"
#include "cones/target_curvature.h"
#include "cut/cut_graph.h"
#include "cut/seam_cost.h"
#include "flatten_steps.h"
#include "flow/swapped_flow.h"
#include "hyperbolic/holonomy_check.h"
#include "measure/chart_check.h"
#include "measure/distortion.h"
#include "measure/invariants.h"
#include "measure/metric_check.h"
#include "mesh/flow_domain.h"
#include "optimize/finish.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ricci {

namespace {

/// Of the edges of a free boundary, relative: less is not worth a line.
constexpr double kKeptLength = 1e-3;

/// What the holes are to the flow. Short ones are boundaries where they cannot be closed without flips, and
/// where the target has values for the boundary that the surface has.
Holes holesOf(const Options& options)
{
	const bool mayCap = options.method == Method::IntrinsicFlips &&
						options.target != TargetCurvature::Flat &&
						options.target != TargetCurvature::Prescribed;
	return options.holes == Holes::ShortCapped && !mayCap ? Holes::Boundaries : options.holes;
}

/// What the target of a surface is chosen from, whose first vertices are the component's.
TargetRequest targetRequest(
	const Component& component,
	const VertexInput& input,
	const Options& options,
	const EmbeddedSurface& surface)
{
	TargetRequest request;
	static_cast<TargetInput&>(request) = targetInput(component, input, surface.positions.size());
	request.options = options;
	request.measuresAreas = options.method == Method::IntrinsicFlips;
	request.hasSeam = component.hasSeam;
	request.vertexNumbers = component.vertex;
	return request;
}

/// The cut through the cones.
void cutOpen(
	const FlowDomain& domain, VertexArray<char> cones, const Options& options, ComponentMap& map)
{
	const EmbeddedSurface& surface = domain.surface;
	map.cones = std::move(cones);
	map.cut = cutDomain(
		domain,
		seamCost(surface.triangulation, surface.lengths, surface.positions, options.seamHiding),
		map.cones);
}

/// Scales the layout by \p scale and turns it so that its smallest bounding rectangle lies along the
/// axes, from the origin.
void turnUpright(double scale, ComponentMap& map)
{
	const OrientedRectangle r = minAreaRectangle(map.layout.points.values());
	const auto move = [&](Point2& p) {
		const Point2 q = r.inFrame(p);
		p = {scale * (q[0] - r.min[0]), scale * (q[1] - r.min[1])};
	};
	for (Point2& p : map.layout.points)
		move(p);
	for (Point2& p : map.mesh.place)
		move(p);
}

/// The modulus of a flat torus or annulus and the aspect of a rectangle, where the map is one.
/// \param t the triangulation of the layout
void conformalInvariants(const Triangulation& t, ComponentMap& map)
{
	const Target& target = map.flow.target;
	const bool flat = target.curvature.lpNorm<Eigen::Infinity>() == 0.0;
	if (map.type.isTorus() && flat) {
		const std::complex<double> tau = torusModulus(t, map.layout, map.cut);
		map.report.torusTauRe = tau.real();
		map.report.torusTauIm = tau.imag();
	}
	// A large epsilon can stop the flow where the metric closes round a hole, without a seam.
	if (map.type.isAnnulus() && flat && !target.hasFixed() && map.cut.edgeCount > 0)
		map.report.annulusModulus =
			annulusModulus(t, map.layout, map.cut, map.scale * map.scale * map.flow.area);
	if (target.corners)
		map.report.rectangleAspect = rectangleAspect(t, map.layout, *target.corners);
}

/// The flow with edge swaps (5.4), and the domain that it leaves.
void flowWithEdgeSwaps(
	const Component& component,
	const VertexInput& input,
	const Options& options,
	FlowDomain& domain,
	ComponentMap& map)
{
	const auto choose = [&](const EmbeddedSurface& surface, InitialPacking& start) {
		Target target =
			chooseTarget(surface, start, targetRequest(component, input, options, surface));
		if (map.report.flowStates.empty())
			noteTarget(target, map);
		return target;
	};
	advance(0.0, "Solving for the metric");
	const Task part(kBeforeFlow, 1.0 - kAfterFlow);
	SwappedFlow swapped = flowWithEdgeSwaps(component, options, choose, map.report.flowStates);
	domain = std::move(swapped.domain);
	map.flow = std::move(swapped.flow);
	map.report.edgeSwaps = swapped.swaps;
	map.report.boundarySplits = swapped.splits;
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
		return attempt("the metric before it stays", [&] {
			return runFlow(surface, initialPacking(surface, options), target, options, map);
		});
	};
	map.report.iterations = makeSeamless(surface, request, options.epsilon, flowTo, map.flow);
}

/// Area in the flow's metric of the triangles that are given back, without caps.
double areaInPlane(const FlowDomain& domain, const ComponentMap& map)
{
	if (domain.holes == 0)
		return map.flow.area;
	double area = 0.0;
	for (const Triangle2& p :
		 map.mesh.size() > 0 ? map.mesh.corners() : cornersOf(domain, map.layout))
		area += 0.5 * doubledArea(p);
	return area;
}

/// Lays the component out in the plane, upright and with its area unless the boundary keeps its metric. Drops
/// seams from the cut round which the metric closes.
void layOut(
	const Component& component,
	const FlowDomain& domain,
	OverlayPieces overlay,
	const Options& options,
	ComponentMap& map)
{
	advance(1.0 - kAfterFlow, "Laying out the triangles");
	const Triangulation& t = domain.surface.triangulation;
	const bool mayChangeCut = map.type.boundaryLoops - domain.holes > 1;
	map.layout = placeCorners(domain, std::move(overlay), options, map).corners;
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
			map.layout =
				placeCorners(domain, flowOverlay(domain, options, map), options, map).corners;
	}
	if (!map.flow.target.hasFixed()) // else the boundary keeps its metric, which fixes the scale
		map.scale = std::sqrt(
			surfaceArea(component.positions.values(), component.triangles) /
			areaInPlane(domain, map));
	turnUpright(map.scale, map);
	map.report.seamLength = lengthOf(map.cut, domain.surface.lengths);
	conformalInvariants(t, map);
}

/// The finish that is asked for, or LeastDistortion where that would lose what the map has to keep.
Finish finishOf(const Options& options, const ComponentMap& map)
{
	const bool isPrescribed = options.cones.rounding == ConeRounding::QuarterTurns ||
							  (map.type.boundaryLoops > 0 && !map.flow.target.hasFixed());
	if (options.finish != Finish::LeastStretch || !isPrescribed)
		return options.finish;
	logLine("The boundary or the turns across seams are prescribed: least distortion, not least "
			"stretch.");
	return Finish::LeastDistortion;
}

/// The finish of what is given back. The invariants are those of the flow's own layout.
void finish(const FlowDomain& domain, const Options& options, ComponentMap& map)
{
	if (!isFinished(options) || isRefined(options))
		return; // the refinement is exact
	advance(1.0 - kAfterFlow, "Repairing the map");
	const Finish finish = finishOf(options, map);
	FlatMesh flat = flatMeshOf(domain.surface, map.layout);
	const FinishCounts counts = finishInPlane(
		flat, map.cones, map.flow.target.hasFixed(), domain.onHole, finish, mayCutCharts(options));
	map.report.finishMoved = counts.moved;
	map.report.endedEarly += counts.endedEarly;
	map.hasFreeSeams = finish == Finish::LeastStretch;
	flat.place.swap(map.layout.points);
	if (map.layout.points != flat.place) // its border may have moved
		turnUpright(1.0, map);
}

/// How the lengths of a free boundary compare in the map and on the mesh, and how far turns across seams are
/// from multiples of a right angle, where they should be such.
void measureBorders(const EmbeddedSurface& surface, const Options& options, ComponentMap& map)
{
	if (options.cones.rounding == ConeRounding::QuarterTurns)
		map.report.holonomyError =
			holonomyError(surface.triangulation, map.layout, map.cut.isCut, map.cones);
	if (!map.flow.target.hasFixed())
		return;
	const Triangulation& t = surface.triangulation;
	double least = std::numeric_limits<double>::infinity(), most = 0.0;
	for (const Halfedge h : t.exteriorHalfedges()) {
		const Halfedge side = h.twin();
		const double before = surface.lengths[h.edge()];
		if (!(before > 0.0))
			continue;
		const Point2 along = map.layout[t.next(side)] - map.layout[side];
		const double ratio = std::hypot(along[0], along[1]) / before;
		least = std::min(least, ratio);
		most = std::max(most, ratio);
	}
	if (!(most > 0.0))
		return;
	map.report.boundaryRatioMin = least;
	map.report.boundaryRatioMax = most;
	if (std::max(most - 1.0, 1.0 - least) > kKeptLength)
		logLine(
			"Free boundary: in the map its edges are " + numberText(least, 3) + " to " +
			numberText(most, 3) + " times as long as on the mesh.");
}

} // namespace

std::optional<ComponentMap> flattenToPlane(
	const Component& component,
	const VertexInput& input,
	const Options& options,
	const std::function<double(double)>& alternative)
{
	const int threads = threadsFor(static_cast<std::int64_t>(component.triangles.size()));
	ComponentMap map;
	FlowDomain domain;
	InitialPacking start;
	double other = kNoAlternative;
	std::vector<std::string> linesOfOther;
	besides(
		threads,
		[&] {
			advance(0.0, "Circle packing");
			domain = flowDomain(component, holesOf(options));
			describe(component, domain, map);
			if (options.method != Method::EdgeSwaps)
				start = initialPacking(domain.solved(), options); // 4.1
		},
		[&] {
			Task still(0.0, 0.0);
			still.keepLines(linesOfOther);
			other = alternative(0.0);
		});
	logLines(linesOfOther);
	TargetRequest request = targetRequest(component, input, options, domain.solved());
	request.alternative = other;
	if (options.method == Method::EdgeSwaps)
		flowWithEdgeSwaps(component, input, options, domain, map); // 5.4
	else {
		advance(0.0, "Choosing the target");
		const Target target = chooseTarget(domain.solved(), start, request); // 5.2, 5.3
		if (target.expected) {
			const Task inPlaceOfFlow(kBeforeFlow, 1.0 - kAfterFlow);
			const double cost = target.expected->total();
			if (cost > alternative(cost))
				return std::nullopt;
		}
		besides(
			threads,
			[&] { // 4.2
				map.flow = runFlow(domain.solved(), std::move(start), target, options, map);
			},
			[&] { // 4.3
				cutOpen(domain, conesOf(domain.surface, target, domain.onHole), options, map);
			});
	}
	keepAreas(domain.solved(), request, options, map);
	makeSeamless(domain.solved(), request, options, map);
	logFlow(map.flow, options);
	if (auto cones = conesOf(domain.surface, map.flow.target, domain.onHole); !(cones == map.cones))
		cutOpen(domain, std::move(cones), options, map);
	besides(
		threads,
		[&] {
			layOut(component, domain, flowOverlay(domain, options, map), options, map); // 4.3
			finish(domain, options, map);
		},
		[&] {
			measurePeriods(map);
			requireMetric(map.flow, domain.solved().topology.boundary);
		});
	measureBorders(domain.surface, options, map);
	advance(1.0, "Checking the result");
	if (!isRefined(options))
		map.mesh = flatMesh(component, domain, map.layout);
	requireMap(map.mesh, map.flow, mayBeFlipped(map, options.output), !map.hasFreeSeams);
	return map;
}

} // namespace ricci
