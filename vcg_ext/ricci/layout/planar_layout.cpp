// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar_layout.h"

#include "../base/graphs.h"
#include "../base/numbers.h"
#include "../base/tolerances.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci {

PlanarLayout cornerWedges(const Triangulation& t, const EdgeArray<char>& isCut)
{
	const auto divides = [&](Halfedge h) { return isCut[h.edge()] || t.isBoundary(h.edge()); };
	PlanarLayout layout;
	HalfedgeArray<int>& wedgeOf = layout.wedge;
	wedgeOf.assign(t.halfedgeCount(), -1);
	for (const Halfedge start : t.interiorHalfedges()) {
		if (wedgeOf[start] >= 0)
			continue;
		const int wedge = layout.points.size();
		layout.points.push_back({0.0, 0.0});
		Halfedge h = start;
		do { // counter-clockwise
			wedgeOf[h] = wedge;
			const Halfedge in = t.previous(h);
			if (divides(in))
				break;
			h = in.twin();
		} while (h != start);
		for (h = start; !divides(h);) { // clockwise
			h = t.next(h.twin());
			if (wedgeOf[h] >= 0)
				break;
			wedgeOf[h] = wedge;
		}
	}
	return layout;
}

FlatMesh
flatMeshOf(const Component& component, const FlowDomain& domain, const PlanarLayout& layout)
{
	FlatMesh flat;
	flat.place = layout.points;
	flat.vertices = Array<Triangle>(component.triangles);
	const EdgeArray<double>& lengths = domain.surface.lengths;
	for (const int f : flat.vertices.indices()) {
		const auto h = domain.halfedges(Face(f));
		flat.points.push_back({layout.wedge[h[0]], layout.wedge[h[1]], layout.wedge[h[2]]});
		flat.lengths.push_back(
			domain.corners.empty()
				? std::array{lengths[h[0].edge()], lengths[h[1].edge()], lengths[h[2].edge()]}
				: component.sides(Face(f)));
		flat.face.push_back(f);
	}
	flat.isDiagonal = sidesOf(component.diagonal);
	flat.chart.assign(flat.face.size(), 0);
	flat.source = verticesOf(component.positions.values().size());
	connect(flat);
	if (!domain.corners.empty())
		splitPoints(flat); // vertices that split the boundary are none of the component's
	return flat;
}

PlanarLayout layOutInPlane(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const HalfedgeArray<double>& angles,
	const EdgeArray<char>& isCut,
	Face root)
{
	PlanarLayout layout = cornerWedges(t, isCut);
	Array<char> placed(layout.points.size(), 0); // [wedge]
	const auto place = [&](Halfedge h, const Point2& p) {
		if (!std::exchange(placed[layout.wedge[h]], 1))
			layout[h] = p;
	};
	// Directions are carried from triangle to triangle as angles, never measured between points:
	// across a short side of a needle that would magnify the error of the points without bound.
	HalfedgeArray<double> direction(t.halfedgeCount(), 0.0);
	const auto placeTriangle = [&](Halfedge h, double along) {
		const Halfedge second = t.next(h), third = t.previous(h);
		const double toApex = along + angles[h]; // from the origin of h
		const double fromBase = along + kPi - angles[second];
		direction[h] = along;
		direction[second] = fromBase;
		direction[third] = toApex - kPi;
		const double left = lengths[third.edge()], right = lengths[second.edge()];
		const bool fromSecond = right < left; // the nearer end of the base
		const Point2 from = layout[fromSecond ? second : h];
		const double angle = fromSecond ? fromBase : toApex, length = std::min(left, right);
		place(third, {from[0] + length * std::cos(angle), from[1] + length * std::sin(angle)});
	};

	const Halfedge first = t.halfedge(root);
	place(first, {0.0, 0.0});
	place(t.next(first), {lengths[first.edge()], 0.0});
	placeTriangle(first, 0.0);
	for (const Halfedge h : layoutTree(t, lengths, isCut, root))
		placeTriangle(h, std::remainder(direction[h.twin()] + kPi, 2 * kPi));
	return layout;
}

VertexArray<char>
loopsThatClose(const Triangulation& t, const PlanarLayout& layout, const EdgeArray<char>& isCut)
{
	double size = 0.0;
	for (const Point2& p : layout.points)
		size = std::max({size, std::abs(p[0]), std::abs(p[1])});
	// Points that are not numbers are apart.
	const auto apart = [&](Halfedge a, Halfedge b) {
		return !(distance(layout[a], layout[b]) <= kTiny * size);
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

std::vector<Halfedge> layoutTree(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const EdgeArray<char>& isCut,
	Face root)
{
	const auto loss = [&](Halfedge across) {
		double longest = 0.0;
		for (const Halfedge h : {across, across.twin()})
			for (const Halfedge side : t.loop(h))
				longest = std::max(longest, lengths[side.edge()]);
		return longest / lengths[across.edge()];
	};
	// Ways into triangles by their loss. Of equal ones the lowest halfedge comes first, whichever
	// triangle it enters.
	DistanceQueue<Halfedge> queue;
	FaceArray<char> seen(t.faceCount(), 0);
	const auto leave = [&](Face f, double lost) {
		seen[f] = 1;
		for (const Halfedge h : t.halfedges(f)) {
			const Halfedge across = h.twin();
			if (!isCut[h.edge()] && !t.isExterior(across) && !seen[t.face(across)])
				queue.push(lost + loss(across), across);
		}
	};
	std::vector<Halfedge> order;
	leave(root, 0.0);
	while (!queue.empty()) {
		const auto [lost, h] = queue.pop();
		if (seen[t.face(h)])
			continue;
		order.push_back(h);
		leave(t.face(h), lost);
	}
	return order;
}

} // namespace ricci
