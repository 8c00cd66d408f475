// SPDX-License-Identifier: GPL-3.0-or-later
#include "euclidean_flow.h"

#include "../error.h"
#include "../metric/euclidean.h"
#include "circular_boundary.h"
#include "edge_swap.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

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

std::size_t at(int index)
{
	return static_cast<std::size_t>(index);
}

std::string number(double x)
{
	char text[32];
	std::snprintf(text, sizeof text, "%.3g", x);
	return text;
}

/// Halfedges that run along a boundary loop (surface on the left), in its order.
std::vector<int> halfedgesAlong(const Triangulation& t, const std::vector<int>& loop)
{
	std::vector<int> leaving(at(t.vertexCount()), -1), along;
	for (int h = 0; h < t.halfedgeCount(); ++h)
		if (t.isOuter(h))
			leaving[at(t.target(h))] = Triangulation::twin(h);
	for (int v : loop)
		along.push_back(leaving[at(v)]);
	return along;
}

std::vector<double> lengthsOf(const std::vector<int>& halfedges, const std::vector<double>& lengths)
{
	std::vector<double> sides;
	for (int h : halfedges)
		sides.push_back(lengths[at(Triangulation::edge(h))]);
	return sides;
}

/// Largest difference of the points on the circle that two sequences of arcs describe.
double largestTurn(const std::vector<double>& a, const std::vector<double>& b)
{
	double turn = 0.0, low = 0.0, high = 0.0;
	for (std::size_t i = 0; i < a.size(); ++i) {
		turn += a[i] - b[i];
		low  = std::min(low, turn);
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
	CircularBoundarySolve(
		const Triangulation&       t,
		const std::vector<int>&    loop,
		const std::vector<double>& lengths) :
			m_loop(loop),
			m_along(halfedgesAlong(t, loop))
	{
		const std::vector<double> sides = lengthsOf(m_along, lengths);
		m_weights.resize(sides.size());
		for (std::size_t i = 0; i < sides.size(); ++i)
			m_weights[i] = sides[i] + sides[(i + sides.size() - 1) % sides.size()];
		m_arcs = centredArcs(inscribedPolygon(sides).arcs, m_weights);
	}

	template<class Solve>
	NewtonResult run(const CurvatureMap& map, Target& target, double epsilon, Solve solve)
	{
		AndersonMixing mixing(kMixingDepth);
		double         change = 1.0;
		for (int step = 0; step < kMostCircleSteps; ++step) {
			const bool   last = change < kCircleTolerance;
			const double accuracy =
				last ? epsilon : std::max(epsilon, std::min(kInnerAccuracy, kInnerAccuracy * change));
			setTarget(target);
			const NewtonResult result = solve(accuracy);
			if (last || !result.converged)
				return result;
			const std::vector<double> image = centredArcs(
				inscribedPolygon(lengthsOf(m_along, map.lengths())).arcs, m_weights);
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
	void setTarget(Target& target) const
	{
		const std::vector<double> angles = exteriorAngles(m_arcs);
		for (std::size_t i = 0; i < m_loop.size(); ++i)
			target.curvature[m_loop[i]] = angles[i];
	}

	const std::vector<int>& m_loop;
	std::vector<int>        m_along;
	std::vector<double>     m_weights, m_arcs;
};

CirclePacking pack(
	const Triangulation&       t,
	const std::vector<double>& lengths,
	const std::vector<double>& radii,
	PackingScheme              scheme)
{
	return scheme == PackingScheme::Thurston ? thurstonPacking(t, lengths, radii) :
											   inversiveDistancePacking(t, lengths, radii);
}

} // namespace

FlowResult runEuclideanFlow(
	const Triangulation&                    t,
	const std::vector<double>&              lengths,
	const std::vector<Point3>&              positions,
	Target                                  target,
	const std::vector<int>&                 boundaryLoop,
	const Options&                          options,
	const std::function<void(int, double)>& report)
{
	FlowResult                    result;
	std::shared_ptr<CurvatureMap> map;
	std::vector<double>           radii;
	FlippingCurvatureMap<Euclidean>* flipping = nullptr;
	if (options.surgery == Surgery::IntrinsicFlips) {
		DelaunayStart start = delaunayStart({t, lengths}, {});
		radii               = start.radii;
		auto flips = std::make_shared<FlippingCurvatureMap<Euclidean>>(
			pack(start.mesh.triangulation, start.mesh.lengths, radii, options.packing));
		flipping          = flips.get();
		result.startDelta = flips->delta();
		map               = std::move(flips);
		result.start      = std::move(start.mesh);
		result.startFlips = std::move(start.flips);
		result.lengthened = start.lengthened;
	}
	else {
		radii = initialRadii(t, lengths);
		map   = std::make_shared<GeometricCurvatureMap<Euclidean>>(
            pack(t, lengths, radii, options.packing));
	}
	result.u.resize(t.vertexCount());
	for (int v = 0; v < t.vertexCount(); ++v)
		result.u[v] = std::log(radii[at(v)]);
	result.startU = result.u;

	NewtonSolver newton(*map, target.fixed);
	EdgeSwapper  swapper(positions, radii);
	const NewtonSolver::Surgeon surgeon = [&](CurvatureMap& m) { return swapper(m); };

	const auto solve = [&](double epsilon) {
		NewtonOptions newtonOptions;
		newtonOptions.epsilon       = epsilon;
		newtonOptions.maxIterations = options.maxIterations;
		const NewtonResult solved   = newton.solve(
            result.u,
            target.curvature,
            newtonOptions,
            [&](int step, double residual) { report(result.iterations + step, residual); },
            options.surgery == Surgery::EdgeSwap ? surgeon : nullptr);
		result.iterations += solved.iterations;
		return solved;
	};
	const NewtonResult solved =
		target.circular ?
			CircularBoundarySolve(t, boundaryLoop, lengths).run(*map, target, options.epsilon, solve) :
			solve(options.epsilon);

	result.metric       = map;
	if (flipping)
		result.flowFlips = flipping->flips();
	result.residual     = solved.residual;
	result.floor        = solved.floor;
	result.edgeSwaps    = swapper.swaps();
	result.swapped      = swapper.swapped();
	result.edgesToSplit = swapper.boundaryEdgesToSplit();
	result.target       = std::move(target);
	if (!result.edgesToSplit.empty())
		return result;
	if (map->brokenTriangles() > 0)
		throw NotConverged(
			std::to_string(map->brokenTriangles()) +
			" triangles break the triangle inequality at the end of the flow, with " +
			std::to_string(result.edgeSwaps) + " edges swapped: " +
			(options.surgery == Surgery::None ?
				 "choose the surgery 'Edge swap', or remesh the worst triangles." :
				 "remesh the worst triangles."));
	if (!solved.converged)
		throw NotConverged(
			"The flow stopped after " + std::to_string(result.iterations) +
			" Newton steps with a curvature error of " + number(solved.residual) +
			" (wanted: " + number(options.epsilon) + ", rounding floor: " + number(solved.floor) +
			"): raise max_iterations or epsilon.");
	return result;
}

} // namespace ricci
