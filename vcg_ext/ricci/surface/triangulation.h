// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TRIANGULATION_H
#define RICCI_TRIANGULATION_H

#include "surface_mesh.h"

#include <array>
#include <vector>

namespace ricci {

/// Triangles glued along their sides: a connected or disconnected, oriented surface, with or
/// without boundary. Loops, several edges between the same two vertices and triangles glued to
/// themselves are legal, so an edge is always named by its index, never by its two vertices.
///
/// Halfedges come in pairs: twin(h) = h ^ 1, edge(h) = h >> 1. A halfedge on the outer side of a
/// boundary edge has face kOutside; the outer halfedges of one boundary loop are linked by next().
/// Only flip() and unflip() change a triangulation; twins and the number of elements never change.
class Triangulation
{
public:
	static constexpr int kOutside = -1;

	Triangulation() = default;

	/// Glues triangles along equal vertex pairs. The triangles must be coherently oriented and
	/// manifold (see splitIntoComponents()); halfedge(f, k) then starts at triangles[f][k].
	/// \throw InvalidMesh if an oriented vertex pair occurs twice.
	Triangulation(int vertexCount, const std::vector<Triangle>& triangles);

	/// Glues triangles along explicit pairs of sides, for surfaces whose edges are not determined
	/// by their vertices. Side 3 f + k runs from triangles[f][k] to triangles[f][(k + 1) % 3]; \p
	/// glued[side] is the other side, or -1 on the boundary.
	Triangulation(
		int vertexCount, const std::vector<Triangle>& triangles, const std::vector<int>& glued);

	int vertexCount() const { return m_vertexCount; }
	int faceCount() const { return static_cast<int>(m_faceHalfedge.size()); }
	int edgeCount() const { return static_cast<int>(m_next.size() / 2); }
	int halfedgeCount() const { return static_cast<int>(m_next.size()); }

	static int twin(int h) { return h ^ 1; }
	static int edge(int h) { return h >> 1; }

	int next(int h) const { return m_next[static_cast<std::size_t>(h)]; }
	int origin(int h) const { return m_origin[static_cast<std::size_t>(h)]; }
	int target(int h) const { return origin(twin(h)); }
	int face(int h) const { return m_face[static_cast<std::size_t>(h)]; }

	/// The halfedge before \p h in its triangle; \p h must not be outer.
	int previous(int h) const { return next(next(h)); }

	/// One halfedge of face \p f.
	int halfedge(int f) const { return m_faceHalfedge[static_cast<std::size_t>(f)]; }

	/// The three halfedges of face \p f in cyclic order.
	std::array<int, 3> halfedges(int f) const
	{
		const int h = halfedge(f);
		return {h, next(h), previous(h)};
	}

	bool isOuter(int h) const { return face(h) == kOutside; }
	bool isBoundaryEdge(int e) const { return isOuter(2 * e) || isOuter(2 * e + 1); }

	/// For each vertex, whether it lies on the boundary.
	std::vector<char> boundaryVertices() const;

	/// One outer halfedge of each boundary loop, in order of the lowest halfedge index.
	std::vector<int> boundaryLoops() const;

	/// V - E + F, vertices without a face not counted.
	int eulerCharacteristic() const;

	/// Whether edge \p e has two different triangles, so that flip() is defined.
	bool isFlippable(int e) const
	{
		const int f = face(2 * e), g = face(2 * e + 1);
		return f != kOutside && g != kOutside && f != g;
	}

	/// Replaces edge \p e = ij, between triangles ijk and jil, by the other diagonal lk.
	/// isFlippable(e) must hold. Halfedge 2 e then runs from l to k.
	void flip(int e);

	/// Undoes flip(e) exactly, halfedge for halfedge; only which halfedge halfedge(f) names may differ.
	void unflip(int e);

private:
	void glue(const std::vector<Triangle>& triangles, const std::vector<int>& glued);
	void rewire(int h, std::array<int, 4> quad, int from, int to);

	int m_vertexCount = 0;
	std::vector<int> m_next, m_origin, m_face; // by halfedge
	std::vector<int> m_faceHalfedge;           // by face
};

} // namespace ricci

#endif
