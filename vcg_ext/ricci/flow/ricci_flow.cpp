// SPDX-License-Identifier: GPL-3.0-or-later
#include "ricci_flow.h"

#include "../base/memory_estimate.h"
#include "../error.h"
#include "../metric/euclidean.h"
#include "../metric/hyperbolic.h"
#include "flow_run.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace ricci {

namespace {

/// Newton steps given to the surface itself where its double can be solved instead.
constexpr int kStepsBeforeDoubling = 40;

/// Radians. Where the boundary bends when the surface itself is solved so far, its double is solved.
constexpr double kRoughEpsilon = 0.3;

/// The flow on a surface with boundary, whose boundary edges stay.
struct HalfFlow
{
	int iterations = 0;
	std::optional<FlowResult> result; ///< none if the target was not reached

	// What the double can start from, where the surface was solved, be it roughly:
	VertexVector factor;      ///< logarithmic conformal factor, end less start
	std::vector<double> arcs; ///< of a circular boundary
	bool bends = false;       ///< a boundary edge would have to flip in the double
};

/// \param mayBeRough whether there need not be a result where the boundary bends: a rough solution tells
/// \throw only Stopped once the run has begun: after other errors the double may do better
HalfFlow flowOnSurface(
	Background background,
	const EmbeddedSurface& surface,
	InitialPacking start,
	const Target& target,
	bool mayBeRough,
	const FlowOptions& options,
	const FlowListener& listener)
{
	FlowProblem problem = flowProblem(surface, std::move(start), target);
	problem.maxSteps = kStepsBeforeDoubling;
	FlowRun run(background, std::move(problem), options, 0, listener);
	HalfFlow half;
	bool solved = false, isRough = false;
	try {
		isRough = mayBeRough && !target.circular && run.solveRoughly(kRoughEpsilon) &&
				  run.bendsAtBoundary();
		solved = isRough || run.solve();
	}
	catch (const Stopped&) {
		throw;
	}
	catch (const Error&) {
		// not solved
	}
	half.iterations = run.iterations();
	if (solved) {
		half.factor = run.factor();
		half.arcs = run.arcs();
		half.bends = isRough || run.bendsAtBoundary();
		if (!isRough)
			half.result = run.result();
	}
	return half;
}

/// The flow on the double of the surface, from what the flow on the surface found.
/// \throw Error if the target is not reached
FlowResult flowOnDouble(
	Background background,
	const EmbeddedSurface& surface,
	const Target& target,
	const FlowOptions& options,
	const FlowListener& listener,
	const HalfFlow& half)
{
	requireMemoryForDouble(static_cast<std::size_t>(surface.triangulation.faceCount()));
	FlowRun run(
		background,
		flowProblemOnDouble(surface, target, options),
		options,
		half.iterations,
		listener);
	if (half.factor.size() > 0)
		run.startFrom(half.factor, half.arcs);
	if (!run.solve())
		throw run.failure();
	return run.result();
}

} // namespace

InitialPacking
initialPacking(const EmbeddedSurface& surface, const FlowOptions& options)
{
	return initialPacking({surface.triangulation, surface.lengths}, {}, options);
}

FlowResult runRicciFlow(
	Background background,
	const EmbeddedSurface& surface,
	InitialPacking start,
	const Target& target,
	const FlowOptions& options,
	const FlowListener& listener,
	const NewtonSolver::Surgeon& surgeon)
{
	const bool flips = options.method == Method::IntrinsicFlips;
	if (!flips || surface.topology.loops.empty()) {
		FlowRun run(
			background,
			flowProblem(surface, std::move(start), target),
			options,
			0,
			listener,
			surgeon);
		if (!run.solve())
			throw run.failure();
		return run.result();
	}

	const bool isPrescribed = !target.hasFixed();
	HalfFlow half = flowOnSurface(
		background, surface, std::move(start), target, isPrescribed, options, listener);
	if (half.result && !(isPrescribed && half.bends))
		return std::move(*half.result);
	try {
		return flowOnDouble(background, surface, target, options, listener, half);
	}
	catch (const Stopped&) {
		throw;
	}
	catch (const Error&) {
		// The half is less conformal at the boundary, but it has the metric asked for.
		if (half.bends && !half.result)
			half = flowOnSurface(
				background,
				surface,
				initialPacking(surface, options),
				target,
				false,
				options,
				listener);
		if (!half.result)
			throw;
		return std::move(*half.result);
	}
}

VertexVector flowFactor(const FlowResult& flow)
{
	VertexVector factor = flow.u.head(flow.curvature.size());
	for (const Vertex v : factor.indices())
		factor[v] -= std::log(flow.history.startRadii[v]);
	return factor;
}

EdgeArray<double> hyperbolicLengths(const FlowResult& flow, const EmbeddedSurface& surface)
{
	const Triangulation& t = surface.triangulation;
	const VertexArray<double>& radii = flow.history.startRadii;
	EdgeArray<double> found(t.edgeCount());
	for (const Edge e : t.edges()) {
		const auto [i, j] = t.ends(e);
		const double l = surface.lengths[e] + flow.history.lengthened;
		const double delta = std::max(0.0, Euclidean::delta(l, radii[i], radii[j]));
		found[e] =
			Hyperbolic::edge(Hyperbolic::circle(flow.u[i]), Hyperbolic::circle(flow.u[j]), delta)
				.length;
	}
	return found;
}

} // namespace ricci
