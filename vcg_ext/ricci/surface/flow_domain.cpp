// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_domain.h"

#include "hole_caps.h"

#include <array>
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

} // namespace

FlowDomain flowDomain(const Component& component, Holes holes)
{
	FlowDomain domain;
	domain.surface = embeddedSurface(component.positions, component.triangles);
	const Triangulation& t = domain.surface.triangulation;
	domain.isDiagonal = edgesOf(t, component.diagonal);
	domain.onHole.assign(domain.surface.triangulation.vertexCount(), 0);
	if (holes == Holes::Capped && domain.surface.topology.loops.size() > 1) {
		CappedSurface capped = capHoles(t, domain.surface.positions, edgesOf(t, component.hole));
		domain.capped = embeddedSurface(std::move(capped.positions), capped.triangles);
		domain.onHole = std::move(capped.onHole);
		domain.holes = capped.holes;
	}
	return domain;
}

} // namespace ricci
