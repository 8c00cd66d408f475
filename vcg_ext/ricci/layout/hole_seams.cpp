// SPDX-License-Identifier: GPL-3.0-or-later
#include "hole_seams.h"

#include "../base/tolerances.h"
#include "../math/adjacency.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ricci {

namespace {

} // namespace

VertexArray<char>
loopsThatClose(const Triangulation& t, const PlanarLayout& layout, const EdgeArray<char>& isCut)
{
	double size = 0.0;
	for (const Point2& p : layout.points)
		size = std::max({size, std::abs(p[0]), std::abs(p[1])});
	// Points that are not numbers are apart.
	const auto apart = [&](Halfedge a, Halfedge b) {
		return !(distance(layout[a], layout[b]) <= kOnePlace * size);
	};
	VertexArray<char> opens(t.vertexCount(), 0); // at an edge whose sides lie apart
	for (const Edge e : t.edges()) {
		if (!isCut[e] || t.isBoundary(e))
			continue;
		const Halfedge h = e.halfedge(), g = h.twin();
		if (apart(h, t.next(g)) || apart(t.next(h), g))
			opens[t.origin(h)] = opens[t.origin(g)] = 1;
	}
	VertexArray<char> closes(t.vertexCount(), 0);
	for (const Halfedge first : t.boundaryLoops()) {
		bool all = true;
		for (const Halfedge h : t.loop(first))
			all &= !opens[t.origin(h)];
		for (const Halfedge h : t.loop(first))
			closes[t.origin(h)] = all;
	}
	return closes;
}

void dropSeamsToHoles(
	const Triangulation& t,
	const EdgeArray<double>& cost,
	const VertexArray<char>& closes,
	const VertexArray<char>& marked,
	CutGraph& cut)
{
	// A boundary loop is one node of the cut, and so is every other vertex.
	VertexArray<Vertex> node(t.vertexCount());
	for (const Vertex v : t.vertices())
		node[v] = v;
	VertexArray<char> terminal = marked; // [node]
	for (const Halfedge first : t.boundaryLoops()) {
		const Vertex own = t.origin(first);
		bool needed = !closes[own];
		for (const Halfedge h : t.loop(first)) {
			node[t.origin(h)] = own;
			needed |= marked[t.origin(h)] != 0;
		}
		terminal[own] = needed;
	}
	const Adjacency<Vertex, Edge> edgesAt(t.vertexCount(), [&](const auto& add) {
		for (const Edge e : t.edges())
			if (cut.isCut[e])
				for (const Vertex v : t.ends(e))
					add(node[v], e);
	});
	VertexArray<int> degree(t.vertexCount()); // [node]
	std::vector<Vertex> deadEnds;
	for (const Vertex n : t.vertices()) {
		degree[n] = edgesAt[n].size();
		if (degree[n] == 1 && !terminal[n])
			deadEnds.push_back(n);
	}
	while (!deadEnds.empty()) {
		const Vertex end = deadEnds.back();
		deadEnds.pop_back();
		for (const Edge e : edgesAt[end]) {
			if (!cut.isCut[e])
				continue;
			cut.isCut[e] = 0;
			--cut.edgeCount;
			cut.length -= cost[e];
			const auto [a, b] = t.ends(e);
			const Vertex other = node[a] == end ? node[b] : node[a];
			if (--degree[other] == 1 && !terminal[other])
				deadEnds.push_back(other);
		}
		degree[end] = 0;
	}
	if (cut.edgeCount == 0)
		cut.length = 0.0; // without the rounding of a sum that is taken back
}

} // namespace ricci
