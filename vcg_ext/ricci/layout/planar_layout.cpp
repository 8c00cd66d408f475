// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar_layout.h"

#include <cmath>

namespace ricci {

namespace {

std::size_t at(int index)
{
	return static_cast<std::size_t>(index);
}

} // namespace

std::vector<int> cornerSectors(const Triangulation& t, const std::vector<char>& isCut, int& count)
{
	std::vector<int> sector(at(t.halfedgeCount()), -1);
	count = 0;
	for (int start = 0; start < t.halfedgeCount(); ++start) {
		if (t.isOuter(start) || sector[at(start)] >= 0)
			continue;
		const auto closes = [&](int e) { return isCut[at(e)] || t.isBoundaryEdge(e); };
		int        h      = start;
		do { // counter-clockwise
			sector[at(h)] = count;
			const int in  = t.previous(h);
			if (closes(Triangulation::edge(in)))
				break;
			h = Triangulation::twin(in);
		} while (h != start);
		for (h = start; !closes(Triangulation::edge(h));) { // clockwise
			h = t.next(Triangulation::twin(h));
			if (sector[at(h)] >= 0)
				break;
			sector[at(h)] = count;
		}
		++count;
	}
	return sector;
}

PlanarLayout layOutInPlane(
	const Triangulation&       t,
	const std::vector<double>& lengths,
	const std::vector<double>& angles,
	const std::vector<char>&   isCut)
{
	PlanarLayout layout;
	int          sectorCount = 0;
	layout.sector            = cornerSectors(t, isCut, sectorCount);
	layout.position.assign(at(sectorCount), {0.0, 0.0});
	std::vector<char> placed(at(sectorCount), 0), seen(at(t.faceCount()), 0);

	const auto place = [&](int h, const Point2& p) {
		const int s = layout.sector[at(h)];
		if (!placed[at(s)]) {
			placed[at(s)]          = 1;
			layout.position[at(s)] = p;
		}
	};
	// Apex of the triangle on the left of h, from the points at both ends of h.
	const auto placeApex = [&](int h) {
		const Point2 p = layout.at(h), q = layout.at(t.next(h));
		const int    apex  = t.previous(h);
		const double scale = lengths[at(Triangulation::edge(apex))] / lengths[at(Triangulation::edge(h))];
		const double x = scale * std::cos(angles[at(h)]), y = scale * std::sin(angles[at(h)]);
		const double dx = q[0] - p[0], dy = q[1] - p[1];
		place(apex, {p[0] + x * dx - y * dy, p[1] + x * dy + y * dx});
	};

	std::vector<int> queue;
	const int        root = t.halfedge(0);
	place(root, {0.0, 0.0});
	place(t.next(root), {lengths[at(Triangulation::edge(root))], 0.0});
	placeApex(root);
	queue.push_back(t.face(root));
	seen[at(t.face(root))] = 1;
	for (std::size_t head = 0; head < queue.size(); ++head)
		for (int h : t.halfedges(queue[head])) {
			const int across = Triangulation::twin(h);
			if (isCut[at(Triangulation::edge(h))] || t.isOuter(across) || seen[at(t.face(across))])
				continue;
			seen[at(t.face(across))] = 1;
			queue.push_back(t.face(across));
			placeApex(across);
		}
	return layout;
}

} // namespace ricci
