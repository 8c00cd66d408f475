// SPDX-License-Identifier: GPL-3.0-or-later
#include "cotree.h"

#include "../math/disjoint_sets.h"

#include <algorithm>

namespace ricci {

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
