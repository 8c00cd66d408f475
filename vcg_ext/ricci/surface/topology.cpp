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
	std::vector<Edge> edges;
	for (const Edge e : t.edges())
		if (!t.isBoundary(e) && !inTree[e])
			edges.push_back(e);
	std::sort(edges.begin(), edges.end(), [&](Edge a, Edge b) {
		return loopLength[a] != loopLength[b] ? loopLength[a] > loopLength[b] : a < b;
	});
	DisjointSetsOf<Face> cotree(t.faceCount());
	const auto isCrossed = [&](Edge e) {
		return cotree.merge(t.face(e.halfedge()), t.face(e.halfedge().twin()));
	};
	edges.erase(std::remove_if(edges.begin(), edges.end(), isCrossed), edges.end());
	return edges;
}

} // namespace ricci
