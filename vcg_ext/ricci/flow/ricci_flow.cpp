// SPDX-License-Identifier: GPL-3.0-or-later
#include "ricci_flow.h"

#include "../error.h"
#include "../layout/unfold.h"
#include "../memory.h"
#include "../metric/area.h"
#include "../metric/euclidean.h"
#include "../metric/hyperbolic.h"
#include "../numbers.h"
#include "../surface/double_surface.h"
#include "../text.h"
#include "circular_boundary.h"
#include "edge_swap.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace ricci {

namespace {

/// Fixed-point iterations of the disk target; it contracts by about a half without acceleration.
constexpr int kMostCircleSteps = 100;

/// Largest change of a boundary point's angle on the circle at which the disk target is reached.
constexpr double kCircleTolerance = 1e-10;

/// Images that Anderson acceleration mixes.
constexpr std::size_t kMixingDepth = 10;

/// The inner solves of the disk target are this much more exact than the last change of the target.
constexpr double kInnerAccuracy = 1e-2;

/// Below this residual a solve that rounding stopped goes on in extended precision.
constexpr double kWorthExtending = 1e-4;

/// Above this rounding floor the last steps are made in extended precision, so that the layout
/// closes.
constexpr double kLargestGap = 1e-12;

/// A weight above minus this is that of co-circular triangles.
constexpr double kTieWeight = 1e-9;

/// Bound of u at a hyperbolic start, below the 0 that stands for an infinite radius.
constexpr double kLargestStartU = -1e-3;

/// Orders of magnitude between scale factors, of which the double's digits hold the square.
constexpr double kMostScales = 7.0;

/// Newton steps given to the surface itself where its double is there to fall back on.
constexpr int kStepsBeforeDoubling = 40;

std::string number(double x)
{
	return numberText(x, 3);
}

/// Largest difference of the points on the circle that two sequences of arcs describe.
double largestTurn(const std::vector<double>& a, const std::vector<double>& b)
{
	double turn = 0.0, low = 0.0, high = 0.0;
	for (std::size_t i = 0; i < a.size(); ++i) {
		turn += a[i] - b[i];
		low = std::min(low, turn);
		high = std::max(high, turn);
	}
	return high - low;
}

/// Solves for a boundary that is inscribed in a circle: the exterior angles follow the boundary's
/// lengths, solve by solve (a fixed point), with the Moebius freedom of the disk fixed by bringing
/// the conformal barycentre of the original boundary to the centre.
class CircularBoundarySolve
{
public:
	/// \p sides: lengths of the boundary's edges before the flow, in the order of the loop.
	/// \p arcs: where to start, or empty.
	CircularBoundarySolve(const std::vector<double>& sides, std::vector<double> arcs) :
			m_arcs(std::move(arcs))
	{
		m_weights.resize(sides.size());
		for (std::size_t i = 0; i < sides.size(); ++i)
			m_weights[i] = sides[i] + sides[(i + sides.size() - 1) % sides.size()];
		if (m_arcs.empty())
			m_arcs = centredArcs(inscribedPolygon(sides).arcs, m_weights);
	}

	const std::vector<double>& arcs() const { return m_arcs; }

	/// \p sides() returns the present lengths of the boundary's edges; \p solve(angles, epsilon)
	/// solves for exterior angles in the order of the loop.
	template<class Sides, class Solve>
	NewtonResult run(double epsilon, Sides sides, Solve solve)
	{
		AndersonMixing mixing(kMixingDepth);
		double change = 1.0;
		for (int step = 0; step < kMostCircleSteps; ++step) {
			const bool last = change < kCircleTolerance;
			const double accuracy =
				last ? epsilon
					 : std::max(epsilon, std::min(kInnerAccuracy, kInnerAccuracy * change));
			const NewtonResult result = solve(exteriorAngles(m_arcs), accuracy);
			if (last || !result.converged)
				return result;
			const std::vector<double> image =
				centredArcs(inscribedPolygon(sides()).arcs, m_weights);
			change = largestTurn(image, m_arcs);
			std::vector<double> next = mixing.next(m_arcs, image);
			if (*std::min_element(next.begin(), next.end()) <= 0.0) {
				mixing.restart();
				next = image;
			}
			m_arcs = std::move(next);
		}
		throw NotConverged(
			"The boundary did not settle on a circle: its points still move by " + number(change) +
			" radians.");
	}

private:
	std::vector<double> m_weights, m_arcs;
};

CirclePacking pack(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<double>& radii,
	PackingScheme scheme)
{
	return scheme == PackingScheme::Thurston ? thurstonPacking(t, lengths, radii)
											 : inversiveDistancePacking(t, lengths, radii);
}

/// One surface on which the flow is tried: the input or its double.
struct Surface
{
	Triangulation triangulation;
	std::vector<double> lengths;
	std::vector<int> mirror; // of a double, else empty
	Target target;
	std::vector<int> loop, loopEdges; // of a circular target
	int vertexCount = 0;              // of the input
};

Surface wholeSurface(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const Target& target,
	const std::vector<int>& loop)
{
	Surface s;
	s.triangulation = t;
	s.lengths = lengths;
	s.target = target;
	s.loop = loop;
	s.vertexCount = t.vertexCount();
	std::vector<int> leaving(at(t.vertexCount()), -1); // boundary edge that leaves a vertex
	for (int h = 0; h < t.halfedgeCount(); ++h)
		if (t.isOuter(h))
			leaving[at(t.target(h))] = Triangulation::edge(h);
	for (int v : loop)
		s.loopEdges.push_back(leaving[at(v)]);
	return s;
}

/// The double: curvature is twice as large on the boundary.
Surface doubledSurface(const Surface& half)
{
	DoubleSurface d = doubleOf(half.triangulation);
	Surface s;
	s.lengths.resize(d.edgeOf.size());
	for (std::size_t e = 0; e < d.edgeOf.size(); ++e)
		s.lengths[e] = half.lengths[at(d.edgeOf[e])];
	s.target = half.target;
	const auto vertexCount = static_cast<Eigen::Index>(d.mirror.size());
	const int ownCount = half.vertexCount;
	s.target.curvature.conservativeResize(vertexCount);
	s.target.fixed.resize(d.mirror.size());
	for (int v = 0; v < ownCount; ++v) {
		const int image = d.mirror[at(v)];
		if (image == v)
			s.target.curvature[v] *= 2.0;
		s.target.curvature[image] = s.target.curvature[v];
		s.target.fixed[at(image)] = s.target.fixed[at(v)];
	}
	s.loop = half.loop;
	s.loopEdges = half.loopEdges;
	s.vertexCount = ownCount;
	s.mirror = std::move(d.mirror);
	s.triangulation = std::move(d.triangulation);
	return s;
}

/// One run of the flow on one surface.
class Run
{
public:
	Run(Background background,
		Surface surface,
		const std::vector<Point3>& positions,
		const FlowOptions& options,
		int stepsBefore,
		const std::function<void(int, double)>& report) :
			m_background(background),
			m_surface(std::move(surface)), m_options(options), m_report(report)
	{
		m_result.iterations = stepsBefore;
		makeMap();
		m_swapper = std::make_unique<EdgeSwapper>(positions, m_radii);
		m_newton = std::make_unique<NewtonSolver>(*m_map, m_surface.target.fixed);
	}

	/// \throw NotConverged if a circular boundary does not settle
	bool solve()
	{
		if (!m_surface.target.circular)
			m_solved = solveFor(m_options.epsilon);
		else {
			CircularBoundarySolve circle(originalSides(), m_arcs);
			m_solved = circle.run(
				m_options.epsilon,
				[&] { return presentSides(); },
				[&](const std::vector<double>& angles, double epsilon) {
					for (std::size_t i = 0; i < angles.size(); ++i)
						m_surface.target.curvature[m_surface.loop[i]] =
							doubled() ? 2.0 * angles[i] : angles[i];
					return solveFor(epsilon);
				});
			m_arcs = circle.arcs();
		}
		const bool stopped = !m_solved.converged && m_solved.residual < kWorthExtending &&
							 m_map->brokenTriangles() == 0;
		const bool gaps = m_solved.converged && m_solved.floor > kLargestGap && !isDisk();
		if (stopped || gaps)
			m_solved = solveExtended();
		return m_solved.converged;
	}

	/// Starts from what another run found on the half of this double: its conformal factor and the
	/// arcs of a circular boundary.
	void startFrom(const Eigen::VectorXd& factor, const std::vector<double>& arcs)
	{
		m_arcs = arcs;
		for (int v = 0; v < m_surface.vertexCount; ++v) {
			m_result.u[v] += factor[v];
			const int image = m_surface.mirror[at(v)];
			if (image != v)
				m_result.u[image] += factor[v];
		}
	}

	const std::vector<double>& arcs() const { return m_arcs; }

	/// Gives up what only further steps need.
	void releaseSolver()
	{
		if (m_newton)
			m_result.work = m_newton->work();
		m_newton.reset();
	}

	/// Logarithmic conformal factor at the input's vertices, end less start.
	Eigen::VectorXd factor() const { return (m_result.u - m_startU).head(m_surface.vertexCount); }

	/// Whether a boundary edge would have to flip in the double: its triangle's circle bulges out.
	bool bendsAtBoundary() const
	{
		const Triangulation& t = m_map->triangulation();
		for (int e = 0; e < t.edgeCount(); ++e)
			if (t.isBoundaryEdge(e) && m_map->weights()[at(e)] < -kTieWeight)
				return true;
		return false;
	}

	int iterations() const { return m_result.iterations; }

	/// Orders of magnitude between the largest and the least of the flow's scale factors.
	double spreadOfScales() const
	{
		const Eigen::VectorXd change = m_result.u - m_startU;
		return (change.maxCoeff() - change.minCoeff()) / std::log(10.0);
	}

	FlowResult result()
	{
		m_map->releaseWorkSpace();
		m_result.metric = m_map;
		m_result.doubled = doubled();
		m_result.residual = m_solved.residual;
		m_result.floor = m_solved.floor;
		releaseSolver();
		m_result.edgeSwaps = m_swapper->swaps();
		m_result.swapped = m_swapper->swapped();
		m_result.edgesToSplit = m_swapper->boundaryEdgesToSplit();
		m_result.history.flowFlips = flowFlips();
		m_result.area = m_background == Background::EuclideanPlane
							? euclideanArea(m_map->triangulation(), m_map->lengths())
							: hyperbolicArea(m_map->triangulation(), m_map->lengths());
		m_result.curvature = m_map->curvature().head(m_surface.vertexCount);
		m_result.target = m_surface.target;
		m_result.target.curvature.conservativeResize(m_surface.vertexCount);
		m_result.target.fixed.resize(at(m_surface.vertexCount));
		if (doubled()) {
			m_result.area *= 0.5;
			for (int v = 0; v < m_surface.vertexCount; ++v)
				if (m_surface.mirror[at(v)] == v) {
					m_result.curvature[v] *= 0.5;
					m_result.target.curvature[v] *= 0.5;
				}
		}
		return std::move(m_result);
	}

	std::string failure() const
	{
		const int broken = m_map->brokenTriangles();
		const double scales = spreadOfScales();
		if (broken > 0 && m_options.surgery == Surgery::IntrinsicFlips && scales > kMostScales)
			return std::to_string(broken) + (broken == 1 ? " triangle is" : " triangles are") +
				   " lost in rounding: the flow makes parts of the surface 1e" +
				   std::to_string(static_cast<int>(std::lround(scales))) +
				   " times as large as others. Choose a target_curvature nearer to the curvature "
				   "of the mesh.";
		if (broken > 0)
			return std::to_string(broken) +
				   (broken == 1 ? " triangle breaks" : " triangles break") +
				   " the triangle inequality at the end of the flow" +
				   (m_options.surgery == Surgery::EdgeSwap
						? ", with " + std::to_string(m_swapper->swaps()) + " edges swapped"
						: std::string()) +
				   (m_options.surgery == Surgery::IntrinsicFlips
						? ": remesh the worst triangles."
						: ": choose the surgery 'Intrinsic flips', or remesh the worst triangles.");
		return "The flow stopped after " + std::to_string(m_result.iterations) +
			   " Newton steps with a curvature error of " + number(m_solved.residual) +
			   " (wanted: " + number(m_options.epsilon) +
			   ", rounding floor: " + number(m_solved.floor) +
			   "): raise max_iterations or epsilon.";
	}

private:
	bool doubled() const { return !m_surface.mirror.empty(); }

	void makeMap()
	{
		IntrinsicMesh mesh{m_surface.triangulation, m_surface.lengths};
		const bool flips = m_options.surgery == Surgery::IntrinsicFlips;
		if (flips) {
			DelaunayStart start = delaunayStart(std::move(mesh), m_surface.mirror);
			m_radii = std::move(start.radii);
			mesh = std::move(start.mesh);
			m_result.history.startFlips = std::move(start.flips);
			m_result.history.lengthened = start.lengthened;
		}
		else
			m_radii = initialRadii(mesh.triangulation, mesh.lengths);
		m_result.u = startU(mesh);
		CirclePacking packing = pack(mesh.triangulation, mesh.lengths, m_radii, m_options.packing);
		if (flips) {
			FlipHistory& history = m_result.history;
			history.input = std::move(m_surface.triangulation);
			history.start = std::move(mesh);
			history.startDelta = packing.delta;
			history.startRadii = m_radii;
		}
		m_startU = m_result.u;
		m_map = m_background == Background::EuclideanPlane
					? makeMap<Euclidean>(std::move(packing))
					: makeMap<Hyperbolic>(std::move(packing));
	}

	template<class Geometry>
	std::shared_ptr<CurvatureMap> makeMap(CirclePacking packing) const
	{
		if (m_options.surgery == Surgery::IntrinsicFlips)
			return std::make_shared<FlippingCurvatureMap<Geometry>>(std::move(packing));
		return std::make_shared<GeometricCurvatureMap<Geometry>>(std::move(packing));
	}

	/// ln radius, in the hyperbolic plane with the radii scaled so that the area is that of the
	/// metric to be found: there tanh(radius / 2) is nearly radius / 2, and the inversive distances
	/// are the Euclidean ones, which know no scale.
	Eigen::VectorXd startU(const IntrinsicMesh& mesh) const
	{
		Eigen::VectorXd u(static_cast<Eigen::Index>(m_radii.size()));
		double scale = 1.0;
		if (m_background == Background::HyperbolicPlane) {
			double area = -2 * kPi * mesh.triangulation.eulerCharacteristic();
			for (std::size_t v = 0; v < m_surface.target.fixed.size(); ++v)
				if (!m_surface.target.fixed[v])
					area += m_surface.target.curvature[static_cast<Eigen::Index>(v)];
			scale = 0.5 * std::sqrt(area / euclideanArea(mesh.triangulation, mesh.lengths));
		}
		for (std::size_t v = 0; v < m_radii.size(); ++v)
			u[static_cast<Eigen::Index>(v)] = std::log(scale * m_radii[v]);
		if (m_background == Background::HyperbolicPlane)
			u = u.cwiseMin(kLargestStartU);
		return u;
	}

	NewtonResult solveFor(double epsilon)
	{
		NewtonOptions newtonOptions;
		newtonOptions.epsilon = epsilon;
		newtonOptions.maxIterations = m_options.maxIterations;
		const NewtonSolver::Surgeon surgeon = [&](CurvatureMap& m) { return (*m_swapper)(m); };
		const NewtonResult solved = m_newton->solve(
			m_result.u,
			m_surface.target.curvature,
			newtonOptions,
			[&](int step, double residual) { m_report(m_result.iterations + step, residual); },
			m_options.surgery == Surgery::EdgeSwap ? surgeon : nullptr);
		m_result.iterations += solved.iterations;
		return solved;
	}

	/// Nothing has to close round a disk without cones.
	bool isDisk() const
	{
		return !doubled() && m_map->triangulation().eulerCharacteristic() == 1 &&
			   m_surface.target.curvature.isZero(0.0);
	}

	/// Goes on from the present state in long double.
	NewtonResult solveExtended()
	{
		m_flipsBefore = flowFlips();
		CirclePacking packing = m_map->releasePacking();
		std::shared_ptr<CurvatureMap> map =
			m_background == Background::EuclideanPlane
				? makeMap<EuclideanGeometry<long double>>(std::move(packing))
				: makeMap<HyperbolicGeometry<long double>>(std::move(packing));
		m_newton->continueOn(*map);
		m_map = std::move(map);
		return solveFor(m_options.epsilon);
	}

	std::vector<int> flowFlips() const
	{
		std::vector<int> flips = m_flipsBefore;
		flips.insert(flips.end(), m_map->flips().begin(), m_map->flips().end());
		return flips;
	}

	std::vector<double> originalSides() const
	{
		std::vector<double> sides;
		for (int e : m_surface.loopEdges)
			sides.push_back(m_surface.lengths[at(e)] + m_result.history.lengthened);
		return sides;
	}

	/// Lengths of the boundary's edges in the present metric. In a double they may have been
	/// flipped away; they stay the axis of symmetry, a straight line across the present triangles.
	std::vector<double> presentSides() const
	{
		std::vector<double> sides;
		for (int e : m_surface.loopEdges)
			sides.push_back(m_map->lengths()[at(e)]);
		if (!doubled())
			return sides;
		NormalCoordinates coordinates(m_result.history.input);
		for (int e : m_result.history.startFlips)
			coordinates.flip(e);
		for (int e : flowFlips())
			coordinates.flip(e);
		const auto curves = coordinates.trace();
		Strip strip;
		for (std::size_t i = 0; i < sides.size(); ++i) {
			const auto& curve = curves[at(m_surface.loopEdges[i])];
			if (curve.crossings.empty()) {
				sides[i] = m_map->lengths()[at(Triangulation::edge(curve.first))];
				continue;
			}
			unfold(m_map->triangulation(), m_map->lengths(), curve, strip);
			sides[i] = std::hypot(strip.end[0], strip.end[1]);
		}
		return sides;
	}

	Background m_background;
	Surface m_surface; // without its triangulation once the history has it
	const FlowOptions& m_options;
	const std::function<void(int, double)>& m_report;
	FlowResult m_result;
	std::vector<double> m_radii;
	Eigen::VectorXd m_startU;
	std::shared_ptr<CurvatureMap> m_map;
	std::vector<int> m_flipsBefore; // those of the map in double, once the map is an extended one
	std::unique_ptr<EdgeSwapper> m_swapper;
	std::unique_ptr<NewtonSolver> m_newton;
	NewtonResult m_solved;
	std::vector<double> m_arcs; // of a circular boundary
};

} // namespace

FlowResult runRicciFlow(
	Background background,
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<Point3>& positions,
	const Target& target,
	const std::vector<int>& boundaryLoop,
	const FlowOptions& options,
	const std::function<void(int, double)>& report)
{
	Surface whole = wholeSurface(t, lengths, target, boundaryLoop);
	const bool canDouble = options.surgery == Surgery::IntrinsicFlips && !t.boundaryLoops().empty();
	const bool prescribed =
		std::find(target.fixed.begin(), target.fixed.end(), 1) == target.fixed.end();
	if (!canDouble) {
		Run run(background, std::move(whole), positions, options, 0, report);
		const bool solved = run.solve();
		const std::string failure = solved ? std::string() : run.failure();
		FlowResult result = run.result();
		if (solved || !result.edgesToSplit.empty())
			return result;
		throw NotConverged(failure);
	}

	FlowOptions halfOptions = options;
	halfOptions.maxIterations = std::min(options.maxIterations, kStepsBeforeDoubling);
	auto half = std::make_unique<Run>(background, whole, positions, halfOptions, 0, report);
	bool solved = false;
	try {
		solved = half->solve();
	}
	catch (const Stopped&) {
		throw;
	}
	catch (const Error&) { // the double may do better
	}
	if (solved && !(prescribed && half->bendsAtBoundary()))
		return half->result();
	const int iterations = half->iterations();
	half->releaseSolver();
	if (!solved)
		half.reset();
	std::string failure;
	try {
		requireMemoryForDouble(at(t.faceCount()), options.memoryLimit);
		Run twice(background, doubledSurface(whole), positions, options, iterations, report);
		if (solved)
			twice.startFrom(half->factor(), half->arcs());
		if (twice.solve())
			return twice.result();
		failure = twice.failure();
	}
	catch (const Stopped&) {
		throw;
	}
	catch (const Error&) {
		if (!solved)
			throw;
	}
	if (solved) // less conformal at the boundary, but the metric asked for
		return half->result();
	throw NotConverged(failure);
}

std::vector<double> hyperbolicLengths(
	const FlowResult& flow, const Triangulation& t, const std::vector<double>& lengths)
{
	std::vector<double> found(lengths.size());
	const std::vector<double>& radii = flow.history.startRadii;
	for (int e = 0; e < t.edgeCount(); ++e) {
		const int i = t.origin(2 * e), j = t.target(2 * e);
		const double l = lengths[at(e)] + flow.history.lengthened;
		const double delta = std::max(0.0, Euclidean::delta(l, radii[at(i)], radii[at(j)]));
		found[at(e)] =
			Hyperbolic::edge(Hyperbolic::circle(flow.u[i]), Hyperbolic::circle(flow.u[j]), delta)
				.length;
	}
	return found;
}

} // namespace ricci
