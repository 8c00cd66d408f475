// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_BOUNDARY_SPLIT_H
#define RICCI_BOUNDARY_SPLIT_H

#include "../surface/component.h"
#include "../surface/flow_domain.h"

#include <array>
#include <vector>

namespace ricci {

/// A component whose boundary edges may be split at their middles (paper 5.4), with the way back to
/// the corners of its own faces.
class SplitMesh
{
public:
	explicit SplitMesh(const Component& component);

	const VertexArray<Point3>& positions() const { return m_positions; }
	const std::vector<Triangle>& triangles() const { return m_triangles; }
	int splits() const { return m_splits; }

	/// Splits boundary edges of \p t, the triangulation of triangles(): at most one of each triangle.
	void split(const Triangulation& t, std::vector<Edge> edges);

	/// The halfedge of \p t, the triangulation of triangles(), at corner \p k of the component's face
	/// \p f.
	Halfedge corner(const Triangulation& t, Face f, std::size_t k) const;

private:
	void splitSide(int triangle, int side);

	VertexArray<Point3> m_positions;
	std::vector<Triangle> m_triangles;
	FaceArray<std::array<int, 3>> m_corner; ///< [face][corner] 3 triangle + corner of m_triangles
	int m_splits = 0;
};

} // namespace ricci

#endif
