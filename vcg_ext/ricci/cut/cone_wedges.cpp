// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_wedges.h"

#include "../base/numbers.h"
#include "../metric/area.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ricci {

namespace {

/// Widest wedge. Seams are not straight, so a wedge of 2 pi may still cover itself.
constexpr double kMaxWedge = 0.95 * 2.0 * kPi;

double tooMuch(double angle)
{
	return std::max(0.0, angle - kMaxWedge);
}

} // namespace

HalfedgeArray<double> coneCorners(
	const Triangulation& t, const EdgeArray<double>& lengths, const VertexArray<double>& coneAngle)
{
	HalfedgeArray<double> corners(t.halfedgeCount(), 0.0);
	VertexArray<double> total(t.vertexCount(), 0.0);
	for (const Halfedge h : t.halfedges()) {
		const Vertex v = t.origin(h);
		if (t.isExterior(h) || !(coneAngle[v] > 0.0))
			continue;
		const Halfedge opposite = t.next(h);
		const TriangleApex apex = triangleApex(
			lengths[h.edge()], lengths[t.next(opposite).edge()], lengths[opposite.edge()]);
		corners[h] = std::atan2(apex.height, apex.along);
		total[v] += corners[h];
	}
	for (const Halfedge h : t.halfedges())
		if (corners[h] > 0.0)
			corners[h] *= coneAngle[t.origin(h)] / total[t.origin(h)];
	return corners;
}

ConeWedges::ConeWedges(
	const Triangulation& t, const CutSegments& cut, const HalfedgeArray<double>& corners) :
		m_cut(cut),
		m_corners(corners), m_isWide(t.vertexCount(), 0)
{
	if (corners.empty())
		return;
	VertexArray<double> total(t.vertexCount(), 0.0);
	for (const Halfedge h : t.halfedges())
		total[t.origin(h)] += corners[h];
	for (const Vertex v : t.vertices())
		if (cut.isMarked(v) && total[v] > kMaxWedge) {
			m_cones.push_back(v);
			m_isWide[v] = 1;
		}
}

/// In clockwise order from the first cut edge; a single one if there is no or one cut edge.
std::vector<ConeWedges::Wedge> ConeWedges::wedges(Vertex v) const
{
	std::vector<Halfedge> star;
	for (const Halfedge h : m_cut.around(v))
		star.push_back(h);
	const auto first =
		std::find_if(star.begin(), star.end(), [&](Halfedge h) { return m_cut.isCut(h.edge()); });
	if (first != star.end())
		std::rotate(star.begin(), first, star.end());
	std::vector<Wedge> wedges(1);
	for (std::size_t i = 0; i < star.size(); ++i) {
		if (i > 0) {
			wedges.back().angle += m_corners[star[i]];
			if (m_cut.isCut(star[i].edge()))
				wedges.emplace_back();
		}
		if (!m_cut.isCut(star[i].edge())) {
			wedges.back().inside.push_back(star[i]);
			wedges.back().at.push_back(wedges.back().angle);
		}
	}
	wedges.back().angle += m_corners[star.front()];
	return wedges;
}

double ConeWedges::excess(Vertex v) const
{
	if (!m_isWide[v])
		return 0.0;
	double sum = 0.0;
	for (const Wedge& wedge : wedges(v))
		sum += tooMuch(wedge.angle);
	return sum;
}

double ConeWedges::excess() const
{
	double sum = 0.0;
	for (const Vertex v : m_cones)
		sum += excess(v);
	return sum;
}

std::vector<Halfedge> ConeWedges::dividing(Vertex v) const
{
	const std::vector<Wedge> all = wedges(v);
	const Wedge& widest = *std::max_element(
		all.begin(), all.end(), [](const Wedge& a, const Wedge& b) { return a.angle < b.angle; });
	const double parts = std::ceil(widest.angle / kMaxWedge);
	const double max = (parts - 1.0) * kMaxWedge, min = widest.angle - max;
	std::vector<Halfedge> found;
	Halfedge middle;
	double nearest = widest.angle;
	for (std::size_t i = 0; i < widest.inside.size(); ++i) {
		const double at = widest.at[i];
		if (at >= min && at <= max)
			found.push_back(widest.inside[i]);
		const double off = std::abs(at - 0.5 * widest.angle);
		if (off < nearest && at > 0.0) {
			nearest = off;
			middle = widest.inside[i];
		}
	}
	if (found.empty() && middle.isValid())
		found.push_back(middle);
	return found;
}

bool ConeWedges::canLose(Vertex v, Halfedge h) const
{
	if (!m_isWide[v])
		return true;
	double merged = 0.0, before = 0.0;
	const std::vector<Wedge> all = wedges(v);
	std::size_t next = 0; // the wedge that begins at the cut edge whose turn it is
	for (const Halfedge k : m_cut.around(v))
		if (m_cut.isCut(k.edge())) {
			if (k == h) {
				const std::size_t last = (next + all.size() - 1) % all.size();
				if (last == next)
					return true; // it ends here
				merged = all[next].angle + all[last].angle;
				before = tooMuch(all[next].angle) + tooMuch(all[last].angle);
			}
			++next;
		}
	return tooMuch(merged) <= before;
}

} // namespace ricci
