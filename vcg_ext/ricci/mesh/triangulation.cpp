// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation.h"

#include "../base/graphs.h"
#include "../error.h"
#include "sides.h"

#include <algorithm>
#include <utility>

namespace ricci {

namespace {

/// For each side of each triangle the side that runs the other way between the same two vertices.
CornerArray<Corner> sidesByVertexPair(const std::vector<Triangle>& triangles)
{
	const Sides sides(triangles);
	sides.forEdges([&](const auto& edge) {
		if (edge.size() == 1 || sides.across()[edge[0]].isValid())
			return;
		const Triangle& t = triangles[positionOf(edge[0].face())];
		const auto [low, high] = std::minmax({t[edge[0].index()], t[edge[0].next().index()]});
		throw InvalidMesh(InvalidMesh::IncoherentEdge, positionOf(edge.size()), {low, high});
	});
	return sides.across();
}

} // namespace

Triangulation::Triangulation(int vertexCount, const std::vector<Triangle>& triangles) :
		Triangulation(vertexCount, triangles, sidesByVertexPair(triangles))
{
}

Triangulation::Triangulation(
	int vertexCount, const std::vector<Triangle>& triangles, const CornerArray<Corner>& glued)
{
	CornerArray<Halfedge> halfedgeOf(glued.size());
	int count = 0;
	for (const Corner side : glued.indices()) {
		if (halfedgeOf[side].isValid())
			continue;
		halfedgeOf[side] = Halfedge(count);
		if (glued[side].isValid())
			halfedgeOf[glued[side]] = Halfedge(count + 1);
		count += 2;
	}
	m_next.assign(count, Halfedge());
	m_origin.assign(count, Vertex());
	m_face.assign(count, Face());
	m_faceHalfedge.resize(triangles.size());
	for (const Face f : faces()) {
		const Triangle& t = triangles[positionOf(f)];
		m_faceHalfedge[f] = halfedgeOf[Corner(f.number(), 0)];
		for (const Corner c : cornersOf(f.number())) {
			const Halfedge h = halfedgeOf[c];
			m_next[h] = halfedgeOf[c.next()];
			m_origin[h] = Vertex(t[c.index()]);
			m_face[h] = f;
			m_origin[h.twin()] = Vertex(t[c.next().index()]);
		}
	}
	// Turning about the end of an exterior halfedge, through the triangles there, leads to the next.
	for (const Halfedge h : exteriorHalfedges()) {
		Halfedge turn = h.twin();
		do
			turn = previous(turn).twin();
		while (!isExterior(turn));
		m_next[h] = turn;
	}
	m_vertexHalfedge.resize(vertexCount);
	for (int i = count; i-- > 0;) {
		const Halfedge h(i);
		if (isExterior(h))
			continue;
		Halfedge& known = m_vertexHalfedge[origin(h)];
		if (!known.isValid() || !isExterior(known.twin()))
			known = h;
	}
}

std::vector<Halfedge> Triangulation::halfedgesThatAre(bool exterior) const
{
	std::vector<Halfedge> found;
	for (const Halfedge h : halfedges())
		if (isExterior(h) == exterior)
			found.push_back(h);
	return found;
}

VertexArray<char> Triangulation::boundaryVertices() const
{
	VertexArray<char> boundary(vertexCount(), 0);
	for (const Halfedge h : exteriorHalfedges())
		boundary[origin(h)] = 1;
	return boundary;
}

std::vector<Halfedge> Triangulation::boundaryLoops() const
{
	std::vector<Halfedge> loops;
	HalfedgeArray<char> seen(halfedgeCount(), 0);
	for (const Halfedge h : exteriorHalfedges()) {
		if (seen[h])
			continue;
		loops.push_back(h);
		for (const Halfedge g : loop(h))
			seen[g] = 1;
	}
	return loops;
}

int Triangulation::eulerCharacteristic() const
{
	const auto used = std::count_if(
		m_vertexHalfedge.begin(), m_vertexHalfedge.end(), [](Halfedge h) { return h.isValid(); });
	return static_cast<int>(used) - edgeCount() + faceCount();
}

/// Writes the two triangles (h, quad[0], quad[1]) and (twin, quad[2], quad[3]), with h running from
/// \p from to \p to.
void Triangulation::rewire(Halfedge h, std::array<Halfedge, 4> quad, Vertex from, Vertex to)
{
	const Halfedge t = h.twin();
	const Face f = face(h), g = face(t);
	// Vertices must not name h or its twin, which leave them.
	if (m_vertexHalfedge[origin(h)] == h)
		m_vertexHalfedge[origin(h)] = next(t);
	if (m_vertexHalfedge[origin(t)] == t)
		m_vertexHalfedge[origin(t)] = next(h);
	const std::array<Halfedge, 3> left{h, quad[0], quad[1]}, right{t, quad[2], quad[3]};
	for (std::size_t k = 0; k < 3; ++k) {
		m_next[left[k]] = left[(k + 1) % 3];
		m_face[left[k]] = f;
		m_next[right[k]] = right[(k + 1) % 3];
		m_face[right[k]] = g;
	}
	m_faceHalfedge[f] = h;
	m_faceHalfedge[g] = t;
	m_origin[h] = from;
	m_origin[t] = to;
}

void Triangulation::flip(Edge e)
{
	const auto [jk, ki, il, lj] = quad(e);
	rewire(e.halfedge(), {ki, il, lj, jk}, origin(lj), origin(ki));
}

void Triangulation::unflip(Edge e)
{
	const auto [ki, il, lj, jk] = quad(e);
	rewire(e.halfedge(), {jk, ki, il, lj}, origin(il), origin(jk));
}

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
