// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_domain.h"

#include "../base/tolerances.h"
#include "../math/points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace ricci {

EdgeArray<double> edgeLengths(const Triangulation& t, const VertexArray<Point3>& positions)
{
	EdgeArray<double> lengths(t.edgeCount());
	for (const Edge e : t.edges()) {
		const auto [i, j] = t.ends(e);
		lengths[e] = distance(positions[i], positions[j]);
	}
	return lengths;
}

EmbeddedSurface
embeddedSurface(VertexArray<Point3> positions, const std::vector<Triangle>& triangles)
{
	EmbeddedSurface surface;
	surface.triangulation = Triangulation(positions.size(), triangles);
	surface.lengths = edgeLengths(surface.triangulation, positions);
	surface.topology = topologyOf(surface.triangulation);
	surface.positions = std::move(positions);
	return surface;
}

namespace {

/// Centre of mass of a closed line; the mean of its points where it has no length.
Point3 centreOf(const std::vector<Vertex>& loop, const VertexArray<Point3>& positions)
{
	Point3 centre{0, 0, 0}, mean{0, 0, 0};
	double length = 0.0;
	for (std::size_t i = 0; i < loop.size(); ++i) {
		const Point3 &p = positions[loop[i]], &q = positions[loop[(i + 1) % loop.size()]];
		const double side = distance(p, q);
		length += side;
		centre += 0.5 * side * (p + q);
		mean += p / static_cast<double>(loop.size());
	}
	return length > 0.0 ? centre / length : mean;
}

/// The edges with a marked side; empty without marks.
EdgeArray<char> edgesOf(const Triangulation& t, const std::vector<std::array<char, 3>>& sides)
{
	EdgeArray<char> edges;
	if (sides.empty())
		return edges;
	edges.assign(t.edgeCount(), 0);
	for (const Face f : t.faces())
		for (std::size_t k = 0; k < 3; ++k)
			if (sides[positionOf(f)][k])
				edges[t.halfedges(f)[k].edge()] = 1;
	return edges;
}

/// The length up to which a loop is short.
double maxShortLength(const EmbeddedSurface& surface)
{
	const Triangulation& t = surface.triangulation;
	double area = 0.0;
	for (const Face f : t.faces()) {
		const auto [a, b, c] = t.vertices(f);
		const Point3& p = surface.positions[a];
		area += 0.5 * length(cross(surface.positions[b] - p, surface.positions[c] - p));
	}
	return kShortHole * std::sqrt(area) / std::max(1, 2 * surface.topology.type.genus - 2);
}

/// The edges of the short loops, of those whose edges are all marked in \p isHole, or of all where that is
/// empty.
EdgeArray<char> shortLoops(const EmbeddedSurface& surface, const EdgeArray<char>& isHole)
{
	const Triangulation& t = surface.triangulation;
	const double maxLength = maxShortLength(surface);
	EdgeArray<char> isShort(t.edgeCount(), 0);
	for (const Halfedge first : t.boundaryLoops()) {
		double loopLength = 0.0;
		bool isMarked = true;
		for (const Halfedge h : t.loop(first)) {
			loopLength += surface.lengths[h.edge()];
			isMarked &= isHole.empty() || isHole[h.edge()];
		}
		if (isMarked && loopLength <= maxLength)
			for (const Halfedge h : t.loop(first))
				isShort[h.edge()] = 1;
	}
	return isShort;
}

} // namespace

CappedSurface capHoles(
	const Triangulation& t, const VertexArray<Point3>& positions, const EdgeArray<char>& isHole)
{
	CappedSurface capped;
	capped.positions = positions;
	capped.onHole.assign(t.vertexCount(), 0);
	for (const Face f : t.faces()) {
		const auto [a, b, c] = t.vertices(f);
		capped.triangles.push_back({a.number(), b.number(), c.number()});
	}
	// An exterior halfedge has the direction of the side of the cap there.
	std::vector<std::vector<Vertex>> loops;
	std::vector<char> isClosed; // [loop]
	std::size_t longest = 0;
	double maxLength = -1.0;
	for (const Halfedge first : t.boundaryLoops()) {
		std::vector<Vertex> loop;
		double length = 0.0;
		bool all = true;
		for (const Halfedge h : t.loop(first)) {
			all &= isHole.empty() || isHole[h.edge()];
			loop.push_back(t.origin(h));
			length += distance(positions[t.origin(h)], positions[t.target(h)]);
		}
		if (length > maxLength) {
			maxLength = length;
			longest = loops.size();
		}
		isClosed.push_back(all);
		loops.push_back(std::move(loop));
	}
	if (isHole.empty() && !loops.empty())
		isClosed[longest] = 0;
	for (std::size_t l = 0; l < loops.size(); ++l) {
		if (!isClosed[l])
			continue;
		const std::vector<Vertex>& loop = loops[l];
		const int centre = capped.positions.size();
		capped.positions.push_back(centreOf(loop, positions));
		for (std::size_t i = 0; i < loop.size(); ++i) {
			capped.onHole[loop[i]] = 1;
			capped.triangles.push_back(
				{loop[i].number(), loop[(i + 1) % loop.size()].number(), centre});
		}
		++capped.holes;
	}
	return capped;
}

DoubleSurface doubleOf(const Triangulation& t)
{
	const int faceCount = t.faceCount();
	const VertexArray<char> boundary = t.boundaryVertices();
	DoubleSurface d;
	int vertexCount = t.vertexCount();
	d.mirror.resize(vertexCount);
	for (const Vertex v : t.vertices())
		d.mirror[v] = boundary[v] ? v : Vertex(vertexCount++);
	d.mirror.resize(vertexCount);
	for (const Vertex v : t.vertices())
		d.mirror[d.mirror[v]] = v;

	// Side k of a face runs from corner k to k + 1; side 2 - k of its image mirrors it.
	HalfedgeArray<Corner> side(t.halfedgeCount());
	Array<Triangle> triangles(2 * faceCount);
	for (const Face f : t.faces()) {
		const auto h = t.halfedges(f);
		const auto v = t.vertices(f);
		for (const Corner c : cornersOf(f.number())) {
			side[h[c.index()]] = c;
			triangles[c] = v[c.index()].number();
		}
		triangles[faceCount + f.number()] = {
			d.mirror[v[0]].number(), d.mirror[v[2]].number(), d.mirror[v[1]].number()};
	}
	const auto image = [&](Corner c) {
		return Corner(faceCount + c.face(), 2 - static_cast<int>(c.index()));
	};
	CornerArray<Corner> glued(6 * faceCount);
	for (const Halfedge h : t.interiorHalfedges()) {
		const Corner s = side[h], across = side[h.twin()];
		glued[s] = across.isValid() ? across : image(s);
		glued[image(s)] = across.isValid() ? image(across) : s;
	}
	d.triangulation = Triangulation(vertexCount, triangles.values(), glued);

	d.edgeOf.resize(d.triangulation.edgeCount());
	for (const Face f : t.faces()) {
		const auto h = d.triangulation.halfedges(f);
		const auto mirrored = d.triangulation.halfedges(Face(faceCount + f.number()));
		for (std::size_t k = 0; k < 3; ++k) {
			const Edge e = h[k].edge();
			d.edgeOf[e] = e;
			d.edgeOf[mirrored[2 - k].edge()] = e;
		}
	}
	return d;
}

FlowDomain flowDomain(const Component& component, Holes holes)
{
	FlowDomain domain;
	domain.surface = embeddedSurface(component.positions, component.triangles);
	const Triangulation& t = domain.surface.triangulation;
	domain.isDiagonal = edgesOf(t, component.diagonal);
	domain.onHole.assign(domain.surface.triangulation.vertexCount(), 0);
	if (holes == Holes::Boundaries || domain.surface.topology.type.isClosed())
		return domain;
	EdgeArray<char> isHole = edgesOf(t, component.hole);
	if (holes == Holes::ShortCapped)
		isHole = shortLoops(domain.surface, isHole);
	CappedSurface capped = capHoles(t, domain.surface.positions, isHole);
	if (capped.holes == 0)
		return domain;
	domain.capped = embeddedSurface(std::move(capped.positions), capped.triangles);
	domain.onHole = std::move(capped.onHole);
	domain.holes = capped.holes;
	return domain;
}

} // namespace ricci
