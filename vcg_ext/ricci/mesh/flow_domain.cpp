// SPDX-License-Identifier: GPL-3.0-or-later
#include "component.h"

#include "../base/numbers.h"
#include "../base/points.h"
#include "../base/tolerances.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
EdgeArray<char> edgesOf(const Triangulation& t, const SideMarks& sides)
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

/// Centre of mass of a boundary loop; the mean of its points where it has no length.
Point3 centreOf(const EmbeddedSurface& surface, Halfedge first)
{
	const Triangulation& t = surface.triangulation;
	std::vector<Halfedge> loop;
	for (const Halfedge h : t.loop(first))
		loop.push_back(h);
	Point3 centre{0, 0, 0}, mean{0, 0, 0};
	double length = 0.0;
	for (const Halfedge h : loop) {
		const Point3 &p = surface.positions[t.origin(h)], &q = surface.positions[t.target(h)];
		const double side = surface.lengths[h.edge()];
		length += side;
		centre += 0.5 * side * (p + q);
		mean += p / static_cast<double>(loop.size());
	}
	return length > 0.0 ? centre / length : mean;
}

/// Lengths in the capped surface where there are no positions.
void setFanLengths(const std::vector<Halfedge>& loops, FlowDomain& domain)
{
	const Triangulation& t = domain.surface.triangulation;
	EmbeddedSurface& capped = *domain.capped;
	for (const Edge e : t.edges())
		capped.lengths[e] = domain.surface.lengths[e];
	int centre = t.vertexCount();
	for (const Halfedge first : loops) {
		double around = 0.0, longest = 0.0;
		for (const Halfedge h : t.loop(first)) {
			around += domain.surface.lengths[h.edge()];
			longest = std::max(longest, domain.surface.lengths[h.edge()]);
		}
		for (const Edge e : capped.triangulation.edges())
			if (const auto ends = capped.triangulation.ends(e);
				std::max(ends[0], ends[1]) == Vertex(centre))
				capped.lengths[e] = 0.5 * (around / kPi + longest);
		++centre;
	}
}

/// The length up to which a loop is short.
double maxShortLength(const EmbeddedSurface& surface)
{
	const Triangulation& t = surface.triangulation;
	double area = 0.0;
	for (const Face f : t.faces())
		area += euclideanArea(
			{surface.lengths[t.halfedges(f)[0].edge()],
			 surface.lengths[t.halfedges(f)[1].edge()],
			 surface.lengths[t.halfedges(f)[2].edge()]});
	return kShortHole * std::sqrt(area) / std::max(1, 2 * surface.topology.type.genus - 2);
}

/// Exterior halfedges of the loops that are to be closed: one of each. See flowDomain().
/// \param isHole 1 on the edges of holes; empty: which loops are holes is told by their lengths
std::vector<Halfedge>
loopsToClose(const EmbeddedSurface& surface, const EdgeArray<char>& isHole, Holes holes)
{
	const Triangulation& t = surface.triangulation;
	const bool areShort = holes == Holes::ShortCapped;
	const double maxLength = areShort ? maxShortLength(surface) : kInfinity;
	std::vector<Halfedge> loops;
	Halfedge longest;
	double longestLength = -1.0;
	for (const Halfedge first : t.boundaryLoops()) {
		double length = 0.0;
		bool isMarked = true;
		for (const Halfedge h : t.loop(first)) {
			length += surface.lengths[h.edge()];
			isMarked &= isHole.empty() || isHole[h.edge()];
		}
		if (length > longestLength) {
			longestLength = length;
			longest = first;
		}
		if (isMarked && length <= maxLength)
			loops.push_back(first);
	}
	if (isHole.empty() && !areShort)
		loops.erase(std::remove(loops.begin(), loops.end(), longest), loops.end());
	return loops;
}

/// Closes \p loops of the surface of \p domain by fans round their centres of mass.
///
/// Positions serve only to give the edges of the fan a length, without them the radius of a circle as long as
/// the loop and half its longest edge; and its triangles may be thin: the
/// flow starts from the intrinsic Delaunay triangulation and makes the fan flat, inside and
/// together with the faces at its rim. A finer filling, by rings of ever fewer vertices, changes
/// the distortion of the surface in the fourth digit only. A plane hole that is star-shaped from
/// its centre is filled by the plane.
void capHoles(const std::vector<Halfedge>& loops, FlowDomain& domain)
{
	const Triangulation& t = domain.surface.triangulation;
	domain.onHole.assign(t.vertexCount(), 0);
	domain.holes = static_cast<int>(loops.size());
	if (loops.empty())
		return;
	VertexArray<Point3> positions = domain.surface.positions;
	std::vector<Triangle> triangles;
	for (const Face f : t.faces()) {
		const auto [a, b, c] = t.vertices(f);
		triangles.push_back({a.number(), b.number(), c.number()});
	}
	for (const Halfedge first : loops) {
		const int centre = positions.size();
		positions.push_back(centreOf(domain.surface, first));
		for (const Halfedge h : t.loop(first)) { // in the direction of the side of the cap there
			domain.onHole[t.origin(h)] = 1;
			triangles.push_back({t.origin(h).number(), t.target(h).number(), centre});
		}
	}
	domain.capped = embeddedSurface(std::move(positions), triangles);
	if (!domain.isEmbedded)
		setFanLengths(loops, domain);
}

} // namespace

FlowDomain flowDomain(const Component& component, Holes holes)
{
	FlowDomain domain;
	domain.surface = embeddedSurface(component.positions, component.triangles);
	const Triangulation& t = domain.surface.triangulation;
	domain.isEmbedded = component.lengths.empty();
	for (const Face f : t.faces())
		for (std::size_t k = 0; !domain.isEmbedded && k < 3; ++k)
			domain.surface.lengths[t.halfedges(f)[k].edge()] = component.sides(f)[k];
	domain.isDiagonal = edgesOf(t, component.diagonal);
	std::vector<Halfedge> loops;
	if (holes != Holes::Boundaries && !domain.surface.topology.type.isClosed())
		loops = loopsToClose(domain.surface, edgesOf(t, component.hole), holes);
	capHoles(loops, domain);
	return domain;
}

} // namespace ricci
