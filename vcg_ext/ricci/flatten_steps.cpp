// SPDX-License-Identifier: GPL-3.0-or-later
#include "flatten_steps.h"

#include "base/numbers.h"
#include "base/task.h"
#include "base/tolerances.h"
#include "cones/area_change.h"
#include "flow/ricci_flow.h"
#include "measure/period_matrix.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

namespace ricci {

namespace {

/// Beyond this genus the period matrix is left out: the log would drown in its numbers.
constexpr int kMaxPeriodGenus = 10;

/// Share of the part after the flow that the overlay takes before it is laid out.
constexpr double kOverlay = 0.35;

/// Flows after the first one, and those in a row that may bring nothing: where areas are to be kept so
/// far, and where the map is to cost little.
constexpr int kMaxRounds = 6, kMaxVainRounds = 2, kMaxCheaper = 2, kMaxVainCheaper = 1;

} // namespace

TargetInput targetInput(const Component& component, const VertexInput& input, int vertexCount)
{
	TargetInput values;
	values.selected.resize(vertexCount, 0);
	values.prescribed.resize(vertexCount, 0.0);
	values.prescribedPrecision = input.precision;
	for (const Vertex v : component.vertex.indices()) {
		if (!input.selected.empty())
			values.selected[v] = input.selected[positionOf(component.vertex[v])];
		if (!input.targetCurvature.empty())
			values.prescribed[v] = input.targetCurvature[positionOf(component.vertex[v])];
	}
	return values;
}

void logFlow(const FlowResult& flow, const FlowOptions& options)
{
	const Lengthening& added = flow.start.lengthened;
	if (added.largest > 0.0) {
		const auto count =
			added.atVertex.size() - std::count(added.atVertex.begin(), added.atVertex.end(), 0.0);
		logLine(
			"Some faces have no area, or one side a million times shorter than another: the flow "
			"sees the edges at " +
			std::to_string(count) + " of the vertices longer, by up to " +
			numberText(added.largest, 3) + " of what they then are.");
	}
	if (flow.residual >= options.epsilon)
		logLine(
			"The residual asked for is below what rounding allows: the curvature is reached to " +
			numberText(flow.residual, 3) + " (rounding floor " + numberText(flow.floor, 3) + ").");
}

VertexArray<char>
conesOf(const EmbeddedSurface& surface, const Target& target, const VertexArray<char>& onHole)
{
	VertexArray<char> cones(surface.triangulation.vertexCount(), 0);
	for (const Vertex v : cones.indices()) {
		const bool inside = !surface.topology.boundary[v] || (!onHole.empty() && onHole[v]);
		cones[v] = inside && std::abs(target.curvature[v]) > kConeCurvature;
	}
	return cones;
}

OverlayPieces
flowOverlay(const FlowDomain& domain, const FlowOptions& options, const ComponentMap& map)
{
	if (!isRefined(options))
		return {};
	const Task overlay(1.0 - kAfterFlow, 1.0 - kAfterFlow * (1.0 - kOverlay));
	return divideStartTriangles(map.flow, domain.surface.triangulation.faceCount());
}

CutGraph cutDomain(const FlowDomain& domain, EdgeArray<double> cost, const VertexArray<char>& cones)
{
	advance(1.0 - kAfterFlow, "Shortening the seams");
	const Triangulation& t = domain.surface.triangulation;
	avoidDiagonals(domain.isDiagonal, cost);
	for (const Edge e : domain.isForeign.indices())
		if (domain.isForeign[e])
			cost[e] = std::numeric_limits<double>::infinity();
	CutGraph cut = cutToDisk(t, cost, cones);
	if (domain.holes > 0)
		dropSeamsToHoles(t, domain.surface.lengths, domain.onHole, cones, cut);
	return cut;
}

SurfaceLayout placeCorners(
	const FlowDomain& domain, OverlayPieces overlay, const FlowOptions& options, ComponentMap& map)
{
	if (!isRefined(options))
		return layOutCorners(domain, map.flow, map.cut.isCut);
	SurfaceLayout layout = layOutRefinement(domain, map.flow, std::move(overlay), map.cut.isCut);
	map.mesh = std::move(layout.refinement);
	return layout;
}

double lengthOf(const CutGraph& cut, const EdgeArray<double>& lengths)
{
	double length = 0.0;
	for (const Edge e : cut.isCut.indices())
		length += cut.isCut[e] ? lengths[e] : 0.0;
	return length;
}

void describe(const Component& component, const FlowDomain& domain, ComponentMap& map)
{
	map.type = domain.surface.topology.type;
	map.report.components = 1;
	map.report.eulerCharacteristic = map.type.eulerCharacteristic();
	map.report.genus = map.type.genus;
	map.report.boundaryLoops = map.type.boundaryLoops;
	map.report.cappedHoles = domain.holes;
	logLine(
		"Component of " + std::to_string(component.positions.size()) + " vertices, " +
		std::to_string(component.triangles.size()) + " faces: " + map.type.name() + ".");
}

void noteTarget(const Target& target, ComponentMap& map)
{
	logLines(target.notes);
	map.notes.insert(map.notes.end(), target.notes.begin(), target.notes.end());
}

FlowResult runFlow(
	const EmbeddedSurface& surface,
	InitialPacking start,
	const Target& target,
	const FlowOptions& options,
	ComponentMap& map)
{
	noteTarget(target, map);
	advance(0.0, "Solving for the metric");
	const Task flow(kBeforeFlow, 1.0 - kAfterFlow);
	return runRicciFlow(surface, std::move(start), target, options, map.report.flowStates);
}

Array<Triangle2> cornersOf(const FlowDomain& domain, const PlanarLayout& layout)
{
	const Triangulation& t = domain.surface.triangulation;
	const bool isSplit = !domain.corners.empty();
	Array<Triangle2> corners(isSplit ? domain.corners.size() : t.faceCount());
	for (const int f : corners.indices()) {
		const auto h = isSplit ? domain.corners[Face(f)] : t.halfedges(Face(f));
		corners[f] = {layout[h[0]], layout[h[1]], layout[h[2]]};
	}
	return corners;
}

FlatMesh flatMesh(const Component& component, const FlowDomain& domain, const PlanarLayout& layout)
{
	return flatMeshOf(
		Array<Triangle>(component.triangles),
		cornersOf(domain, layout),
		component.positions.values());
}

void measurePeriods(ComponentMap& map)
{
	if (map.type.boundaryLoops > 0 || map.type.genus < 1 || map.type.genus > kMaxPeriodGenus)
		return;
	advance(0.0, "Period matrix");
	const IntrinsicMesh& start = map.flow.start.mesh;
	const PeriodMatrix periods = periodMatrix(start.triangulation, start.lengths, map.flow.order);
	for (const auto row : periods.omega.rowwise())
		map.report.periodMatrix.insert(map.report.periodMatrix.end(), row.begin(), row.end());
	if (periods.omega.size() > 0)
		map.report.periodError = periods.error;
}

bool mayBeFlipped(const ComponentMap& map, OutputTriangulation output)
{
	const bool isBent = map.flow.flipCount() > 0 || map.flow.doubled || map.report.edgeSwaps > 0 ||
						map.report.boundarySplits > 0;
	return map.report.finishMoved > 0 || (isBent && output == OutputTriangulation::KeepMesh);
}

void keepAreas(
	const EmbeddedSurface& surface,
	const TargetRequest& request,
	const Options& options,
	ComponentMap& map)
{
	FlowResult& best = map.flow;
	std::unique_ptr<const FlowResult> last; // where it is not the best
	const auto propose = [&]() -> std::optional<FlowResult> {
		const FlowResult& before = last ? *last : best;
		if (keepsAreas(surface, before))
			return std::nullopt; // without the cost of another start
		auto next = attempt("the metric before it stays", [&]() -> std::optional<FlowResult> {
			InitialPacking start = initialPacking(surface, options);
			const auto target = targetToKeepAreas(surface, start, before, request);
			if (!target)
				return std::nullopt;
			return runFlow(surface, std::move(start), *target, options, map);
		});
		return next ? std::move(*next) : std::nullopt;
	};
	const auto take = [&](FlowResult next) {
		const bool isBest = areaCost(surface, next) <= areaCost(surface, best);
		last.reset();
		if (isBest)
			best = std::move(next);
		else
			last = std::make_unique<const FlowResult>(std::move(next));
		return isBest;
	};
	const bool isForCost = best.target.expected.has_value();
	const int round = improve(
		isForCost ? kMaxCheaper : kMaxRounds,
		isForCost ? kMaxVainCheaper : kMaxVainRounds,
		propose,
		take);
	if (!isForCost && round == kMaxRounds) {
		++map.report.endedEarly;
		logLine("The search for cones that keep areas has ended at the bound on its flows.");
	}
	if (round > 0) {
		const AreaChange change = areaChange(surface, flowFactor(best));
		logLine(
			"The spread of the logarithm of the area factor is " + numberText(change.spread, 3) +
			", the mean of the factor or its inverse " + numberText(change.mean, 3) +
			", the energy " + numberText(change.energy, 3) + ".");
	}
}

} // namespace ricci
