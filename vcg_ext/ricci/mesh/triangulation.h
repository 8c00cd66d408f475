// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TRIANGULATION_H
#define RICCI_TRIANGULATION_H

#include "../base/surface_type.h"
#include "elements.h"
#include "surface_mesh.h"

#include <array>
#include <vector>

namespace ricci {

/// Triangles glued along their sides: a connected or disconnected, oriented surface, with or
/// without boundary. Loops, several edges between the same two vertices and triangles glued to
/// themselves are legal, so an edge is always named by its index, never by its two vertices.
///
/// A halfedge on the other side of a boundary edge is exterior: it has no face. The exterior
/// halfedges of one boundary loop are linked by next(). Only flip() and unflip() change a
/// triangulation; twins and the number of elements never change.
class Triangulation
{
public:
	Triangulation() = default;

	/// Glues triangles along equal vertex pairs; halfedges(Face(f))[k] then starts at
	/// triangles[f][k].
	/// \pre the triangles are coherently oriented and manifold (see splitIntoComponents())
	/// \throw InvalidMesh if an oriented vertex pair occurs twice.
	Triangulation(int vertexCount, const std::vector<Triangle>& triangles);

	/// Glues triangles along explicit pairs of sides, for surfaces whose edges are not determined
	/// by their vertices. \p glued[side] is the other side, or none on the boundary.
	Triangulation(
		int vertexCount, const std::vector<Triangle>& triangles, const CornerArray<Corner>& glued);

	int vertexCount() const { return m_vertexHalfedge.size(); }
	int faceCount() const { return m_faceHalfedge.size(); }
	int edgeCount() const { return m_next.size() / 2; }
	int halfedgeCount() const { return m_next.size(); }

	IndexRange<Vertex> vertices() const { return IndexRange<Vertex>(vertexCount()); }
	IndexRange<Face> faces() const { return IndexRange<Face>(faceCount()); }
	IndexRange<Edge> edges() const { return IndexRange<Edge>(edgeCount()); }
	IndexRange<Halfedge> halfedges() const { return IndexRange<Halfedge>(halfedgeCount()); }

	Halfedge next(Halfedge h) const { return m_next[h]; }
	Vertex origin(Halfedge h) const { return m_origin[h]; }
	Vertex target(Halfedge h) const { return origin(h.twin()); }

	/// The triangle on the left of \p h; none if \p h is exterior.
	Face face(Halfedge h) const { return m_face[h]; }

	/// The halfedge before \p h in its triangle.
	/// \pre \p h is not exterior
	Halfedge previous(Halfedge h) const { return next(next(h)); }

	/// The corner of the triangle of \p h that is opposite to it.
	/// \pre \p h is not exterior
	Vertex apex(Halfedge h) const { return origin(previous(h)); }

	/// Both ends of an edge, in its direction.
	std::array<Vertex, 2> ends(Edge e) const
	{
		return {origin(e.halfedge()), target(e.halfedge())};
	}

	/// One halfedge of face \p f.
	Halfedge halfedge(Face f) const { return m_faceHalfedge[f]; }

	/// The three halfedges of face \p f in cyclic order.
	std::array<Halfedge, 3> halfedges(Face f) const
	{
		const Halfedge h = halfedge(f);
		return {h, next(h), previous(h)};
	}

	/// The corner at which \p h begins: \p h is halfedges(face(h))[corner(h).index()].
	/// \pre \p h is not exterior
	Corner corner(Halfedge h) const
	{
		const Face f = face(h);
		const Halfedge first = halfedge(f);
		return {f.number(), h == first ? 0 : h == next(first) ? 1 : 2};
	}

	/// The three corners of face \p f: the origins of halfedges(f).
	std::array<Vertex, 3> vertices(Face f) const
	{
		const auto h = halfedges(f);
		return {origin(h[0]), origin(h[1]), origin(h[2])};
	}

	/// A halfedge that leaves \p v inside the surface; on the boundary the one whose twin is
	/// exterior. None if \p v has no face.
	Halfedge halfedge(Vertex v) const { return m_vertexHalfedge[v]; }

	bool isExterior(Halfedge h) const { return !face(h).isValid(); }
	bool isBoundary(Edge e) const
	{
		return isExterior(e.halfedge()) || isExterior(e.halfedge().twin());
	}

	/// The next of the halfedges that leave the origin of \p h, clockwise.
	Halfedge clockwise(Halfedge h) const { return next(h.twin()); }

	/// Halfedges for a range-based loop, from \p first until it comes round, by \p step; its own iterator.
	template<Halfedge (Triangulation::*step)(Halfedge) const>
	class Circulator
	{
	public:
		Circulator(const Triangulation& t, Halfedge first, bool isDone) :
				m_t(t), m_h(first), m_first(first), m_isDone(isDone)
		{
		}
		Circulator(const Triangulation& t, Halfedge first) : Circulator(t, first, !first.isValid())
		{
		}
		Circulator begin() const { return *this; }
		Circulator end() const { return {m_t, m_first, true}; }

		Halfedge operator*() const { return m_h; }
		Circulator& operator++()
		{
			m_h = (m_t.*step)(m_h);
			m_isDone = m_h == m_first;
			return *this;
		}
		bool operator!=(const Circulator& other) const { return m_isDone != other.m_isDone; }

	private:
		const Triangulation& m_t;
		Halfedge m_h, m_first;
		bool m_isDone;
	};

	using Around = Circulator<&Triangulation::clockwise>;
	using Loop = Circulator<&Triangulation::next>;

	/// The halfedges that leave \p v, clockwise from halfedge(v), exterior ones included. None if
	/// \p v has no face.
	Around around(Vertex v) const { return {*this, halfedge(v)}; }

	/// The halfedges of the triangle, or of the boundary loop, of \p h: from \p h on by next().
	Loop loop(Halfedge h) const { return {*this, h}; }

	/// The halfedges that are exterior, and all others, in increasing order.
	std::vector<Halfedge> exteriorHalfedges() const { return halfedgesThatAre(true); }
	std::vector<Halfedge> interiorHalfedges() const { return halfedgesThatAre(false); }

	/// For each vertex, whether it lies on the boundary.
	VertexArray<char> boundaryVertices() const;

	/// One exterior halfedge of each boundary loop, in order of the lowest halfedge number.
	std::vector<Halfedge> boundaryLoops() const;

	/// V - E + F, vertices without a face not counted.
	int eulerCharacteristic() const;

	/// Whether edge \p e has two different triangles, so that flip() is defined.
	bool isFlippable(Edge e) const
	{
		const Face f = face(e.halfedge()), g = face(e.halfedge().twin());
		return f.isValid() && g.isValid() && f != g;
	}

	/// The other four sides of the two triangles at edge \p e, in the order next and previous of its
	/// halfedge, next and previous of the twin.
	/// \pre isFlippable(e)
	std::array<Halfedge, 4> quad(Edge e) const
	{
		const Halfedge h = e.halfedge(), g = h.twin();
		return {next(h), previous(h), next(g), previous(g)};
	}

	/// Replaces edge \p e = ij, between triangles ijk and jil, by the other diagonal lk; its
	/// halfedge then runs from l to k.
	///
	///          k                 k
	///        /   \             / | \         .
	///       i --> j    ->     i  ^  j
	///        \   /             \ | /
	///          l                 l
	///
	/// \pre isFlippable(e)
	void flip(Edge e);

	/// Undoes flip(e) exactly, halfedge for halfedge; only which halfedges halfedge(f) and
	/// halfedge(v) name may differ.
	void unflip(Edge e);

private:
	std::vector<Halfedge> halfedgesThatAre(bool exterior) const;
	void rewire(Halfedge h, std::array<Halfedge, 4> quad, Vertex from, Vertex to);

	HalfedgeArray<Halfedge> m_next;
	HalfedgeArray<Vertex> m_origin;
	HalfedgeArray<Face> m_face;
	FaceArray<Halfedge> m_faceHalfedge;
	VertexArray<Halfedge> m_vertexHalfedge;
};

/// Topology of one connected surface.
struct Topology
{
	SurfaceType type;
	VertexArray<char> boundary;             ///< 1 on the boundary
	std::vector<std::vector<Vertex>> loops; ///< of each boundary loop, surface on the left
};

/// \pre \p t is connected
Topology topologyOf(const Triangulation& t);

/// The interior edges outside a spanning tree of the vertices that a spanning tree of the faces does not cross
/// either: 2 genus, and one for each boundary loop but the first, unless the tree has its vertices as one.
/// The faces' tree crosses the edges with the longest loops first, and of equals the one with the lowest
/// number, so that those with the shortest are left (greedy system of loops [Erickson Whittlesey 2005]).
/// \param inTree 1 on the edges of the tree
/// \param loopLength of the loop that an edge closes with the tree, where it is not in it
std::vector<Edge> edgesBesideCotree(
	const Triangulation& t, const EdgeArray<char>& inTree, const EdgeArray<double>& loopLength);

} // namespace ricci

#endif
