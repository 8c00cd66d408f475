// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_run.h"

#include "../base/numbers.h"
#include "../base/tolerances.h"
#include "../math/double_double.h"
#include "../metric/area.h"
#include "../metric/euclidean.h"
#include "../metric/hyperbolic.h"
#include "../metric/unfold.h"
#include "../surface/double_surface.h"
#include "../surface/normal_coordinates.h"
#include "circle_target.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci {

namespace {

/// Residual of a double, in radians, beyond which symmetric steps do not do: rounding has made its
/// copies different.
constexpr double kMaxAsymmetry = 1e-10;

/// Bound of u at a hyperbolic start, below the 0 that stands for an infinite radius.
constexpr double kMaxStartU = -1e-3;

} // namespace

InitialPacking initialPacking(
	IntrinsicMesh mesh,
	const VertexArray<Vertex>& mirror,
	const FlowOptions& options)
{
	if (options.method == Method::IntrinsicFlips)
		return delaunayPacking(std::move(mesh), mirror);
	InitialPacking packing = inputPacking(std::move(mesh));
	if (options.method == Method::Thurston)
		packing.delta = thurstonDistancesLessOne(
			packing.mesh.triangulation, packing.mesh.lengths, packing.radii);
	return packing;
}

FlowProblem
flowProblem(const EmbeddedSurface& surface, InitialPacking start, const Target& target)
{
	FlowProblem problem;
	problem.input = surface.triangulation;
	problem.start = std::move(start);
	problem.target = target;
	problem.vertexCount = surface.triangulation.vertexCount();
	if (target.circular) {
		problem.loop = surface.topology.loops.front();
		for (const Vertex v : problem.loop) {
			const Edge e = surface.triangulation.halfedge(v).edge();
			problem.loopEdges.push_back(e);
			problem.loopLengths.push_back(surface.lengths[e] + problem.start.lengthened);
		}
	}
	return problem;
}

FlowProblem flowProblemOnDouble(
	const EmbeddedSurface& surface,
	const Target& target,
	const FlowOptions& options)
{
	DoubleSurface d = doubleOf(surface.triangulation);
	IntrinsicMesh mesh;
	mesh.triangulation = d.triangulation;
	mesh.lengths.resize(d.edgeOf.size());
	for (const Edge e : d.edgeOf.indices())
		mesh.lengths[e] = surface.lengths[d.edgeOf[e]];
	FlowProblem problem =
		flowProblem(surface, initialPacking(std::move(mesh), d.mirror, options), target);
	problem.input = std::move(d.triangulation);
	Target& doubled = problem.target;
	doubled.curvature.conservativeResize(d.mirror.size());
	doubled.fixed.resize(d.mirror.size());
	for (const Vertex v : surface.triangulation.vertices()) {
		const Vertex image = d.mirror[v];
		if (image == v)
			doubled.curvature[v] *= 2.0;
		doubled.curvature[image] = doubled.curvature[v];
		doubled.fixed[image] = doubled.fixed[v];
	}
	problem.mirror = std::move(d.mirror);
	return problem;
}

FlowRun::FlowRun(
	Background background,
	FlowProblem problem,
	const FlowOptions& options,
	int stepsBefore,
	const FlowListener& listener,
	NewtonSolver::Surgeon surgeon) :
		m_background(background),
		m_problem(std::move(problem)), m_options(options), m_listener(listener),
		m_surgeon(std::move(surgeon))
{
	m_result.background = background;
	m_result.iterations = stepsBefore;
	CirclePacking packing = takeStart();
	m_map = m_background == Background::EuclideanPlane ? makeMap<Euclidean>(std::move(packing))
													   : makeMap<Hyperbolic>(std::move(packing));
	m_newton =
		std::make_unique<NewtonSolver>(*m_map, m_problem.target.fixed, m_problem.mirror);
}

/// The packing of the first step, at m_startU. Moves the start, and the input, to the history if
/// edges flip.
CirclePacking FlowRun::takeStart()
{
	InitialPacking& start = m_problem.start;
	m_startU = startU(start.mesh, start.radii);
	m_result.u = m_startU;
	CirclePacking packing;
	packing.triangulation = start.mesh.triangulation;
	packing.delta = start.delta;
	if (m_options.method == Method::IntrinsicFlips) {
		FlipHistory& history = m_result.history;
		history.input = std::move(m_problem.input);
		history.start = std::move(start.mesh);
		history.startDelta = std::move(start.delta);
		history.startRadii = std::move(start.radii);
		history.startFlips = std::move(start.flips);
		history.lengthened = start.lengthened;
	}
	return packing;
}

template<class Geometry>
std::shared_ptr<CurvatureMap> FlowRun::makeMap(CirclePacking packing) const
{
	std::shared_ptr<CurvatureMap> map;
	if (m_options.method == Method::IntrinsicFlips)
		map = std::make_shared<FlippingCurvatureMap<Geometry>>(std::move(packing));
	else
		map = std::make_shared<GeometricCurvatureMap<Geometry>>(std::move(packing));
	return map;
}

/// ln radius. In the hyperbolic plane at the scale at which the flat surface has the area of the metric
/// to be found, because the inversive distances are the Euclidean ones, which have no scale; there
/// tanh(radius / 2) is nearly radius / 2. The area that a free boundary leaves is not known before: it
/// has a scale of its own, at which radii that are kept are exact.
VertexVector FlowRun::startU(const IntrinsicMesh& mesh, const VertexArray<double>& radii) const
{
	const Target& target = m_problem.target;
	VertexVector u(radii.size());
	if (m_background == Background::EuclideanPlane) {
		for (const Vertex v : radii.indices())
			u[v] = std::log(radii[v]);
		return u;
	}
	const int copies = m_problem.isDoubled() ? 2 : 1;
	const int chi = mesh.triangulation.eulerCharacteristic();
	const bool keeps = target.hasFixed();
	const double area =
		keeps ? copies * freeBoundaryArea(chi / copies) : target.curvature.sum() - 2 * kPi * chi;
	const double scale = 0.5 * std::sqrt(area / euclideanArea(mesh.triangulation, mesh.lengths));
	for (const Vertex v : radii.indices()) {
		const double half = scale * radii[v];
		u[v] = std::min(std::log(keeps ? std::tanh(half) : half), kMaxStartU);
	}
	return u;
}

void FlowRun::startFrom(const VertexVector& factor, std::vector<double> arcs)
{
	m_arcs = std::move(arcs);
	for (const Vertex v : factor.indices()) {
		m_result.u[v] += factor[v];
		const Vertex image = m_problem.mirror[v];
		if (image != v)
			m_result.u[image] += factor[v];
	}
}

bool FlowRun::solve()
{
	const double maxFloor =
		isFlatDisk() ? std::numeric_limits<double>::infinity() : kMaxDoubleFloor;
	m_solved =
		m_problem.target.circular ? solveOnCircle() : solveFor(m_options.epsilon, true, maxFloor);
	const bool stopped =
		!m_solved.converged && m_solved.residual < kWorthExtending && m_map->brokenTriangles() == 0;
	const bool gaps = m_solved.converged && m_solved.floor > maxFloor;
	if (stopped || gaps)
		m_solved = solveExtended();
	if (m_problem.isDoubled() && m_solved.residual > kMaxAsymmetry &&
		m_map->brokenTriangles() == 0) {
		m_newton->dropSymmetry();
		m_solved = solveFor(m_options.epsilon);
	}
	return m_solved.converged;
}

bool FlowRun::solveRoughly(double epsilon)
{
	m_solved = solveFor(std::max(epsilon, m_options.epsilon), false);
	return m_solved.converged;
}

NewtonResult FlowRun::solveOnCircle()
{
	VertexVector& curvature = m_problem.target.curvature;
	const double copies = m_problem.isDoubled() ? 2.0 : 1.0;
	CircleTarget circle(m_problem.loopLengths, m_arcs);
	const auto solveForAngles = [&](const std::vector<double>& angles, double epsilon) {
		for (std::size_t i = 0; i < angles.size(); ++i)
			curvature[m_problem.loop[i]] = copies * angles[i];
		return m_solved = solveFor(epsilon);
	};
	try {
		const NewtonResult solved = circle.reach(
			m_options.epsilon, [&] { return presentLoopLengths(); }, solveForAngles);
		m_arcs = circle.arcs();
		return solved;
	}
	catch (const NotConverged& error) {
		throw withState(error);
	}
}

NewtonResult FlowRun::solveFor(double epsilon, bool polishes, double maxPolishedFloor)
{
	NewtonOptions newtonOptions;
	newtonOptions.epsilon = epsilon;
	newtonOptions.maxIterations = m_problem.maxSteps;
	newtonOptions.polishes = polishes;
	newtonOptions.maxPolishedFloor = maxPolishedFloor;
	const NewtonResult solved = m_newton->solve(
		m_result.u,
		m_problem.target.curvature,
		newtonOptions,
		[&](int step, double residual) { m_listener(m_result.iterations + step, residual); },
		m_surgeon);
	m_result.iterations += solved.iterations;
	return solved;
}

/// Goes on from the present state in extended precision.
NewtonResult FlowRun::solveExtended()
{
	m_flipsBefore = flowFlips();
	CirclePacking packing = m_map->releasePacking();
	std::shared_ptr<CurvatureMap> map =
		m_background == Background::EuclideanPlane
			? makeMap<EuclideanGeometry<DoubleDouble>>(std::move(packing))
			: makeMap<HyperbolicGeometry<DoubleDouble>>(std::move(packing));
	m_newton->continueOn(*map);
	m_map = std::move(map);
	return solveFor(m_options.epsilon);
}

/// A disk without cones, around which nothing has to close.
bool FlowRun::isFlatDisk() const
{
	return !m_problem.isDoubled() && m_map->triangulation().eulerCharacteristic() == 1 &&
		   m_problem.target.curvature.isZero(0.0);
}

bool FlowRun::bendsAtBoundary() const
{
	const Triangulation& t = m_map->triangulation();
	for (const Edge e : t.edges())
		if (t.isBoundary(e) && m_map->weights()[e] < -kTieWeight)
			return true;
	return false;
}

/// Orders of magnitude between the largest and the smallest of the flow's scale factors.
double FlowRun::spreadOfScales() const
{
	const VertexVector change = m_result.u - m_startU;
	return (change.maxCoeff() - change.minCoeff()) / std::log(10.0);
}

std::vector<Edge> FlowRun::flowFlips() const
{
	std::vector<Edge> flips = m_flipsBefore;
	flips.insert(flips.end(), m_map->flips().begin(), m_map->flips().end());
	return flips;
}

/// Lengths of the boundary's edges in the present metric. In a double they may have been flipped
/// away; they stay the axis of symmetry, a straight line across the present triangles.
std::vector<double> FlowRun::presentLoopLengths() const
{
	std::vector<double> lengths;
	for (const Edge e : m_problem.loopEdges)
		lengths.push_back(m_map->lengths()[e]);
	if (!m_problem.isDoubled())
		return lengths;
	NormalCoordinates coordinates(m_result.history.input);
	for (const Edge e : m_result.history.startFlips)
		coordinates.flip(e);
	for (const Edge e : flowFlips())
		coordinates.flip(e);
	const auto curves = coordinates.trace();
	Strip strip;
	for (std::size_t i = 0; i < lengths.size(); ++i) {
		const NormalCoordinates::Curve& curve = curves[m_problem.loopEdges[i]];
		if (curve.crossings.empty()) {
			lengths[i] = m_map->lengths()[curve.first.edge()];
			continue;
		}
		unfold(m_map->triangulation(), m_map->lengths(), curve, strip);
		lengths[i] = std::hypot(strip.end[0], strip.end[1]);
	}
	return lengths;
}

FlowResult FlowRun::result()
{
	m_map->releaseWorkSpace();
	m_result.metric = m_map;
	m_result.doubled = m_problem.isDoubled();
	m_result.residual = m_solved.residual;
	m_result.floor = m_solved.floor;
	m_result.work = m_newton->work();
	m_newton.reset();
	m_result.history.flowFlips = flowFlips();
	m_result.area = m_background == Background::EuclideanPlane
						? euclideanArea(m_map->triangulation(), m_map->lengths())
						: hyperbolicArea(m_map->triangulation(), m_map->lengths());
	m_result.curvature = m_map->curvature().head(m_problem.vertexCount);
	m_result.target = std::move(m_problem.target);
	m_result.target.curvature.conservativeResize(m_problem.vertexCount);
	m_result.target.fixed.resize(m_problem.vertexCount);
	if (m_problem.isDoubled()) {
		m_result.area *= 0.5;
		for (const Vertex v : m_result.curvature.indices())
			if (m_problem.mirror[v] == v) {
				m_result.curvature[v] *= 0.5;
				m_result.target.curvature[v] *= 0.5;
			}
	}
	return std::move(m_result);
}

NotConverged FlowRun::failure() const
{
	const auto broken = static_cast<std::size_t>(m_map->brokenTriangles());
	const double scales = spreadOfScales();
	const bool stalls =
		m_solved.iterations < m_problem.maxSteps && m_solved.residual > kWorthExtending;
	const bool lost =
		m_options.method == Method::IntrinsicFlips && scales > kMaxScales && (broken > 0 || stalls);
	if (lost || !std::isfinite(m_solved.floor))
		return withState(NotConverged(NotConverged::LostInRounding, broken, std::round(scales)));
	if (broken > 0)
		return withState(NotConverged(NotConverged::BrokenTriangles, broken));
	return withState(
		NotConverged(m_result.iterations, m_solved.residual, m_options.epsilon, m_solved.floor));
}

NotConverged FlowRun::withState(NotConverged error) const
{
	error.iterations = m_result.iterations;
	error.residual = m_solved.residual;
	error.epsilon = m_options.epsilon;
	error.floor = m_solved.floor;
	error.method = m_options.method;
	return error;
}

} // namespace ricci
