// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation.h"

#include "../error.h"
#include "../math/bucket_sort.h"

#include <algorithm>

namespace ricci {

namespace {

/// For each side of each triangle the side that runs the other way between the same two vertices.
std::vector<int> sidesByVertexPair(const std::vector<Triangle>& triangles)
{
	struct Side
	{
		int low, high, index;
		bool ascending;
	};
	std::vector<Side> sides;
	sides.reserve(3 * triangles.size());
	for (std::size_t f = 0; f < triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const int a = triangles[f][k], b = triangles[f][(k + 1) % 3];
			sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(3 * f + k), a < b});
		}
	bucketSort(
		sides,
		[](const Side& s) { return s.low; },
		[](const Side& a, const Side& b) {
			return a.high != b.high ? a.high < b.high : a.index < b.index;
		});
	std::vector<int> glued(sides.size(), -1);
	for (std::size_t first = 0, last; first < sides.size(); first = last) {
		for (last = first; last < sides.size() && sides[last].low == sides[first].low &&
						   sides[last].high == sides[first].high;)
			++last;
		if (last - first == 1)
			continue;
		if (last - first > 2 || sides[first].ascending == sides[first + 1].ascending)
			throw InvalidMesh(
				InvalidMesh::IncoherentEdge, last - first, {sides[first].low, sides[first].high});
		glued[positionOf(sides[first].index)] = sides[first + 1].index;
		glued[positionOf(sides[first + 1].index)] = sides[first].index;
	}
	return glued;
}

} // namespace

Triangulation::Triangulation(int vertexCount, const std::vector<Triangle>& triangles)
{
	glue(vertexCount, triangles, sidesByVertexPair(triangles));
}

Triangulation::Triangulation(
	int vertexCount, const std::vector<Triangle>& triangles, const std::vector<int>& glued)
{
	glue(vertexCount, triangles, glued);
}

void Triangulation::glue(
	int vertexCount, const std::vector<Triangle>& triangles, const std::vector<int>& glued)
{
	const std::size_t sideCount = 3 * triangles.size();
	std::vector<Halfedge> halfedgeOf(sideCount);
	int count = 0;
	for (std::size_t side = 0; side < sideCount; ++side) {
		if (halfedgeOf[side].isValid())
			continue;
		halfedgeOf[side] = Halfedge(count);
		if (glued[side] >= 0)
			halfedgeOf[positionOf(glued[side])] = Halfedge(count + 1);
		count += 2;
	}
	m_next.assign(count, Halfedge());
	m_origin.assign(count, Vertex());
	m_face.assign(count, Face());
	m_faceHalfedge.resize(triangles.size());
	for (const Face f : faces()) {
		const std::size_t side = 3 * positionOf(f);
		m_faceHalfedge[f] = halfedgeOf[side];
		for (std::size_t k = 0; k < 3; ++k) {
			const Halfedge h = halfedgeOf[side + k];
			m_next[h] = halfedgeOf[side + (k + 1) % 3];
			m_origin[h] = Vertex(triangles[positionOf(f)][k]);
			m_face[h] = f;
			m_origin[h.twin()] = Vertex(triangles[positionOf(f)][(k + 1) % 3]);
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

} // namespace ricci
