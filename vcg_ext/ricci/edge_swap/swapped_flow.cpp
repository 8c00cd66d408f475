// SPDX-License-Identifier: GPL-3.0-or-later
#include "swapped_flow.h"

#include "../error.h"
#include "edge_swapper.h"

#include <algorithm>
#include <utility>

namespace ricci {

namespace {

/// Starts of the flow that the splitting of boundary edges may ask for.
constexpr int kMaxStarts = 20;

/// Edges of the flow's triangulation that are not edges of the component: swapped, or at a vertex
/// that a split has added.
EdgeArray<char>
foreignEdges(const Triangulation& beforeSwaps, EdgeArray<char> swapped, int componentVertices)
{
	swapped.resize(beforeSwaps.edgeCount(), 0);
	for (const Edge e : beforeSwaps.edges()) {
		const auto [i, j] = beforeSwaps.ends(e);
		if (std::max(i, j).number() >= componentVertices)
			swapped[e] = 1;
	}
	return swapped;
}

} // namespace

SwappedFlow
flowWithEdgeSwaps(const Component& component, const Options& options, const SwapListener& listener)
{
	SwappedFlow result{SplitMesh(component), {}, {}, {}, 0};
	int steps = 0;
	for (int attempt = 0; attempt < kMaxStarts; ++attempt) {
		result.surface = embeddedSurface(result.mesh.positions(), result.mesh.triangles());
		InitialPacking start = initialPacking(result.surface, options);
		const Target target = listener.chooseTarget(result.surface, start);
		EdgeSwapper swapper(result.surface.positions, start.radii);
		try {
			result.flow = runRicciFlow(
				result.surface,
				std::move(start),
				target,
				options,
				[&](int step, double residual) { listener.step(steps + step, residual); },
				[&](CurvatureMap& map) { return swapper(map); });
			steps += result.flow.iterations;
		}
		catch (NotConverged& error) {
			error.swaps = swapper.swaps();
			// A boundary that does not settle on a circle asks for no split.
			if (error.problem == NotConverged::CircleUnsettled ||
				swapper.boundaryEdgesToSplit().empty())
				throw;
			steps += error.iterations;
		}
		result.swaps += swapper.swaps();
		// Also where the target is reached: a swap beside the broken triangle may have mended it.
		if (!swapper.boundaryEdgesToSplit().empty()) {
			result.mesh.split(result.surface.triangulation, swapper.boundaryEdgesToSplit());
			listener.split(result.mesh.splits());
			continue;
		}
		result.flow.iterations = steps;
		if (result.swaps > 0 || result.mesh.splits() > 0)
			result.forbidden = foreignEdges(
				result.surface.triangulation, swapper.swapped(), component.positions.size());
		listener.end(result.flow);
		return result;
	}
	throw NotConverged(NotConverged::SplitsUsedUp, positionOf(result.mesh.splits()));
}

} // namespace ricci
