// SPDX-License-Identifier: GPL-3.0-or-later
#include "double_surface.h"

namespace ricci {

DoubleSurface doubleOf(const Triangulation& t)
{
	const int faceCount = t.faceCount();
	const VertexArray<char> boundary = t.boundaryVertices();
	DoubleSurface d;
	int vertexCount = t.vertexCount();
	d.mirror.resize(vertexCount);
	for (const Vertex v : t.vertices())
		d.mirror[v] = boundary[v] ? v : Vertex(vertexCount++);
	d.mirror.resize(vertexCount);
	for (const Vertex v : t.vertices())
		d.mirror[d.mirror[v]] = v;

	// Side k of a face runs from corner k to k + 1; side 2 - k of its image mirrors it.
	HalfedgeArray<Corner> side(t.halfedgeCount());
	Array<Triangle> triangles(2 * faceCount);
	for (const Face f : t.faces()) {
		const auto h = t.halfedges(f);
		const auto v = t.vertices(f);
		for (const Corner c : cornersOf(f.number())) {
			side[h[c.index()]] = c;
			triangles[c] = v[c.index()].number();
		}
		triangles[faceCount + f.number()] = {
			d.mirror[v[0]].number(), d.mirror[v[2]].number(), d.mirror[v[1]].number()};
	}
	const auto image = [&](Corner c) {
		return Corner(faceCount + c.face(), 2 - static_cast<int>(c.index()));
	};
	CornerArray<Corner> glued(6 * faceCount);
	for (const Halfedge h : t.interiorHalfedges()) {
		const Corner s = side[h], across = side[h.twin()];
		glued[s] = across.isValid() ? across : image(s);
		glued[image(s)] = across.isValid() ? image(across) : s;
	}
	d.triangulation = Triangulation(vertexCount, triangles.values(), glued);

	d.edgeOf.resize(d.triangulation.edgeCount());
	for (const Face f : t.faces()) {
		const auto h = d.triangulation.halfedges(f);
		const auto mirrored = d.triangulation.halfedges(Face(faceCount + f.number()));
		for (std::size_t k = 0; k < 3; ++k) {
			const Edge e = h[k].edge();
			d.edgeOf[e] = e;
			d.edgeOf[mirrored[2 - k].edge()] = e;
		}
	}
	return d;
}

} // namespace ricci
