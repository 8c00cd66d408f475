// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar_layout.h"

#include "../numbers.h"
#include "layout_tree.h"

#include <algorithm>
#include <cmath>

namespace ricci {

std::vector<int> cornerSectors(const Triangulation& t, const std::vector<char>& isCut, int& count)
{
	std::vector<int> sector(at(t.halfedgeCount()), -1);
	count = 0;
	for (int start = 0; start < t.halfedgeCount(); ++start) {
		if (t.isOuter(start) || sector[at(start)] >= 0)
			continue;
		const auto closes = [&](int e) { return isCut[at(e)] || t.isBoundaryEdge(e); };
		int h = start;
		do { // counter-clockwise
			sector[at(h)] = count;
			const int in = t.previous(h);
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
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<double>& angles,
	const std::vector<char>& isCut)
{
	PlanarLayout layout;
	int sectorCount = 0;
	layout.sector = cornerSectors(t, isCut, sectorCount);
	layout.position.assign(at(sectorCount), {0.0, 0.0});
	std::vector<char> placed(at(sectorCount), 0);

	const auto place = [&](int h, const Point2& p) {
		const int s = layout.sector[at(h)];
		if (!placed[at(s)]) {
			placed[at(s)] = 1;
			layout.position[at(s)] = p;
		}
	};
	// Directions are carried from triangle to triangle as angles, never measured between points:
	// across a short side of a needle that would magnify the error of the points without bound.
	std::vector<double> direction(at(t.halfedgeCount()), 0.0);
	const auto placeTriangle = [&](int h, double along) {
		const int second = t.next(h), third = t.previous(h);
		const double toApex = along + angles[at(h)]; // from the origin of h
		const double fromBase = along + kPi - angles[at(second)];
		direction[at(h)] = along;
		direction[at(second)] = fromBase;
		direction[at(third)] = toApex - kPi;
		const double left = lengths[at(Triangulation::edge(third))];
		const double right = lengths[at(Triangulation::edge(second))];
		const bool nearer = right < left;
		const Point2 from = layout.at(nearer ? second : h);
		const double angle = nearer ? fromBase : toApex, length = std::min(left, right);
		place(third, {from[0] + length * std::cos(angle), from[1] + length * std::sin(angle)});
	};

	const int root = t.halfedge(0);
	place(root, {0.0, 0.0});
	place(t.next(root), {lengths[at(Triangulation::edge(root))], 0.0});
	placeTriangle(root, 0.0);
	for (int h : layoutTree(t, lengths, isCut, t.face(root)))
		placeTriangle(h, std::remainder(direction[at(Triangulation::twin(h))] + kPi, 2 * kPi));
	return layout;
}

} // namespace ricci
