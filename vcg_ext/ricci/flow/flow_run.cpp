// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_run.h"

#include "../base/numbers.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../mesh/component.h"
#include "../mesh/normal_coordinates.h"
#include "../metric/area.h"
#include "../numerics/iteration.h"
#include "../numerics/moebius_balancing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace ricci {

namespace {

/// Bisections of the radius of an inscribed polygon, of which about 55 halve an interval until it is empty; and
/// fixed-point iterations of the circle, each of which halves the error about without mixing.
constexpr int kMaxBisections = 200, kMaxCircleSteps = 100;

/// Images that Anderson mixing combines.
constexpr std::size_t kMixingDepth = 10;

/// The inner solves are this much more exact than the last change of the target.
constexpr double kInnerAccuracy = 1e-2;

/// Largest difference of the points on the circle that two sequences of arcs describe.
double largestTurn(const std::vector<double>& a, const std::vector<double>& b)
{
	double turn = 0.0, min = 0.0, max = 0.0;
	for (std::size_t i = 0; i < a.size(); ++i) {
		turn += a[i] - b[i];
		min = std::min(min, turn);
		max = std::max(max, turn);
	}
	return max - min;
}

/// Makes arcs add up to a turn.
void closeTurn(std::vector<double>& arcs)
{
	const double sum = std::accumulate(arcs.begin(), arcs.end(), 0.0);
	for (double& arc : arcs)
		arc *= 2 * kPi / sum;
}

/// Arcs after the Moebius transformation of the disk that brings the conformal barycentre of the
/// corners, weighted by \p weights, to the centre [Douady Earle 1986]. It exists and is unique up
/// to rotation while no weight is half of the sum or more; otherwise \p arcs is returned.
std::vector<double> centredArcs(std::vector<double> arcs, const std::vector<double>& weights)
{
	std::vector<Point3> corners; // on the equator, which stays in its plane
	double angle = 0.0, total = 0.0;
	for (std::size_t i = 0; i < arcs.size(); ++i) {
		corners.push_back({std::cos(angle), std::sin(angle), 0.0});
		angle += arcs[i];
		total += weights[i];
	}
	if (*std::max_element(weights.begin(), weights.end()) >= 0.5 * total)
		return arcs;
	balanceByMoebius(corners, weights);
	for (std::size_t i = 0; i < arcs.size(); ++i) {
		const Point3 &p = corners[i], &q = corners[(i + 1) % arcs.size()];
		arcs[i] = std::atan2(cross(p, q)[2], dot(p, q));
		if (arcs[i] < 0.0)
			arcs[i] += 2 * kPi;
	}
	closeTurn(arcs);
	return arcs;
}

/// Residual of a double, in radians, beyond which symmetric steps do not do: rounding has made its
/// copies different.
constexpr double kMaxAsymmetry = 1e-10;

/// Bound of u at a hyperbolic start, below the 0 that stands for an infinite radius.
constexpr double kMaxStartU = -1e-3;

/// The target on the double of a surface, whose curvature is twice as large on the boundary.
/// \param mirror [vertex of the double] its image in the other copy
Target targetOnDouble(Target target, const VertexArray<Vertex>& mirror)
{
	const int vertices = target.fixed.size();
	target.curvature.conservativeResize(mirror.size());
	target.fixed.resize(mirror.size());
	for (const Vertex v : IndexRange<Vertex>(0, vertices)) {
		const Vertex image = mirror[v];
		if (image == v)
			target.curvature[v] *= 2.0;
		target.curvature[image] = target.curvature[v];
		target.fixed[image] = target.fixed[v];
	}
	return target;
}

} // namespace

std::vector<double> inscribedArcs(const std::vector<double>& sides)
{
	const auto longest = std::max_element(sides.begin(), sides.end()) - sides.begin();
	const double diameter = sides[static_cast<std::size_t>(longest)]; // the least
	const auto arcsAt = [&](double radius, bool outside) {
		std::vector<double> arcs;
		arcs.reserve(sides.size());
		for (const double side : sides)
			arcs.push_back(2.0 * std::asin(std::min(1.0, side / (2.0 * radius))));
		double& ofLongest = arcs[static_cast<std::size_t>(longest)];
		ofLongest = outside ? 2 * kPi - ofLongest : ofLongest;
		return arcs;
	};
	// Sum of the arcs less 2 pi as a function of the radius: decreasing while the centre is inside.
	// If it is negative already where the longest side is a diameter, the centre lies beyond that
	// side, whose arc then is the larger of the two.
	const auto excess = [&](double radius, bool outside) {
		const std::vector<double> arcs = arcsAt(radius, outside);
		return std::accumulate(arcs.begin(), arcs.end(), 0.0) - 2 * kPi;
	};
	const bool outside = excess(0.5 * diameter, false) < 0.0;
	const auto isTooLarge = [&](double radius) {
		return outside ? excess(radius, true) > 0.0 : excess(radius, false) < 0.0;
	};
	double min = 0.5 * diameter, max = diameter;
	while (!isTooLarge(max) && std::isfinite(max))
		max *= 2.0;
	for (int i = 0; i < kMaxBisections; ++i) {
		const double middle = 0.5 * (min + max);
		double& bound = isTooLarge(middle) ? max : min;
		if (bound == middle) // no double lies between the two
			break;
		bound = middle;
	}
	std::vector<double> arcs = arcsAt(0.5 * (min + max), outside);
	closeTurn(arcs);
	return arcs;
}

InitialPacking
initialPacking(IntrinsicMesh mesh, const VertexArray<Vertex>& mirror, const FlowOptions& options)
{
	if (options.method == Method::IntrinsicFlips)
		return delaunayPacking(std::move(mesh), mirror);
	InitialPacking packing = inputPacking(std::move(mesh));
	if (options.method == Method::Thurston)
		packing.delta = thurstonDistancesLessOne(
			packing.mesh.triangulation, packing.mesh.lengths, packing.radii);
	return packing;
}

FlowProgress flowProgress(double epsilon, std::vector<FlowState>& states)
{
	return [epsilon, &states, last = 0, first = -1.0](int step, double residual) mutable {
		const bool begins = step <= last;
		last = step;
		const int count = states.empty() ? 0 : states.back().step + (begins ? 0 : 1);
		const bool isKnown = begins && !states.empty() && states.back().residual == residual;
		states.push_back({0, count, residual});
		if (first < 0.0)
			first = std::max(residual, 10 * epsilon);
		const std::string line = "Newton step " + std::to_string(count) + ": max |target - K| = " +
								 numberText(residual, 3, std::chars_format::scientific);
		if (!isKnown)
			logLine(line);
		advance(std::log(first / std::max(residual, epsilon)) / std::log(first / epsilon), line);
	};
}

FlowRun::FlowRun(
	const EmbeddedSurface& surface, const FlowOptions& options, const FlowProgress& progress) :
		m_surface(surface),
		m_options(options), m_progress(progress)
{
}

FlowRun::FlowRun(
	const EmbeddedSurface& surface,
	InitialPacking start,
	const Target& target,
	const FlowOptions& options,
	const FlowProgress& progress) :
		FlowRun(surface, options, progress)
{
	m_result.start = std::move(start);
	m_result.target = target;
	begin();
}

FlowRun FlowRun::onDouble(
	const EmbeddedSurface& surface,
	const Target& target,
	const FlowOptions& options,
	const FlowProgress& progress)
{
	FlowRun run(surface, options, progress);
	IntrinsicMesh mesh = doubleOf(surface.triangulation, surface.lengths, run.m_mirror);
	run.m_result.doubled = true;
	run.m_result.onDouble = mesh.triangulation;
	run.m_result.start = initialPacking(std::move(mesh), run.m_mirror, options);
	run.m_result.target = targetOnDouble(target, run.m_mirror);
	run.begin();
	return run;
}

void FlowRun::begin()
{
	m_result.u = m_startU = startU();
	m_map = curvatureMap(
		m_result.start.mesh.triangulation,
		std::move(m_result.start.delta),
		m_result.target.background,
		m_options.method == Method::IntrinsicFlips);
	m_newton = std::make_unique<NewtonSolver>(*m_map, m_result.target.fixed, m_mirror);
	if (auto known = std::exchange(m_result.start.hessian, nullptr)) {
		m_newton->beginWith(std::move(known));
		m_result.order = m_newton->order();
	}
}

/// ln radius. In the hyperbolic plane at the scale at which the flat surface has the area of the metric
/// to be found, because the inversive distances are the Euclidean ones, which have no scale; there
/// tanh(radius / 2) is nearly radius / 2. The area that a free boundary leaves is not known before: it
/// has a scale of its own, at which radii that are kept are exact.
VertexVector FlowRun::startU() const
{
	const Target& target = m_result.target;
	const IntrinsicMesh& mesh = m_result.start.mesh;
	const VertexArray<double>& radii = m_result.start.radii;
	VertexVector u(radii.size());
	if (target.background == Background::EuclideanPlane) {
		for (const Vertex v : radii.indices())
			u[v] = std::log(radii[v]);
		return u;
	}
	const int copies = m_result.doubled ? 2 : 1;
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

void FlowRun::goOnFrom(const FlowRun& half, bool solved)
{
	m_result.iterations = half.m_result.iterations;
	if (!solved)
		return;
	m_arcs = half.m_arcs;
	for (const Vertex v : half.m_startU.indices()) {
		const double factor = half.m_result.u[v] - half.m_startU[v];
		m_result.u[v] += factor;
		const Vertex image = m_mirror[v];
		if (image != v)
			m_result.u[image] += factor;
	}
}

bool FlowRun::solve()
{
	m_solved = m_result.target.circular ? solveOnCircle() : solveFor(m_options.epsilon);
	if (m_result.doubled && m_solved.residual > kMaxAsymmetry && m_map->brokenTriangles() == 0) {
		logLine(
			"Another solve, without symmetry: rounding has made the copies of the double differ.");
		m_newton->dropSymmetry();
		m_solved = solveFor(m_options.epsilon);
	}
	return m_solved.converged;
}

/// A disk that becomes round (paper 5.2): its boundary is inscribed in a circle. The exterior angles
/// follow the boundary's lengths, solve by solve (a fixed point, with Anderson mixing), and the Moebius
/// freedom of the disk is fixed by the conformal barycentre of the original boundary, which is brought to
/// the centre. It ends once the points on the circle stand still, after one more solve.
/// \return the result of the last solve, which is the first one that did not converge if any
/// \throw NotConverged (CircleUnsettled)
NewtonResult FlowRun::solveOnCircle()
{
	const std::vector<Vertex>& loop = m_surface.topology.loops.front();
	std::vector<double> sides, weights;
	for (const Edge e : loopEdges())
		sides.push_back(
			m_result.start.lengthened.lengthOf(m_surface.triangulation, e, m_surface.lengths[e]));
	for (std::size_t i = 0; i < sides.size(); ++i)
		weights.push_back(sides[i] + sides[(i + sides.size() - 1) % sides.size()]);
	if (m_arcs.empty())
		m_arcs = centredArcs(inscribedArcs(sides), weights);
	AndersonMixing mixing(kMixingDepth);
	double change = 1.0;
	for (int step = 0; step < kMaxCircleSteps; ++step) {
		if (step > 0)
			logLine(
				"Solve " + std::to_string(step + 1) +
				" for the circle: its angles are updated to the present lengths of the boundary.");
		for (std::size_t i = 0; i < m_arcs.size();
			 ++i) { // of the inscribed polygon with these arcs
			const double exterior =
				0.5 * (m_arcs[i] + m_arcs[(i + m_arcs.size() - 1) % m_arcs.size()]);
			m_result.target.curvature[loop[i]] = (m_result.doubled ? 2.0 : 1.0) * exterior;
		}
		const bool last = change < kCircleTolerance;
		const double inner = std::min(kInnerAccuracy, kInnerAccuracy * change);
		m_solved = solveFor(last ? m_options.epsilon : std::max(m_options.epsilon, inner));
		if (last || !m_solved.converged)
			return m_solved;
		const std::vector<double> image = centredArcs(inscribedArcs(presentLoopLengths()), weights);
		change = largestTurn(image, m_arcs);
		std::vector<double> next = mixing.next(m_arcs, image);
		if (*std::min_element(next.begin(), next.end()) <= 0.0) {
			mixing.restart();
			next = image;
		}
		m_arcs = std::move(next);
	}
	throw withState(NotConverged(NotConverged::CircleUnsettled, 0, change));
}

NewtonResult FlowRun::solveFor(double epsilon)
{
	const int before = m_result.iterations;
	return m_newton->solve(
		m_result.u,
		m_result.target.curvature,
		epsilon,
		m_maxSteps,
		[&](int step, double residual) {
			m_result.iterations = before + step;
			m_progress(m_result.iterations, residual);
		},
		m_surgeon);
}

bool FlowRun::bendsAtBoundary() const
{
	const Triangulation& t = m_map->triangulation();
	for (const Edge e : t.edges())
		if (t.isBoundary(e) && m_map->weights()[e] < -kTiny)
			return true;
	return false;
}

/// Orders of magnitude between the largest and the smallest of the flow's scale factors.
double FlowRun::spreadOfScales() const
{
	const VertexVector change = m_result.u - m_startU;
	return (change.maxCoeff() - change.minCoeff()) / std::log(10.0);
}

/// The edges of the boundary loop, from each of its vertices to the next.
std::vector<Edge> FlowRun::loopEdges() const
{
	std::vector<Edge> edges;
	for (const Vertex v : m_surface.topology.loops.front())
		edges.push_back(m_surface.triangulation.halfedge(v).edge());
	return edges;
}

/// Lengths of the boundary's edges in the present metric. In a double they may have been flipped
/// away; they stay the axis of symmetry, a straight line across the present triangles.
std::vector<double> FlowRun::presentLoopLengths() const
{
	const std::vector<Edge> edges = loopEdges();
	std::vector<double> lengths;
	lengths.reserve(edges.size());
	for (const Edge e : edges)
		lengths.push_back(m_map->lengths()[e]);
	if (!m_result.doubled)
		return lengths;
	NormalCoordinates coordinates(m_result.onDouble);
	for (const Edge e : m_result.start.flips)
		coordinates.flip(e);
	for (const Edge e : m_map->flips())
		coordinates.flip(e);
	const auto curves = coordinates.trace();
	std::vector<std::array<Point2, 2>> crossed;
	for (std::size_t i = 0; i < lengths.size(); ++i) {
		const NormalCoordinates::Curve& curve = curves[edges[i]];
		if (curve.crossings.empty()) {
			lengths[i] = m_map->lengths()[curve.first.edge()];
			continue;
		}
		lengths[i] = length(unfold(m_map->triangulation(), m_map->lengths(), curve, crossed));
	}
	return lengths;
}

void FlowRun::end()
{
	m_result.work = m_newton->work();
	if (m_result.order.position.size() == 0)
		m_result.order = m_newton->order();
	m_newton.reset();
	m_map->releaseWorkSpace();
}

FlowResult FlowRun::result()
{
	if (m_newton)
		end();
	m_result.metric = m_map;
	m_result.residual = m_solved.residual;
	m_result.floor = m_solved.floor;
	m_result.flips = m_map->flips();
	m_result.area = m_result.target.background == Background::EuclideanPlane
						? euclideanArea(m_map->triangulation(), m_map->lengths())
						: hyperbolicArea(m_map->triangulation(), m_map->lengths());
	const int vertexCount = m_surface.triangulation.vertexCount();
	m_result.curvature = m_map->curvature().head(vertexCount);
	m_result.target.curvature.conservativeResize(vertexCount);
	m_result.target.fixed.resize(vertexCount);
	if (m_result.doubled) {
		m_result.area *= 0.5;
		for (const Vertex v : m_result.curvature.indices())
			if (m_mirror[v] == v) {
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
	const bool stalls = m_solved.iterations < m_maxSteps || m_solved.floor > m_options.epsilon;
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
