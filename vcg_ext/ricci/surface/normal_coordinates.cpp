// SPDX-License-Identifier: GPL-3.0-or-later
#include "normal_coordinates.h"

#include "../numbers.h"

#include <algorithm>

namespace ricci {

NormalCoordinates::NormalCoordinates(const Triangulation& original) :
		m_triangulation(original), m_crossings(at(original.edgeCount()), -1),
		m_roundabout(at(original.halfedgeCount()), -1), m_degree(at(original.vertexCount()), 0)
{
	const Triangulation& t = m_triangulation;
	for (int h = 0; h < t.halfedgeCount(); ++h)
		++m_degree[at(t.origin(h))];
	m_start.assign(at(t.vertexCount()) + 1, 0);
	for (int v = 0; v < t.vertexCount(); ++v)
		m_start[at(v) + 1] = m_start[at(v)] + m_degree[at(v)];
	m_ranked.assign(at(t.halfedgeCount()), -1);
	// Counter-clockwise from the halfedge that has the outside on its right, or from any.
	std::vector<int> first(at(t.vertexCount()), -1);
	for (int h = t.halfedgeCount() - 1; h >= 0; --h)
		if (!t.isOuter(h) &&
			(first[at(t.origin(h))] < 0 || !t.isOuter(Triangulation::twin(first[at(t.origin(h))]))))
			first[at(t.origin(h))] = h;
	for (int v = 0; v < t.vertexCount(); ++v) {
		if (first[at(v)] < 0)
			continue;
		int h = first[at(v)];
		for (int rank = 0; rank < m_degree[at(v)]; ++rank) {
			m_roundabout[at(h)] = rank;
			m_ranked[at(m_start[at(v)] + rank)] = h;
			if (!t.isOuter(h))
				h = Triangulation::twin(t.previous(h));
		}
	}
}

NormalCoordinates::Corners NormalCoordinates::cornersOf(int h) const
{
	const Triangulation& t = m_triangulation;
	const int ij = crossings(Triangulation::edge(h));
	const int jk = crossings(Triangulation::edge(t.next(h)));
	const int ki = crossings(Triangulation::edge(t.previous(h)));
	Corners c{0, 0, 0, 0, 0, 0};
	// At most one corner has curves leaving through the opposite side, and then no curve cuts it
	// off.
	if (ij > jk + ki)
		c.fromK = ij - jk - ki, c.cutI = ki, c.cutJ = jk;
	else if (jk > ki + ij)
		c.fromI = jk - ki - ij, c.cutJ = ij, c.cutK = ki;
	else if (ki > ij + jk)
		c.fromJ = ki - ij - jk, c.cutK = jk, c.cutI = ij;
	else
		c.cutI = (ij + ki - jk) / 2, c.cutJ = (jk + ij - ki) / 2, c.cutK = (ki + jk - ij) / 2;
	return c;
}

/// Crossings of the other diagonal kl of the quad of edge ij: the curve pieces with one end on the
/// side of i and one on the side of j; -1 if a curve runs from k to l.
int NormalCoordinates::flipped(int e) const
{
	const Corners top = cornersOf(2 * e),
				  bottom = cornersOf(2 * e + 1);              // bottom: i and j exchanged
	const int topI = top.cutI, topEnd = top.cutI + top.fromK; // along ij: cut i, from k, cut j
	const int bottomI = bottom.cutJ, bottomEnd = bottom.cutJ + bottom.fromK;
	if (std::max(topI, bottomI) < std::min(topEnd, bottomEnd))
		return -1;
	return top.cutK + bottom.cutK + top.fromI + top.fromJ + bottom.fromI + bottom.fromJ +
		   (isCurve(e) ? 1 : 0) + std::max(0, topI - bottomEnd) + std::max(0, bottomI - topEnd);
}

/// Rank of h from that of the halfedge next to it clockwise: past that one, if it is a curve, and
/// past the curves that leave between the two.
void NormalCoordinates::updateRoundabout(int h)
{
	const int before = m_triangulation.next(Triangulation::twin(h));
	const Corners c = cornersOf(before);
	const int passed = c.fromI + (isCurve(Triangulation::edge(before)) ? 1 : 0);
	m_roundabout[at(h)] =
		(m_roundabout[at(before)] + passed) % m_degree[at(m_triangulation.origin(h))];
}

void NormalCoordinates::flip(int e)
{
	const int crossings = flipped(e);
	m_triangulation.flip(e);
	m_crossings[at(e)] = crossings;
	updateRoundabout(2 * e);
	updateRoundabout(2 * e + 1);
}

void NormalCoordinates::unflip(int e)
{
	const int crossings = flipped(e);
	m_triangulation.unflip(e);
	m_crossings[at(e)] = crossings;
	updateRoundabout(2 * e);
	updateRoundabout(2 * e + 1);
}

int NormalCoordinates::originalAtOrBefore(int h) const
{
	const int v = m_triangulation.origin(h);
	const int rank =
		m_roundabout[at(h)] + (isCurve(Triangulation::edge(h)) ? 0 : m_degree[at(v)] - 1);
	return m_ranked[at(m_start[at(v)] + rank % m_degree[at(v)])];
}

std::vector<NormalCoordinates::Curve> NormalCoordinates::trace() const
{
	const Triangulation& t = m_triangulation;
	std::vector<Curve> curves(at(t.edgeCount()));
	struct Start
	{
		int corner = -1, position = -1; // position -1: the curve is the edge itself
	};
	std::vector<Start> starts(at(t.halfedgeCount())); // by original halfedge
	for (int h = 0; h < t.halfedgeCount(); ++h) {
		const int v = t.origin(h);
		const bool isCurve = this->isCurve(Triangulation::edge(h));
		const auto ranked = [&](int rank) {
			return m_ranked[at(m_start[at(v)] + rank % m_degree[at(v)])];
		};
		if (isCurve)
			starts[at(ranked(m_roundabout[at(h)]))] = {h, -1};
		if (t.isOuter(h))
			continue;
		const Corners c = cornersOf(h);
		for (int m = 0; m < c.fromI; ++m)
			starts[at(ranked(m_roundabout[at(h)] + (isCurve ? 1 : 0) + m))] = {
				h, crossings(Triangulation::edge(h)) + m};
	}
	for (int e = 0; e < t.edgeCount(); ++e) {
		Curve& curve = curves[at(e)];
		const Start start = starts[at(2 * e)];
		curve.first = start.corner;
		curve.last = starts[at(2 * e + 1)].corner;
		if (start.position < 0)
			continue;
		int x = t.next(start.corner), position = start.position;
		while (true) {
			curve.crossings.push_back({x, position});
			const int y = Triangulation::twin(x);
			const int n = crossings(Triangulation::edge(x));
			const Corners c = cornersOf(y);
			const int in = n - 1 - position;
			if (in < c.cutI) {
				x = t.previous(y);
				position = crossings(Triangulation::edge(x)) - 1 - in;
			}
			else if (in >= n - c.cutJ) {
				x = t.next(y);
				position = n - 1 - in;
			}
			else
				break;
		}
	}
	return curves;
}

} // namespace ricci
