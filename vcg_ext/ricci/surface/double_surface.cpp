// SPDX-License-Identifier: GPL-3.0-or-later
#include "double_surface.h"

#include <vector>

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

	// Side 3 f + k of a face runs from corner k to k + 1; side 2 - k of its image mirrors it.
	HalfedgeArray<int> side(t.halfedgeCount(), -1);
	std::vector<Triangle> triangles(positionOf(2 * faceCount));
	for (const Face f : t.faces()) {
		const auto h = t.halfedges(f);
		const auto v = t.vertices(f);
		for (std::size_t k = 0; k < 3; ++k) {
			side[h[k]] = 3 * f.number() + static_cast<int>(k);
			triangles[positionOf(f)][k] = v[k].number();
		}
		triangles[positionOf(faceCount + f.number())] = {
			d.mirror[v[0]].number(), d.mirror[v[2]].number(), d.mirror[v[1]].number()};
	}
	const auto image = [&](int s) { return 3 * (faceCount + s / 3) + 2 - s % 3; };
	std::vector<int> glued(positionOf(6 * faceCount));
	for (const Halfedge h : t.interiorHalfedges()) {
		const int s = side[h], across = side[h.twin()];
		glued[positionOf(s)] = across >= 0 ? across : image(s);
		glued[positionOf(image(s))] = across >= 0 ? image(across) : s;
	}
	d.triangulation = Triangulation(vertexCount, triangles, glued);

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
