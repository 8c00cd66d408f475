// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_domain.h"

#include "../base/tolerances.h"
#include "../math/points.h"
#include "hole_caps.h"

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
