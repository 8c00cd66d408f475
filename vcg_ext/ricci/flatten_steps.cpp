// SPDX-License-Identifier: GPL-3.0-or-later
#include "flatten_steps.h"

#include "base/numbers.h"
#include "base/tolerances.h"
#include "measure/invariants.h"
#include "metric/area.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci {

namespace {

/// Beyond this genus the period matrix is left out: the log would drown in its numbers.
constexpr int kMaxPeriodGenus = 10;

/// What the triangles of the map leave of a full turn round a vertex inside, and of half a turn on the
/// boundary.
/// \return [vertex]
std::vector<double> curvatureOf(const FlatMesh& map, const VertexArray<char>& isBoundary)
{
	std::vector<double> curvature;
	for (const char isOn : isBoundary)
		curvature.push_back(isOn ? kPi : 2.0 * kPi);
	for (const int f : map.points.indices())
		for (const Corner c : cornersOf(f)) {
			const Point2 a = map.at(c.next()) - map.at(c);
			const Point2 b = map.at(c.next().next()) - map.at(c);
			curvature[positionOf(map.vertices[c])] -= std::atan2(std::abs(cross(a, b)), dot(a, b));
		}
	for (const Vertex v : isBoundary.indices())
		if (double& k = curvature[positionOf(v)]; !isBoundary[v] && std::abs(k) <= kConeCurvature)
			k = 0.0;
	return curvature;
}

/// Whether \p cut is longer than \p other by no more than mirrored seams may cost.
bool isHardlyLonger(const EmbeddedSurface& surface, const CutGraph& cut, const CutGraph& other)
{
	double more = 0.0;
	for (const Edge e : surface.lengths.indices())
		more += (cut.isCut[e] - other.isCut[e]) * surface.lengths[e];
	const double size = std::sqrt(euclideanArea(surface.triangulation, surface.lengths));
	return kSeamPrice * more <= kMirrorPrice * expectedEnergy(0.0) * size;
}

} // namespace

void describeByMap(const Component& component, Parametrization& map)
{
	const Topology topology =
		topologyOf(Triangulation(component.positions.size(), component.triangles));
	map.targetCurvature = curvatureOf(map.mesh, topology.boundary);
	Report& report = map.report;
	report.components = 1;
	report.genus = topology.type.genus;
	report.boundaryLoops = topology.type.boundaryLoops;
	report.eulerCharacteristic = topology.type.eulerCharacteristic();
	report.cones = 0;
	for (const Vertex v : topology.boundary.indices())
		report.cones += !topology.boundary[v] && map.targetCurvature[positionOf(v)] != 0.0;
	const EdgeSet seam = seams(map.mesh);
	report.seamEdges = static_cast<int>(seam.sides.size());
	report.seamLength = seam.length;
}

void moveUpright(const OrientedRectangle& r, double scale, Array<Point2>& points)
{
	for (Point2& p : points) {
		const Point2 q = r.inFrame(p);
		p = {scale * (q[0] - r.min[0]), scale * (q[1] - r.min[1])};
	}
}

void FlowLog::add(const Target& target)
{
	logLines(target.notes);
	notes.insert(notes.end(), target.notes.begin(), target.notes.end());
}

VertexInput inputOf(const Component& component, const VertexInput& input, int vertexCount)
{
	VertexInput values;
	values.selected.resize(positionOf(vertexCount), 0);
	values.targetCurvature.resize(positionOf(vertexCount), 0.0);
	values.precision = input.precision;
	for (const Vertex v : component.vertex.indices()) {
		const std::size_t own = positionOf(v), given = positionOf(component.vertex[v]);
		if (!input.selected.empty())
			values.selected[own] = input.selected[given];
		if (!input.targetCurvature.empty())
			values.targetCurvature[own] = input.targetCurvature[given];
	}
	return values;
}

FlowResult runFlow(
	const EmbeddedSurface& surface,
	InitialPacking start,
	const Target& target,
	const FlowOptions& options,
	FlowLog& log)
{
	log.add(target);
	advance(0.0, "Solving for the metric");
	const Task flow(kBeforeFlow, 1.0 - kAfterFlow);
	return runRicciFlow(surface, std::move(start), target, options, log.states);
}

void logFlow(const FlowResult& flow, const FlowOptions& options)
{
	const Lengthening& added = flow.start.lengthened;
	if (added.largest > 0.0) {
		const auto count =
			added.atVertex.size() - std::count(added.atVertex.begin(), added.atVertex.end(), 0.0);
		logLine(
			"Some faces have no area, or one side a million times shorter than another: the solver "
			"lengthened the edges at " +
			std::to_string(count) + " of the vertices, by up to " + numberText(added.largest, 3) +
			" of their new length.");
	}
	if (flow.residual >= options.epsilon)
		logLine(
			"The requested accuracy is beyond rounding: the curvature is within " +
			numberText(flow.residual, 3) + " of its target (rounding floor " +
			numberText(flow.floor, 3) + ").");
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

CutGraph cutDomain(
	const FlowDomain& domain,
	EdgeArray<double> cost,
	VertexArray<char> cones,
	const MirrorSymmetry* mirror)
{
	advance(1.0 - kAfterFlow, "Shortening the seams");
	const Triangulation& t = domain.surface.triangulation;
	avoidDiagonals(domain.isDiagonal, cost);
	for (const Edge e : domain.isForeign.indices())
		if (domain.isForeign[e])
			cost[e] = kInfinity;
	CutGraph cut = cutToDisk(t, cost, std::move(cones));
	if (mirror)
		if (auto mirrored = mirroredCut(t, *mirror, cost, cut.cones);
			mirrored && isHardlyLonger(domain.surface, *mirrored, cut))
			cut = *std::move(mirrored);
	if (domain.holes > 0)
		dropSeamsToHoles(t, domain.onHole, cut);
	return cut;
}

SurfaceLayout layOutSurface(
	const FlowDomain& domain,
	const FlowOptions& options,
	const FlowResult& flow,
	const EdgeArray<char>& isCut)
{
	advance(1.0 - kAfterFlow, "Laying out the triangles");
	return isRefined(options) ? layOutRefinement(domain, flow, isCut)
							  : layOutCorners(domain, flow, isCut);
}

InvariantReport measurePeriods(const SurfaceType& type, const FlowResult& flow)
{
	InvariantReport report;
	if (type.boundaryLoops > 0 || type.genus < 1 || type.genus > kMaxPeriodGenus)
		return report;
	advance(0.0, "Period matrix");
	const IntrinsicMesh& start = flow.start.mesh;
	const PeriodMatrix periods = periodMatrix(start.triangulation, start.lengths, flow.order);
	for (const auto row : periods.omega.rowwise())
		report.periodMatrix.insert(report.periodMatrix.end(), row.begin(), row.end());
	if (periods.omega.size() > 0)
		report.periodError = periods.error;
	return report;
}

bool isBent(const FlowResult& flow, OutputTriangulation output)
{
	return output == OutputTriangulation::KeepMesh &&
		   (flow.flipCount() > 0 || flow.doubled || flow.swaps > 0 || flow.splits > 0);
}

void logComponent(const Component& component, const SurfaceType& type)
{
	logLine(
		"Component of " + std::to_string(component.positions.size()) + " vertices, " +
		std::to_string(component.triangles.size()) + " faces: " + type.name() + ".");
}

Parametrization withoutMap(
	const Component& component,
	const FlowDomain& domain,
	const FlowResult& flow,
	FlowLog log,
	const CutGraph& cut,
	double scale)
{
	Parametrization part;
	const Target& target = flow.target;
	for (const Vertex v : component.vertex.indices()) {
		part.u.push_back(flow.u[v] + std::log(scale));
		part.targetCurvature.push_back(target.fixed[v] ? flow.curvature[v] : target.curvature[v]);
	}
	for (const Vertex v : cut.cones.indices())
		if (cut.cones[v] && target.used == TargetUsed::PlacedCones)
			part.placedCones.push_back(v.number());
	part.notes = std::move(log.notes);
	part.charts.emplace_back();
	part.charts.back().isMirrored = cut.isMirrored;

	const SurfaceType& type = domain.surface.topology.type;
	Report& report = part.report;
	report.components = 1;
	report.eulerCharacteristic = type.eulerCharacteristic();
	report.genus = type.genus;
	report.boundaryLoops = type.boundaryLoops;
	report.cappedHoles = domain.holes;
	report.iterations = log.roundingSteps + (log.states.empty() ? 0 : log.states.back().step);
	report.flowStates = std::move(log.states);
	report.maxCurvatureError = flow.residual;
	report.residualFloor = flow.floor;
	report.lengthened = flow.start.lengthened.largest;
	report.flips = flow.flipCount();
	report.edgeSwaps = flow.swaps;
	report.boundarySplits = flow.splits;
	report.brokenTriangles = flow.metric->brokenTriangles();
	if (target.background == Background::EuclideanPlane)
		report.targetUsed = target.used;
	report.choice = target.choice;
	report.expectedSpread = target.expectedSpread;
	report.endedEarly = log.endedEarly;
	report.cones = static_cast<int>(std::count(cut.cones.begin(), cut.cones.end(), 1));
	report.seamEdges = cut.edgeCount();
	for (const Edge e : cut.isCut.indices())
		report.seamLength += cut.isCut[e] ? domain.surface.lengths[e] : 0.0;
	return part;
}

} // namespace ricci
