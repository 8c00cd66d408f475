// SPDX-License-Identifier: GPL-3.0-or-later
#include "../edge_swap/swapped_flow.h"
#include "../measure/distortion.h"
#include "../verify/flow_check.h"
#include "../verify/result_check.h"
#include "stages.h"
#include "whole_map.h"

#include "../base/task.h"

#include <cmath>
#include <string>
#include <utility>

namespace ricci {

namespace {

/// Point of the layout at a corner of the triangulation before the swaps: that of the wedge which
/// begins at the same cut or boundary halfedge, which no swap moves; any wedge where the vertex is
/// not cut.
const Point2& pointOf(
	const Triangulation& beforeSwaps,
	const Triangulation& swapped,
	const EdgeArray<char>& isCut,
	const PlanarLayout& layout,
	Halfedge corner)
{
	Halfedge h = corner;
	do {
		if (isCut[h.edge()] || beforeSwaps.isBoundary(h.edge()))
			return layout[h];
		h = beforeSwaps.next(h.twin());
	} while (h != corner);
	return layout[swapped.halfedge(beforeSwaps.origin(corner))];
}

} // namespace

ComponentMap
flattenWithEdgeSwaps(const Component& component, const VertexInput& input, const Options& options)
{
	ComponentMap map;
	advance(0.0, "Circle packing");
	bool first = true;
	std::optional<FlowProgress> flowProgress;
	SwapListener listener;
	advance(0.0, "Solving for the metric");
	listener.chooseTarget = [&](const EmbeddedSurface& surface, const InitialPacking& start) {
		TargetRequest request = targetRequest(component, input, options, surface.positions.size());
		Target target = chooseTarget(surface, start, request);
		if (first) {
			logLine(description(component, surface.topology.type));
			for (const std::string& note : target.notes)
				logLine(note);
			map.notes = target.notes;
		}
		first = false;
		flowProgress.emplace(options.epsilon, map.flowStates);
		return target;
	};
	listener.step = [&](int step, double residual) { (*flowProgress)(step, residual); };
	listener.end = [&](const FlowResult& flow) { logFlow(flow, options); };
	listener.split = [&](int splits) {
		logLine(std::to_string(splits) + " boundary edges split; the flow starts again.");
	};
	SwappedFlow swapped = flowWithEdgeSwaps(component, options, listener);
	const EmbeddedSurface& surface = swapped.surface;
	map.type = surface.topology.type;
	map.flow = std::move(swapped.flow);
	map.edgeSwaps = swapped.swaps;
	map.boundarySplits = swapped.mesh.splits();
	measurePeriods(map);

	advance(1.0 - kAfterFlow, "Cutting and layout");
	const CurvatureMap& metric = *map.flow.metric;
	const Triangulation& t = metric.triangulation();
	map.cones = conesOf(surface, map.flow.target);
	advance(1.0 - kAfterFlow, "Shortening the seams");
	map.cut = cutToDisk(
		t,
		seamCost(surface.triangulation, surface.lengths, surface.positions, options.seamHiding),
		map.cones,
		swapped.forbidden);
	const auto placeCorners = [&] {
		map.layout = layOutInPlane(t, metric.lengths(), metric.angles(), map.cut.isCut);
	};
	placeCorners();
	if (map.type.boundaryLoops > 1) {
		const int edges = map.cut.edgeCount;
		const VertexArray<char> closing = loopsThatClose(t, map.layout, map.cut.isCut);
		dropSeamsToHoles(t, surface.lengths, closing, map.cones, map.cut);
		if (map.cut.edgeCount < edges)
			placeCorners();
	}
	if (!map.flow.target.hasFixed())
		map.scale = std::sqrt(
			surfaceArea(swapped.mesh.positions().values(), swapped.mesh.triangles()) /
			map.flow.area);
	turnUpright(map.scale, map);
	map.seamLength = lengthOf(map.cut, surface.lengths);
	conformalInvariants(t, map);
	map.uv.resize(component.triangles.size());
	for (const Face f : map.uv.indices())
		for (std::size_t k = 0; k < 3; ++k)
			map.uv[f][k] = pointOf(
				surface.triangulation,
				t,
				map.cut.isCut,
				map.layout,
				swapped.mesh.corner(surface.triangulation, f, k));

	advance(1.0, "Checking the result");
	requireMetric(map.flow, surface.topology.boundary);
	map.mesh = flatMesh(component, map, options.output);
	requireMap(map.mesh, map.flow, mayBeFlipped(map, options.output));
	return map;
}

} // namespace ricci
