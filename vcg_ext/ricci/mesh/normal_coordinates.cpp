// SPDX-License-Identifier: GPL-3.0-or-later
#include "normal_coordinates.h"

#include "../base/numbers.h"

#include <cmath>

namespace ricci {

NormalCoordinates::NormalCoordinates(const Triangulation& original) :
		NormalCoordinates(original, EdgeArray<char>(original.edgeCount(), 1))
{
}

NormalCoordinates::NormalCoordinates(
	const Triangulation& original, const EdgeArray<char>& isCurve) :
		m_triangulation(original),
		m_normal(original.edgeCount(), 0), m_roundabout(original.halfedgeCount(), -1),
		m_degree(original.vertexCount(), 0), m_start(original.vertexCount(), 0)
{
	const Triangulation& t = m_triangulation;
	for (const Edge e : t.edges())
		if (isCurve[e]) {
			m_normal[e] = -1;
			for (const Vertex v : t.ends(e))
				++m_degree[v];
		}
	m_ranked.reserve(static_cast<std::size_t>(std::count(isCurve.begin(), isCurve.end(), 1)) * 2);
	// Counter-clockwise from the halfedge that has the exterior on its right, or from any.
	for (const Vertex v : t.vertices()) {
		m_start[v] = m_ranked.size();
		const Halfedge first = t.halfedge(v);
		for (Halfedge h = first; h.isValid();) {
			m_roundabout[h] = (m_ranked.size() - m_start[v]) % std::max(m_degree[v], 1);
			if (isCurve[h.edge()])
				m_ranked.push_back(h);
			if (t.isExterior(h))
				break;
			h = t.previous(h).twin();
			if (h == first)
				break;
		}
	}
}

NormalCoordinates::CornerCurves NormalCoordinates::cornerCurves(Halfedge h) const
{
	const Triangulation& t = m_triangulation;
	const int ij = crossings(h.edge());
	const int jk = crossings(t.next(h).edge());
	const int ki = crossings(t.previous(h).edge());
	CornerCurves c;
	// Curves emanate from one corner at most, and then none cuts that corner off.
	if (ij > jk + ki)
		c.emanateFromK = ij - jk - ki, c.cutOffI = ki, c.cutOffJ = jk;
	else if (jk > ki + ij)
		c.emanateFromI = jk - ki - ij, c.cutOffJ = ij, c.cutOffK = ki;
	else if (ki > ij + jk)
		c.emanateFromJ = ki - ij - jk, c.cutOffK = jk, c.cutOffI = ij;
	else {
		c.cutOffI = (ij + ki - jk) / 2;
		c.cutOffJ = (jk + ij - ki) / 2;
		c.cutOffK = (ki + jk - ij) / 2;
	}
	return c;
}

/// Normal coordinate of the other diagonal kl of the quad of edge ij.
int NormalCoordinates::flippedNormalCoordinate(Edge e) const
{
	const CornerCurves ijk = cornerCurves(e.halfedge());
	const CornerCurves jil = cornerCurves(e.halfedge().twin()); // its I, J, K are j, i, l
	// The curves across ij from i: on each side first those round i, then those to the apex.
	const int roundIinIjk = ijk.cutOffI, toK = roundIinIjk + ijk.emanateFromK;
	const int roundIinJil = jil.cutOffJ, toL = roundIinJil + jil.emanateFromK;
	if (std::max(roundIinIjk, roundIinJil) < std::min(toK, toL))
		return -1;
	return ijk.cutOffK + jil.cutOffK + ijk.emanateFromI + ijk.emanateFromJ + jil.emanateFromI +
		   jil.emanateFromJ + (isCurve(e) ? 1 : 0) + std::max(0, roundIinIjk - toL) +
		   std::max(0, roundIinJil - toK);
}

void NormalCoordinates::updateRoundabout(Halfedge h)
{
	const Halfedge clockwise = m_triangulation.next(h.twin());
	const int passed = cornerCurves(clockwise).emanateFromI + (isCurve(clockwise.edge()) ? 1 : 0);
	m_roundabout[h] =
		(m_roundabout[clockwise] + passed) % std::max(m_degree[m_triangulation.origin(h)], 1);
}

/// Follows a flip that \p change makes.
void NormalCoordinates::follow(Edge e, void (Triangulation::*change)(Edge))
{
	const int normal = flippedNormalCoordinate(e);
	(m_triangulation.*change)(e);
	m_normal[e] = normal;
	updateRoundabout(e.halfedge());
	updateRoundabout(e.halfedge().twin());
}

Halfedge NormalCoordinates::originalAtOrBefore(Halfedge h, int after) const
{
	const Vertex v = m_triangulation.origin(h);
	return original(v, m_roundabout[h] + (isCurve(h.edge()) ? 0 : m_degree[v] - 1) + after);
}

EdgeArray<NormalCoordinates::Curve> NormalCoordinates::trace() const
{
	const Triangulation& t = m_triangulation;
	EdgeArray<Curve> curves(t.edgeCount());
	// By original halfedge: Curve::first, and the position across the opposite side; -1: the curve is an edge.
	HalfedgeArray<Halfedge> first(t.halfedgeCount());
	HalfedgeArray<int> positions(t.halfedgeCount(), -1);
	for (const Halfedge h : t.halfedges()) {
		const Vertex v = t.origin(h);
		const bool isEdge = isCurve(h.edge());
		if (isEdge)
			first[original(v, m_roundabout[h])] = h;
		if (t.isExterior(h))
			continue;
		const int count = cornerCurves(h).emanateFromI;
		for (int m = 0; m < count; ++m) {
			const Halfedge start = original(v, m_roundabout[h] + (isEdge ? 1 : 0) + m);
			first[start] = h;
			positions[start] = crossings(h.edge()) + m;
		}
	}
	for (const Edge e : t.edges()) {
		Curve& curve = curves[e];
		curve.first = first[e.halfedge()];
		curve.last = first[e.halfedge().twin()];
		int position = positions[e.halfedge()];
		if (position < 0)
			continue;
		Halfedge x = t.next(curve.first);
		while (true) {
			curve.crossings.push_back({x, position});
			const Halfedge y = x.twin();
			const int n = crossings(x.edge());
			const CornerCurves c = cornerCurves(y);
			const int fromOriginOfY = n - 1 - position;
			if (fromOriginOfY < c.cutOffI) {
				x = t.previous(y);
				position = crossings(x.edge()) - 1 - fromOriginOfY;
			}
			else if (fromOriginOfY >= n - c.cutOffJ) {
				x = t.next(y);
				position = n - 1 - fromOriginOfY;
			}
			else
				break;
		}
	}
	return curves;
}

namespace {

Point2 walk(const Point2& from, double length, double direction)
{
	return {from[0] + length * std::cos(direction), from[1] + length * std::sin(direction)};
}

} // namespace

Point2 unfold(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const NormalCoordinates::Curve& curve,
	std::vector<std::array<Point2, 2>>& crossed)
{
	const auto length = [&](Halfedge h) { return lengths[h.edge()]; };
	// Angle at the origin of h, by half-angles.
	const auto angle = [&](Halfedge h) {
		const double a = length(h), b = length(t.previous(h)), c = length(t.next(h));
		const double s = 0.5 * (a + b + c);
		return 2.0 * std::atan2(
						 std::sqrt(std::max(0.0, (s - a) * (s - b))),
						 std::sqrt(std::max(0.0, s * (s - c))));
	};
	crossed.clear();
	const Halfedge h = curve.first;
	double along = kPi - angle(t.next(h)); // direction of the crossed halfedge
	Point2 from{length(h), 0.0}, to = walk({0.0, 0.0}, length(t.previous(h)), angle(h));
	for (std::size_t i = 0;; ++i) {
		crossed.push_back({from, to});
		const Halfedge y = curve.crossings[i].halfedge.twin(); // from to
		const double direction = along + kPi;
		const double toApex = direction + angle(y);
		const double fromBase = direction + kPi - angle(t.next(y));
		const double left = length(t.previous(y)), right = length(t.next(y));
		const Point2 apex = right < left ? walk(from, right, fromBase) : walk(to, left, toApex);
		if (i + 1 == curve.crossings.size())
			return apex;
		if (curve.crossings[i + 1].halfedge == t.next(y)) {
			to = apex;
			along = fromBase;
		}
		else {
			from = apex;
			along = toApex - kPi;
		}
	}
}

} // namespace ricci
