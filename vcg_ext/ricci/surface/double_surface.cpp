// SPDX-License-Identifier: GPL-3.0-or-later
#include "double_surface.h"

#include "../numbers.h"

namespace ricci {

DoubleSurface doubleOf(const Triangulation& t)
{
	const int faces = t.faceCount();
	const std::vector<char> boundary = t.boundaryVertices();
	DoubleSurface d;
	int vertices = t.vertexCount();
	d.mirror.resize(at(vertices));
	for (int v = 0; v < t.vertexCount(); ++v)
		d.mirror[at(v)] = boundary[at(v)] ? v : vertices++;
	d.mirror.resize(at(vertices));
	for (int v = 0; v < t.vertexCount(); ++v)
		d.mirror[at(d.mirror[at(v)])] = v;

	std::vector<int> side(at(t.halfedgeCount()), -1); // number of a halfedge's side
	std::vector<Triangle> triangles(at(2 * faces));
	for (int f = 0; f < faces; ++f) {
		const auto h = t.halfedges(f);
		for (std::size_t k = 0; k < 3; ++k) {
			side[at(h[k])] = 3 * f + static_cast<int>(k);
			triangles[at(f)][k] = t.origin(h[k]);
		}
		triangles[at(faces + f)] = {
			d.mirror[at(t.origin(h[0]))],
			d.mirror[at(t.origin(h[2]))],
			d.mirror[at(t.origin(h[1]))]};
	}
	// Side k of a face, from corner k to k + 1, is mirrored by side 2 - k of its image.
	const auto image = [&](int s) { return 3 * (faces + s / 3) + 2 - s % 3; };
	std::vector<int> glued(at(6 * faces));
	for (int h = 0; h < t.halfedgeCount(); ++h) {
		if (t.isOuter(h))
			continue;
		const int s = side[at(h)], across = side[at(Triangulation::twin(h))];
		glued[at(s)] = across >= 0 ? across : image(s);
		glued[at(image(s))] = across >= 0 ? image(across) : s;
	}
	d.triangulation = Triangulation(vertices, triangles, glued);
	d.edgeOf.resize(at(d.triangulation.edgeCount()));
	for (int f = 0; f < faces; ++f) {
		const auto h = d.triangulation.halfedges(f), g = d.triangulation.halfedges(faces + f);
		for (std::size_t k = 0; k < 3; ++k) {
			const int e = Triangulation::edge(h[k]);
			d.edgeOf[at(e)] = e;
			d.edgeOf[at(Triangulation::edge(g[2 - k]))] = e;
		}
	}
	return d;
}

} // namespace ricci
