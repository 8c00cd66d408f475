// SPDX-License-Identifier: GPL-3.0-or-later
#include "topology.h"

#include "../math/disjoint_sets.h"

#include <algorithm>
#include <utility>

namespace ricci {

Topology topologyOf(const Triangulation& t)
{
	Topology topology;
	topology.boundary = t.boundaryVertices();
	for (const Halfedge first : t.boundaryLoops()) {
		// Exterior halfedges run with the surface on their right.
		std::vector<Vertex> loop;
		for (const Halfedge h : t.loop(first))
			loop.push_back(t.origin(h));
		std::reverse(loop.begin(), loop.end());
		topology.loops.push_back(std::move(loop));
	}
	topology.type.boundaryLoops = static_cast<int>(topology.loops.size());
	topology.type.genus = (2 - t.eulerCharacteristic() - topology.type.boundaryLoops) / 2;
	return topology;
}

std::vector<Edge> edgesBesideCotree(
	const Triangulation& t, const EdgeArray<char>& inTree, const EdgeArray<double>& loopLength)
{
	std::vector<std::pair<double, Edge>> byLength;
	for (const Edge e : t.edges())
		if (!t.isBoundary(e) && !inTree[e])
			byLength.push_back({-loopLength[e], e});
	std::sort(byLength.begin(), byLength.end());
	DisjointSetsOf<Face> cotree(t.faceCount());
	std::vector<Edge> edges;
	for (const auto& [length, e] : byLength)
		if (!cotree.merge(t.face(e.halfedge()), t.face(e.halfedge().twin())))
			edges.push_back(e);
	return edges;
}

} // namespace ricci
