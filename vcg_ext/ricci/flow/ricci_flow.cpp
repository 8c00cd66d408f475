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

/// The flow on a surface with boundary, whose boundary edges stay.
struct HalfFlow
{
	int iterations = 0;
	std::optional<FlowResult> result; ///< none if the target was not reached

	// What the double can start from, where there is a result:
	VertexVector factor;      ///< logarithmic conformal factor, end less start
	std::vector<double> arcs; ///< of a circular boundary
	bool bends = false;       ///< a boundary edge would have to flip in the double
};

/// \throw only Stopped once the run has begun: after other errors the double may do better
HalfFlow flowOnSurface(
	Background background,
	const EmbeddedSurface& surface,
	FlowStart start,
	const Target& target,
	FlowOptions options,
	const FlowListener& listener,
	const Tick& tick)
{
	options.maxIterations = std::min(options.maxIterations, kStepsBeforeDoubling);
	FlowRun run(
		background, flowProblem(surface, std::move(start), target), options, 0, listener, tick);
	bool solved = false;
	try {
		solved = run.solve();
	}
	catch (const Stopped&) {
		throw;
	}
	catch (const Error&) {
		// not solved
	}
	HalfFlow half;
	half.iterations = run.iterations();
	if (solved) {
		half.factor = run.factor();
		half.arcs = run.arcs();
		half.bends = run.bendsAtBoundary();
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
	const Tick& tick,
	const HalfFlow& half)
{
	requireMemoryForDouble(
		static_cast<std::size_t>(surface.triangulation.faceCount()), options.memoryLimit);
	FlowRun run(
		background,
		flowProblemOnDouble(surface, target, options, tick),
		options,
		half.iterations,
		listener,
		tick);
	if (half.result)
		run.startFrom(half.factor, half.arcs);
	if (!run.solve())
		throw run.failure();
	return run.result();
}

} // namespace

FlowStart flowStart(const EmbeddedSurface& surface, const FlowOptions& options, const Tick& tick)
{
	FlowStart start;
	start.packing = initialPacking({surface.triangulation, surface.lengths}, {}, options, tick);
	return start;
}

FlowResult runRicciFlow(
	Background background,
	const EmbeddedSurface& surface,
	FlowStart start,
	const Target& target,
	const FlowOptions& options,
	const FlowListener& listener,
	const NewtonSolver::Surgeon& surgeon,
	const Tick& tick)
{
	const bool flips = options.surgery == Surgery::IntrinsicFlips;
	if (!flips || surface.topology.loops.empty()) {
		FlowRun run(
			background,
			flowProblem(surface, std::move(start), target),
			options,
			0,
			listener,
			tick,
			surgeon);
		if (!run.solve())
			throw run.failure();
		return run.result();
	}

	HalfFlow half =
		flowOnSurface(background, surface, std::move(start), target, options, listener, tick);
	const bool prescribed = !target.hasFixed();
	if (half.result && !(prescribed && half.bends))
		return std::move(*half.result);
	if (!half.result)
		return flowOnDouble(background, surface, target, options, listener, tick, half);
	try {
		return flowOnDouble(background, surface, target, options, listener, tick, half);
	}
	catch (const Stopped&) {
		throw;
	}
	catch (const Error&) {
		// The half is less conformal at the boundary, but it has the metric asked for.
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
