// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_PLANAR_EDGES_H
#define RICCI_TESTS_PLANAR_EDGES_H

#include <ricci/base/points.h>
#include <ricci/mesh/surface_mesh.h>
#include <ricci/mesh/triangulation.h>

#include <array>

namespace ricci::testing {

/// Straight edges between the vertices of a mesh over the plane.
class PlanarEdges
{
public:
	using Ends = std::array<Vertex, 2>;

	explicit PlanarEdges(const SurfaceMesh& mesh)
	{
		for (const Point3& p : mesh.positions)
			m_points.push_back({p[0], p[1]});
	}

	/// Which side of the line from a to b v lies on: 1 on its left.
	int side(Vertex a, Vertex b, Vertex v) const
	{
		return orientation(m_points[a], m_points[b], m_points[v]);
	}

	/// Whether a flip of e keeps the triangulation in the plane.
	bool isConvexQuad(const Triangulation& t, Edge e) const
	{
		if (!t.isFlippable(e))
			return false;
		const auto [i, j] = t.ends(e);
		const Vertex k = t.apex(e.halfedge()), l = t.apex(e.halfedge().twin());
		return side(l, k, i) > 0 && side(l, k, j) < 0;
	}

	bool cross(const Ends& a, const Ends& b) const
	{
		return side(a[0], a[1], b[0]) * side(a[0], a[1], b[1]) < 0 &&
			   side(b[0], b[1], a[0]) * side(b[0], b[1], a[1]) < 0;
	}

	/// Where b crosses a, from the beginning of a (0) to its end (1).
	double along(const Ends& a, const Ends& b) const
	{
		const auto area = [&](Vertex x) {
			return doubledArea(m_points[b[0]], m_points[b[1]], m_points[x]);
		};
		return area(a[0]) / (area(a[0]) - area(a[1]));
	}

private:
	VertexArray<Point2> m_points;
};

} // namespace ricci::testing

#endif
