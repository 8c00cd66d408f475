// SPDX-License-Identifier: GPL-3.0-or-later
#include "boundary_split.h"

#include <algorithm>
#include <utility>

namespace ricci {

SplitMesh::SplitMesh(const Component& component) :
		m_positions(component.positions), m_triangles(component.triangles),
		m_corner(component.triangles.size())
{
	for (const Face f : m_corner.indices())
		for (int k = 0; k < 3; ++k)
			m_corner[f][positionOf(k)] = 3 * f.number() + k;
}

void SplitMesh::split(const Triangulation& t, std::vector<Edge> edges)
{
	std::sort(edges.begin(), edges.end());
	edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
	FaceArray<char> touched(t.faceCount(), 0);
	for (const Edge e : edges) {
		const Halfedge h = t.isExterior(e.halfedge()) ? e.halfedge().twin() : e.halfedge();
		const Face f = t.face(h);
		if (touched[f])
			continue;
		touched[f] = 1;
		const Triangle& corners = m_triangles[positionOf(f)];
		const auto side = std::find(corners.begin(), corners.end(), t.origin(h).number());
		splitSide(f.number(), static_cast<int>(side - corners.begin()));
		++m_splits;
	}
}

void SplitMesh::splitSide(int triangle, int side)
{
	Triangle& t = m_triangles[positionOf(triangle)];
	const int i = t[positionOf(side)], j = t[positionOf((side + 1) % 3)];
	const int apex = t[positionOf((side + 2) % 3)];
	const int middle = m_positions.size(), added = static_cast<int>(m_triangles.size());
	const Point3 &a = m_positions[Vertex(i)], &b = m_positions[Vertex(j)];
	m_positions.push_back(Point3{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])});
	t = {i, middle, apex};
	m_triangles.push_back({middle, j, apex});
	for (std::array<int, 3>& corners : m_corner)
		for (int& c : corners) {
			if (c / 3 != triangle)
				continue;
			const int k = c % 3;
			// The triangle now starts at i; its corner at j is one of the added triangle.
			c = k == (side + 1) % 3 ? 3 * added + 1 : 3 * triangle + (k == side ? 0 : 2);
		}
}

Halfedge SplitMesh::corner(const Triangulation& t, Face f, std::size_t k) const
{
	const int c = m_corner[f][k];
	return t.halfedges(Face(c / 3))[positionOf(c % 3)];
}

} // namespace ricci
