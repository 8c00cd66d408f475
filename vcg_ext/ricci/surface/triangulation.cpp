// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation.h"

#include "../error.h"
#include "../numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace ricci {

double distance(const Point3& a, const Point3& b)
{
	return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

namespace {

/// For each side of each triangle the side that runs the other way between the same two vertices.
std::vector<int> sidesByVertexPair(const std::vector<Triangle>& triangles)
{
	struct Side
	{
		std::int64_t low, high;
		int index;
		bool ascending;
	};
	std::vector<Side> sides;
	sides.reserve(3 * triangles.size());
	for (std::size_t f = 0; f < triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const int a = triangles[f][k], b = triangles[f][(k + 1) % 3];
			sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(3 * f + k), a < b});
		}
	std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
		return a.low != b.low     ? a.low < b.low
			   : a.high != b.high ? a.high < b.high
								  : a.index < b.index;
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
				"The edge between vertices " + std::to_string(sides[first].low) + " and " +
				std::to_string(sides[first].high) + " is not shared by two coherent triangles.");
		glued[at(sides[first].index)] = sides[first + 1].index;
		glued[at(sides[first + 1].index)] = sides[first].index;
	}
	return glued;
}

} // namespace

Triangulation::Triangulation(int vertexCount, const std::vector<Triangle>& triangles) :
		m_vertexCount(vertexCount)
{
	glue(triangles, sidesByVertexPair(triangles));
}

Triangulation::Triangulation(
	int vertexCount, const std::vector<Triangle>& triangles, const std::vector<int>& glued) :
		m_vertexCount(vertexCount)
{
	glue(triangles, glued);
}

void Triangulation::glue(const std::vector<Triangle>& triangles, const std::vector<int>& glued)
{
	const std::size_t sideCount = 3 * triangles.size();
	std::vector<int> halfedgeOf(sideCount, -1);
	int count = 0;
	for (std::size_t side = 0; side < sideCount; ++side) {
		if (halfedgeOf[side] >= 0)
			continue;
		halfedgeOf[side] = count;
		if (glued[side] >= 0)
			halfedgeOf[at(glued[side])] = count + 1;
		count += 2;
	}
	m_next.assign(at(count), -1);
	m_origin.assign(at(count), -1);
	m_face.assign(at(count), kOutside);
	m_faceHalfedge.resize(triangles.size());
	for (std::size_t f = 0; f < triangles.size(); ++f) {
		m_faceHalfedge[f] = halfedgeOf[3 * f];
		for (std::size_t k = 0; k < 3; ++k) {
			const int h = halfedgeOf[3 * f + k];
			m_next[at(h)] = halfedgeOf[3 * f + (k + 1) % 3];
			m_origin[at(h)] = triangles[f][k];
			m_face[at(h)] = static_cast<int>(f);
			m_origin[at(twin(h))] = triangles[f][(k + 1) % 3];
		}
	}
	// Turning about the end of an outer halfedge, through the triangles there, leads to the next.
	for (int h = 0; h < count; ++h) {
		if (!isOuter(h))
			continue;
		int turn = twin(h);
		do
			turn = twin(previous(turn));
		while (!isOuter(turn));
		m_next[at(h)] = turn;
	}
}

std::vector<char> Triangulation::boundaryVertices() const
{
	std::vector<char> boundary(at(m_vertexCount), 0);
	for (int h = 0; h < halfedgeCount(); ++h)
		if (isOuter(h))
			boundary[at(origin(h))] = 1;
	return boundary;
}

std::vector<int> Triangulation::boundaryLoops() const
{
	std::vector<int> loops;
	std::vector<char> seen(m_next.size(), 0);
	for (int h = 0; h < halfedgeCount(); ++h) {
		if (!isOuter(h) || seen[at(h)])
			continue;
		loops.push_back(h);
		for (int g = h; !seen[at(g)]; g = next(g))
			seen[at(g)] = 1;
	}
	return loops;
}

int Triangulation::eulerCharacteristic() const
{
	std::vector<char> used(at(m_vertexCount), 0);
	for (int v : m_origin)
		used[at(v)] = 1;
	return static_cast<int>(std::count(used.begin(), used.end(), 1)) - edgeCount() + faceCount();
}

/// Writes the two triangles (h, quad[0], quad[1]) and (twin(h), quad[2], quad[3]), with h running
/// from \p from to \p to.
void Triangulation::rewire(int h, std::array<int, 4> quad, int from, int to)
{
	const int t = twin(h), f = face(h), g = face(t);
	const std::array<int, 3> left{h, quad[0], quad[1]}, right{t, quad[2], quad[3]};
	for (std::size_t k = 0; k < 3; ++k) {
		m_next[at(left[k])] = left[(k + 1) % 3];
		m_face[at(left[k])] = f;
		m_next[at(right[k])] = right[(k + 1) % 3];
		m_face[at(right[k])] = g;
	}
	m_faceHalfedge[at(f)] = h;
	m_faceHalfedge[at(g)] = t;
	m_origin[at(h)] = from;
	m_origin[at(t)] = to;
}

void Triangulation::flip(int e)
{
	const int h = 2 * e, t = h + 1;
	const int jk = next(h), ki = next(jk), il = next(t), lj = next(il);
	rewire(h, {ki, il, lj, jk}, origin(lj), origin(ki));
}

void Triangulation::unflip(int e)
{
	const int h = 2 * e, t = h + 1;
	const int ki = next(h), il = next(ki), lj = next(t), jk = next(lj);
	rewire(h, {jk, ki, il, lj}, origin(il), origin(jk));
}

} // namespace ricci
