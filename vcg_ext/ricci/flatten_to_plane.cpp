// SPDX-License-Identifier: GPL-3.0-or-later
#include "flatten.h"

#include "base/convex_hull.h"
#include "base/numbers.h"
#include "base/parallel.h"
#include "base/task.h"
#include "cones/area_change.h"
#include "cones/seamless_metric.h"
#include "cut/cut_graph.h"
#include "flatten_steps.h"
#include "measure/distortion.h"
#include "measure/invariants.h"
#include "measure/map_check.h"
#include "optimize/least_distortion.h"
#include "optimize/repair.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

namespace ricci {

namespace {

/// What the holes are to the flow. Short ones are boundaries where they cannot be closed without flips, and
/// where the target has values for the boundary that the surface has.
Holes holesOf(const Options& options)
{
	const bool mayCap = options.method == Method::IntrinsicFlips &&
						options.target != TargetCurvature::Flat &&
						options.target != TargetCurvature::Prescribed;
	return options.holes == Holes::ShortCapped && !mayCap ? Holes::Boundaries : options.holes;
}

/// Flows after the first one where areas are to be kept so far, and those in a row that may bring nothing. Where the
/// map is to cost little, there is one: of some 60 meshes a second changed one, by 0.2 %.
constexpr int kMaxRounds = 6, kMaxVainRounds = 2;

/// Whether cones and seams are to be mirrored: where they are chosen for the least cost alone, which tells what that costs.
bool mayMirror(const Component& component, const TargetRequest& request)
{
	return request.goal.kind == ConeGoal::LeastCost && request.measuresAreas &&
		   request.rounding == ConeRounding::Free &&
		   (request.target == TargetCurvature::Automatic ||
			request.target == TargetCurvature::PlacedCones) &&
		   component.lengths.empty() && !component.hasSeam;
}

/// What the target of a component is chosen from.
TargetRequest targetRequest(
	const Component& component,
	const VertexInput& input,
	const Options& options,
	const FlowDomain& domain)
{
	TargetRequest request;
	static_cast<VertexInput&>(request) =
		inputOf(component, input, domain.solved().positions.size());
	request.target = options.target;
	request.goal = coneGoal(options.cones);
	request.rounding = options.cones.rounding;
	request.freeBoundary = options.freeBoundary;
	request.onlyWhereNeeded = options.cones.onlyWhereNeeded;
	request.measuresAreas =
		options.method == Method::IntrinsicFlips && !options.cones.onlyWhereNeeded;
	request.hasSeam = component.hasSeam;
	request.vertexNumbers = component.vertex;
	if (mayMirror(component, request))
		request.goal.mirror = findMirror(domain.surface, domain.onHole);
	return request;
}

/// The cut through the cones of a target, mirrored where the surface is its own mirror image and that is hardly longer.
CutGraph cutOpen(const FlowPlan& plan, VertexArray<char> cones, const Options& options)
{
	const EmbeddedSurface& surface = plan.domain.surface;
	return cutDomain(
		plan.domain,
		seamCost(surface.triangulation, surface.lengths, surface.positions, options.seamHiding),
		std::move(cones),
		plan.request.goal.mirror.get());
}

/// The flow with edge swaps (5.4), and the domain that it leaves.
FlowResult
flowWithEdgeSwaps(const Component& component, const Options& options, FlowPlan& plan, FlowLog& log)
{
	const auto choose = [&](const EmbeddedSurface& surface, InitialPacking& start) {
		const auto count = surface.positions.values().size(); // more where the boundary is split
		plan.request.selected.resize(count, 0);
		plan.request.targetCurvature.resize(count, 0.0);
		Target target = chooseTarget(surface, start, plan.request);
		if (log.states.empty())
			log.add(target);
		return target;
	};
	advance(0.0, "Solving for the metric");
	const Task part(kBeforeFlow, 1.0 - kAfterFlow);
	return flowWithEdgeSwaps(component, options, choose, plan.domain, log.states);
}

/// The promise of Target::expected: while a metric changes areas, or costs, more than its target was chosen for, runs
/// the flow again, to targetToKeepAreas(), in a bounded number of rounds.
/// \param best the first one
/// \return the metric that keeps areas best
/// \throw Stopped
FlowResult keepAreas(
	const EmbeddedSurface& surface,
	const TargetRequest& request,
	const Options& options,
	FlowResult best,
	FlowLog& log)
{
	std::unique_ptr<const FlowResult> last; // where it is not the best
	const auto propose = [&]() -> std::optional<FlowResult> {
		const FlowResult& before = last ? *last : best;
		if (keepsAreas(surface, before, request))
			return std::nullopt; // without the cost of another start
		auto next = attempt("the metric before it stays", [&]() -> std::optional<FlowResult> {
			InitialPacking start = initialPacking(surface, options);
			const auto target = targetToKeepAreas(surface, start, before, request);
			if (!target)
				return std::nullopt;
			return runFlow(surface, std::move(start), *target, options, log);
		});
		return next ? std::move(*next) : std::nullopt;
	};
	const auto take = [&](FlowResult next) {
		const bool isBest = areaCost(surface, next, request) <= areaCost(surface, best, request);
		last.reset();
		if (isBest)
			best = std::move(next);
		else
			last = std::make_unique<const FlowResult>(std::move(next));
		return isBest;
	};
	const bool isForCost = request.goal.kind == ConeGoal::LeastCost;
	const int round = improve(isForCost ? 1 : kMaxRounds, kMaxVainRounds, propose, take);
	if (!isForCost && round == kMaxRounds) {
		++log.endedEarly;
		logLine("The search for cones stopped at its limit of solves.");
	}
	if (round > 0) {
		const AreaChange change = areaChange(surface, flowFactor(best));
		logLine(
			"The spread of the logarithm of the area factor is " + numberText(change.spread, 3) +
			", the mean of the factor or its inverse " + numberText(change.mean, 3) +
			", the energy " + numberText(change.energy, 3) + ".");
	}
	return best;
}

/// Turns rotations across seams into quarter turns where they are asked for.
FlowResult makeSeamless(
	const EmbeddedSurface& surface,
	const TargetRequest& request,
	const Options& options,
	FlowResult flow,
	FlowLog& log)
{
	if (options.method != Method::IntrinsicFlips)
		return flow;
	const FlowTo flowTo = [&](const Target& target) {
		return attempt("the metric before it stays", [&] {
			return runFlow(surface, initialPacking(surface, options), target, options, log);
		});
	};
	log.roundingSteps = makeSeamless(surface, request, options.epsilon, flowTo, flow);
	return flow;
}

/// A component laid out in the plane.
struct PlaneMap
{
	FlatMesh mesh;      ///< of its own faces
	double scale = 1.0; ///< lengths in it over those of the flow's metric
	InvariantReport invariants;
	FlatMesh refinement; ///< where that is given back
	Repair finished;
	bool hasFreeSeams = false; ///< the finish has let seams go
};

/// Lays the component out in the plane, upright and with its area unless the boundary keeps its metric.
/// \param cut loses the seams round which the metric closes
PlaneMap layOut(
	const Component& component,
	const FlowDomain& domain,
	const Options& options,
	const FlowResult& flow,
	CutGraph& cut)
{
	const Triangulation& t = domain.surface.triangulation;
	SurfaceLayout layout = layOutSurface(domain, options, flow, cut.isCut);
	if (domain.surface.topology.type.boundaryLoops - domain.holes > 1) {
		// A hole round which the metric closes needs no seam.
		const int edges = cut.edgeCount();
		dropSeamsToHoles(t, loopsThatClose(t, layout.corners, cut.isCut), cut);
		if (cut.edgeCount() < edges)
			layout = layOutSurface(domain, options, flow, cut.isCut);
	}
	PlaneMap map;
	map.mesh = flatMeshOf(component, domain, layout.corners);
	map.refinement = std::move(layout.refinement);
	if (flow.target.circular)
		makeRound(map.mesh);
	if (!flow.target.hasFixed()) { // else the boundary keeps its metric, which fixes the scale
		double area = flow.area;   // of what is given back, without caps
		if (domain.holes > 0) {
			area = 0.0;
			const FlatMesh& given = isRefined(options) ? map.refinement : map.mesh;
			for (const int f : given.points.indices())
				area += 0.5 * doubledArea(given.at(f));
		}
		const std::vector<double> own =
			triangleAreas(component.positions.values(), component.triangles, component.lengths);
		map.scale = std::sqrt(std::accumulate(own.begin(), own.end(), 0.0) / area);
	}
	const OrientedRectangle upright = minAreaRectangle(layout.corners.points.values());
	for (Array<Point2>* points : {&layout.corners.points, &map.mesh.place, &map.refinement.place})
		moveUpright(upright, map.scale, *points);
	map.invariants = conformalInvariants(
		domain.surface, layout.corners, flow, cut, map.scale * map.scale * flow.area);
	return map;
}

/// The finish that is asked for, or LeastDistortion where that would lose what the map has to keep.
Finish finishOf(const FlowDomain& domain, const Options& options, const Target& target)
{
	const bool isPrescribed = options.cones.rounding == ConeRounding::QuarterTurns ||
							  (!domain.surface.topology.type.isClosed() && !target.hasFixed());
	if (options.finish != Finish::LeastStretch || !isPrescribed)
		return options.finish;
	logLine("The boundary or the turns across seams are prescribed: the finish is least distortion "
			"instead of least stretch.");
	return Finish::LeastDistortion;
}

/// The promise of Target::expected once more: where straight triangles cost more than their metric, lowers the energy,
/// at the cost of angles, with seams as they are. That lowers the objective of 22 of 79 meshes, most of them CAD, by 1 % in
/// the mean, and raises that of two.
void keepPromise(const Target& target, PlaneMap& map)
{
	const double broken = costOf(map.mesh, 0.0).energy;
	if (!target.expected || broken <= target.expected->energy + kBrokenPromise)
		return;
	const Array<Point2> before = map.mesh.place;
	const bool endedEarly =
		leastStretch(map.mesh, joinedPoints(map.mesh, [&](int) { return target.hasFixed(); }));
	const double kept = costOf(map.mesh, 0.0).energy;
	if (!(kept < broken)) { // because of triangles that stay flipped
		map.mesh.place = before;
		return;
	}
	map.finished.endedEarly += endedEarly;
	logLine(
		"Straight faces have the energy " + numberText(broken, 3) + ", not " +
		numberText(target.expected->energy, 3) + ": they are moved, at the cost of angles, to " +
		numberText(kept, 3) + (endedEarly ? ", where the finish stopped at its step limit." : "."));
}

/// The finish of what is given back. The invariants are those of the flow's own layout.
void finish(const FlowDomain& domain, const Options& options, const Target& target, PlaneMap& map)
{
	if (!isFinished(options) || isRefined(options))
		return; // the refinement is exact
	advance(1.0 - kAfterFlow, "Repairing the map");
	const Finish finish = finishOf(domain, options, target);
	const Array<Point2> before = map.mesh.place;
	map.finished =
		finishInPlane(map.mesh, target.hasFixed(), domain.onHole, finish, mayCutCharts(options));
	map.hasFreeSeams = finish == Finish::LeastStretch;
	if (finish == Finish::LeastDistortion && coneGoal(options.cones).kind == ConeGoal::LeastCost)
		keepPromise(target, map);
	if (map.mesh.place != before) // its border may have moved
		moveUpright(minAreaRectangle(map.mesh.place.values()), 1.0, map.mesh.place);
}

/// How the lengths of a free boundary compare in the map and on the mesh.
void measureBoundary(const FlatMesh& map, Report& report)
{
	double least = kInfinity, most = 0.0;
	for (const Corner side : map.across.indices()) {
		if (map.across[side].isValid() || !(map.lengths[side] > 0.0))
			continue;
		const double ratio = distance(map.at(side), map.at(side.next())) / map.lengths[side];
		least = std::min(least, ratio);
		most = std::max(most, ratio);
	}
	if (!(most > 0.0))
		return;
	report.boundaryRatioMin = least;
	report.boundaryRatioMax = most;
	if (std::max(most - 1.0, 1.0 - least) > kUnequalShare)
		logLine(
			"Free boundary: in the map its edges are " + numberText(least, 3) + " to " +
			numberText(most, 3) + " times as long as on the mesh.");
}

} // namespace

FlowPlan startOfPlan(const Component& component, const VertexInput& input, const Options& options)
{
	advance(0.0, "Circle packing");
	FlowPlan plan;
	plan.domain = flowDomain(component, holesOf(options));
	logComponent(component, plan.domain.surface.topology.type);
	if (options.method != Method::EdgeSwaps)
		plan.start = initialPacking(plan.domain.solved(), options); // 4.1
	plan.request = targetRequest(component, input, options, plan.domain);
	return plan;
}

void completePlan(const Options& options, FlowPlan& plan)
{
	if (options.method == Method::EdgeSwaps)
		return;
	advance(0.0, "Choosing the target");
	plan.target = chooseTarget(plan.domain.solved(), plan.start, plan.request); // 5.2, 5.3
}

Parametrization flattenToPlane(const Component& component, FlowPlan plan, const Options& options)
{
	const int threads = threadsFor(static_cast<std::int64_t>(component.triangles.size()));
	const FlowDomain& domain = plan.domain;
	FlowLog log;
	FlowResult flow;
	CutGraph cut;
	if (options.method == Method::EdgeSwaps)
		flow = flowWithEdgeSwaps(component, options, plan, log); // 5.4
	else
		besides(
			threads,
			[&] { // 4.2
				flow = runFlow(domain.solved(), std::move(plan.start), plan.target, options, log);
			},
			[&] { // 4.3
				cut = cutOpen(plan, conesOf(domain.surface, plan.target, domain.onHole), options);
			});
	flow = keepAreas(domain.solved(), plan.request, options, std::move(flow), log);
	flow = makeSeamless(domain.solved(), plan.request, options, std::move(flow), log);
	logFlow(flow, options);
	if (auto cones = conesOf(domain.surface, flow.target, domain.onHole); cones != cut.cones)
		cut = cutOpen(plan, std::move(cones), options);

	PlaneMap map;
	InvariantReport periods;
	besides(
		threads,
		[&] {
			map = layOut(component, domain, options, flow, cut); // 4.3
		},
		[&] {
			periods = measurePeriods(domain.surface.topology.type, flow);
			requireMetric(flow, domain.solved().topology.boundary);
		});
	// Not beside the periods, which take as much memory.
	finish(domain, options, flow.target, map);
	const bool mayFlip = map.finished.movedCount() > 0 || isBent(flow, options.output);
	Parametrization part = withoutMap(component, domain, flow, std::move(log), cut, map.scale);
	static_cast<InvariantReport&>(part.report) = std::move(map.invariants);
	part.report.periodMatrix = std::move(periods.periodMatrix);
	part.report.periodError = periods.periodError;
	part.report.finishMoved = map.finished.movedCount();
	part.report.endedEarly += map.finished.endedEarly;
	if (options.cones.rounding == ConeRounding::QuarterTurns)
		part.report.holonomyError = quarterTurnError(domain, map.mesh, cut);
	if (flow.target.hasFixed())
		measureBoundary(map.mesh, part.report);
	advance(1.0, "Checking the result");
	part.mesh = std::move(isRefined(options) ? map.refinement : map.mesh);
	requireMap(part.mesh, flow, mayFlip, !map.hasFreeSeams);
	return part;
}

Parametrization flattenToPlane(const Component& component, const Options& options)
{
	FlowPlan plan = startOfPlan(component, VertexInput(), options);
	completePlan(options, plan);
	return flattenToPlane(component, std::move(plan), options);
}

} // namespace ricci
