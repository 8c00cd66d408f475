// SPDX-License-Identifier: GPL-3.0-or-later
#include "swapped_flow.h"

#include "../base/task.h"
#include "../error.h"
#include "../flow/flow_run.h"
#include "boundary_split.h"
#include "edge_swapper.h"

#include <algorithm>
#include <string>
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

SwappedFlow flowWithEdgeSwaps(
	const Component& component,
	const FlowOptions& options,
	const ChooseTarget& chooseTarget,
	std::vector<FlowState>& states)
{
	SplitMesh mesh(component);
	SwappedFlow result;
	int steps = 0;
	for (int attempt = 0; attempt < kMaxStarts; ++attempt) {
		EmbeddedSurface& surface = result.domain.surface;
		surface = embeddedSurface(mesh.positions(), mesh.triangles());
		const Triangulation& t = surface.triangulation;
		InitialPacking start = initialPacking(surface, options);
		const Target target = chooseTarget(surface, start);
		EdgeSwapper swapper(surface.positions, start.radii);
		FlowProgress progress(options.epsilon, states);
		FlowRun run(surface, std::move(start), target, options, progress);
		run.operate([&](CurvatureMap& map) { return swapper(map); });
		try {
			if (!run.solve())
				throw run.failure();
			result.flow = run.result();
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
			mesh.split(t, swapper.boundaryEdgesToSplit());
			logLine(
				std::to_string(mesh.splits()) + " boundary edges split; the flow starts again.");
			continue;
		}
		result.flow.iterations = steps;
		result.splits = mesh.splits();
		if (result.swaps > 0 || result.splits > 0)
			result.domain.isForeign =
				foreignEdges(t, swapper.swapped(), component.positions.size());
		if (result.splits > 0)
			for (const Face f : component.face.indices())
				result.domain.corners.push_back(
					{mesh.corner(t, f, 0), mesh.corner(t, f, 1), mesh.corner(t, f, 2)});
		return result;
	}
	throw NotConverged(NotConverged::SplitsUsedUp, positionOf(mesh.splits()));
}

} // namespace ricci
