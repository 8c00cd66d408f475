// SPDX-License-Identifier: GPL-3.0-or-later
#include "ricci_flow.h"

#include "../base/task.h"
#include "../error.h"
#include "../metric/geometry.h"
#include "flow_run.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ricci {

namespace {

/// Newton steps given to the surface itself where its double can be solved instead.
constexpr int kStepsBeforeDoubling = 40;

} // namespace

InitialPacking initialPacking(const EmbeddedSurface& surface, const FlowOptions& options)
{
	return initialPacking({surface.triangulation, surface.lengths}, {}, options);
}

FlowResult runRicciFlow(
	const EmbeddedSurface& surface,
	InitialPacking start,
	const Target& target,
	const FlowOptions& options,
	std::vector<FlowState>& states)
{
	const FlowProgress progress = flowProgress(options.epsilon, states);
	FlowRun run(surface, std::move(start), target, options, progress);
	const bool flips = options.method == Method::IntrinsicFlips;
	if (!flips || surface.topology.loops.empty()) {
		if (!run.solve())
			throw run.failure();
		return run.result();
	}

	// After errors other than a stop the double may do better.
	run.limitSteps(kStepsBeforeDoubling);
	const bool solved =
		attempt("the double of the surface is tried", [&] { return run.solve(); }).value_or(false);
	if (solved && (target.hasFixed() || !run.bendsAtBoundary()))
		return run.result();
	run.end();
	logLine(
		std::string("Another solve, on the double of the surface: ") +
		(solved ? "on the surface alone, the boundary bends."
				: "the surface alone does not reach the target."));
	try {
		requireMemoryForDouble(static_cast<std::size_t>(surface.triangulation.faceCount()));
		FlowRun onDouble = FlowRun::onDouble(surface, target, options, progress);
		onDouble.goOnFrom(run, solved);
		if (!onDouble.solve())
			throw onDouble.failure();
		return onDouble.result();
	}
	catch (const Stopped&) {
		throw;
	}
	catch (const Error& error) {
		// The half is less conformal at the boundary, but it has the metric asked for.
		if (!solved)
			throw;
		const std::string alone =
			"The result without the double is used, less conformal at the boundary";
		logLine(alone + ", because its double fails (" + error.what() + ").");
		return run.result();
	}
}

VertexVector flowFactor(const FlowResult& flow)
{
	VertexVector factor = flow.u.head(flow.curvature.size());
	for (const Vertex v : factor.indices())
		factor[v] -= std::log(flow.start.radii[v]);
	return factor;
}

EdgeArray<double> hyperbolicLengths(const FlowResult& flow, const EmbeddedSurface& surface)
{
	const Triangulation& t = surface.triangulation;
	const VertexArray<double>& radii = flow.start.radii;
	EdgeArray<double> found(t.edgeCount());
	for (const Edge e : t.edges()) {
		const auto [i, j] = t.ends(e);
		const double l = flow.start.lengthened.lengthOf(t, e, surface.lengths[e]);
		const double delta = std::max(0.0, Euclidean::delta(l, radii[i], radii[j]));
		found[e] =
			Hyperbolic::edge(Hyperbolic::circle(flow.u[i]), Hyperbolic::circle(flow.u[j]), delta)
				.length;
	}
	return found;
}

} // namespace ricci
