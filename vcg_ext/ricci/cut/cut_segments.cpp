// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut_segments.h"

#include <algorithm>
#include <limits>

namespace ricci {

namespace {

/// The number of a circle that has none yet.
constexpr int kOpen = -2;

/// Whether a place comes before a stretch.
constexpr auto isBefore = [](int place, const auto& stretch) { return place < stretch.first; };

} // namespace

CutSegments::CutSegments(
	const Triangulation& t,
	const EdgeArray<double>& cost,
	const VertexArray<char>& marked,
	EdgeArray<char>& isCut) :
		m_t(t),
		m_cost(cost), m_marked(marked), m_isCut(isCut), m_boundary(t.boundaryVertices()),
		m_first(t.vertexCount()), m_degree(t.vertexCount(), 0), m_onGraph(t.vertexCount()),
		m_free(t.edgeCount()), m_place(t.halfedgeCount(), -1)
{
	for (const Halfedge h : t.halfedges()) {
		const Vertex v = t.origin(h);
		if (!t.isExterior(h) && !m_first[v].isValid())
			m_first[v] = h;
		m_degree[v] += m_isCut[h.edge()];
	}
	for (const Edge e : t.edges()) {
		if (m_isCut[e])
			m_cutEdges.push_back(e);
		else if (t.isBoundary(e))
			m_boundaryEdges.push_back(e);
		noteEdge(e);
	}
	for (const Vertex v : t.vertices()) {
		if (m_marked[v] && !m_boundary[v] && m_first[v].isValid())
			m_marks.push_back(v);
		noteVertex(v);
	}
}

void CutSegments::noteVertex(Vertex v)
{
	m_onGraph[v] = m_degree[v] > 0 || m_marked[v] || m_boundary[v];
}

void CutSegments::noteEdge(Edge e)
{
	m_free[e] = !isBorder(e) && m_cost[e] < std::numeric_limits<double>::infinity();
}

void CutSegments::set(Edge e, bool cut)
{
	m_isCut[e] = cut;
	if (cut)
		m_cutEdges.push_back(e);
	for (const Vertex v : m_t.ends(e)) {
		m_degree[v] += cut ? 1 : -1;
		noteVertex(v);
	}
	noteEdge(e);
}

/// Brings the list of cut edges up to date, in increasing order.
void CutSegments::tidy()
{
	std::sort(m_cutEdges.begin(), m_cutEdges.end());
	m_cutEdges.erase(std::unique(m_cutEdges.begin(), m_cutEdges.end()), m_cutEdges.end());
	m_cutEdges.erase(
		std::remove_if(m_cutEdges.begin(), m_cutEdges.end(), [&](Edge e) { return !m_isCut[e]; }),
		m_cutEdges.end());
}

/// Appends the cut edges from halfedge \p h on to the next node, \p h included.
/// \return the node; the origin of \p h if there is none
Vertex CutSegments::walk(Halfedge h, std::vector<Edge>& edges) const
{
	const Halfedge first = h;
	for (;;) {
		edges.push_back(h.edge());
		const Vertex end = m_t.target(h);
		if (isNode(end))
			return end;
		Halfedge onward;
		for (const Halfedge k : around(end))
			if (m_isCut[k.edge()] && k != h.twin())
				onward = k;
		h = onward;
		if (h == first || !h.isValid())
			return m_t.origin(first);
	}
}

std::vector<Edge> CutSegments::segments()
{
	tidy();
	std::vector<Edge> edges;
	EdgeArray<char> seen(m_t.edgeCount(), 0);
	for (const Edge e : m_cutEdges) {
		if (seen[e])
			continue;
		edges.push_back(e);
		for (const Edge k : segmentOf(e))
			seen[k] = 1;
	}
	return edges;
}

std::vector<Edge> CutSegments::segmentOf(Edge e) const
{
	std::vector<Edge> edges;
	walk(e.halfedge(), edges);
	if (!isNode(m_t.origin(e.halfedge()))) {
		std::vector<Edge> backward;
		walk(e.halfedge().twin(), backward);
		edges.insert(edges.end(), backward.begin() + 1, backward.end());
	}
	return edges;
}

std::vector<Vertex> CutSegments::branchNodes()
{
	tidy();
	std::vector<Vertex> nodes;
	for (const Edge e : m_cutEdges)
		for (const Vertex v : m_t.ends(e))
			if (m_degree[v] > 1 && isNode(v) && !m_boundary[v])
				nodes.push_back(v);
	std::sort(nodes.begin(), nodes.end());
	nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
	return nodes;
}

CutSegments::Star CutSegments::starOf(Vertex node) const
{
	Star star;
	for (const Halfedge h : around(node))
		if (m_isCut[h.edge()]) {
			star.hasLoop |= walk(h, star.edges) == node;
			++star.segments;
		}
	return star;
}

void CutSegments::add(const std::vector<Edge>& edges)
{
	for (const Edge e : edges)
		set(e, true);
}

void CutSegments::remove(const std::vector<Edge>& edges)
{
	for (const Edge e : edges)
		set(e, false);
}

std::vector<Edge> CutSegments::removeWithDeadEnds(const std::vector<Edge>& edges)
{
	std::vector<Edge> removed;
	std::vector<Vertex> ends;
	const auto drop = [&](Edge e) {
		set(e, false);
		removed.push_back(e);
		for (const Vertex v : m_t.ends(e))
			ends.push_back(v);
	};
	for (const Edge e : edges)
		if (m_isCut[e])
			drop(e);
	while (!ends.empty()) {
		const Vertex v = ends.back();
		ends.pop_back();
		if (m_degree[v] != 1 || m_marked[v] || m_boundary[v])
			continue;
		Edge last;
		for (const Halfedge h : around(v))
			if (m_isCut[h.edge()])
				last = h.edge();
		drop(last);
	}
	return removed;
}

/// The first side that leaves the vertex of \p h, clockwise from it; none if the vertex has no side.
Halfedge CutSegments::sideFrom(Halfedge h) const
{
	Halfedge side = h;
	do {
		if (isBorder(side.edge()))
			return side;
		side = m_t.next(side.twin());
	} while (side != h);
	return Halfedge();
}

int CutSegments::labelCircles()
{
	for (const Halfedge side : m_sides)
		m_place[side] = -1;
	m_sides.clear();
	m_whole.clear();
	tidy();
	for (const std::vector<Edge>* edges : {&m_cutEdges, &m_boundaryEdges})
		for (const Edge e : *edges)
			for (const Halfedge first : {e.halfedge(), e.halfedge().twin()})
				appendSides(first);
	findLoneMarks();
	return splitCircles({});
}

/// Gives the next places to \p first and to the sides that follow it, up to one that has a place.
void CutSegments::appendSides(Halfedge first)
{
	if (m_t.isExterior(first) || m_place[first] >= 0)
		return;
	m_whole.push_back({static_cast<int>(m_sides.size()), kOpen});
	for (Halfedge side = first; m_place[side] < 0; side = sideFrom(m_t.next(side))) {
		m_place[side] = static_cast<int>(m_sides.size());
		m_sides.push_back(side);
	}
}

int CutSegments::update(const std::vector<Edge>& removed, const std::vector<Edge>& added)
{
	const auto firstNew = static_cast<int>(m_sides.size());
	takeOut(removed, m_whole);
	for (const Edge e : removed)
		for (const Halfedge side : {e.halfedge(), e.halfedge().twin()})
			m_place[side] = -1;
	for (const Edge e : added)
		for (const Halfedge side : {e.halfedge(), e.halfedge().twin()})
			appendSides(side);
	// What came before the side that is now next to a new one is followed by that.
	for (std::size_t i = positionOf(firstNew); i < m_sides.size(); ++i)
		if (const int place = m_place[sideFrom(m_t.next(m_sides[i].twin()))]; place < firstNew)
			beginAt(place, m_whole);
	findLoneMarks();
	return firstNew;
}

/// Lets a stretch begin at \p place, unless that is behind the last one.
void CutSegments::beginAt(int place, std::vector<Stretch>& stretches) const
{
	const auto after = std::upper_bound(stretches.begin(), stretches.end(), place, isBefore);
	if (const Stretch in = after[-1]; in.first < place && positionOf(place) < m_sides.size())
		stretches.insert(after, {place, in.circle});
}

/// Lets the sides of \p edges be stretches that are taken out.
void CutSegments::takeOut(const std::vector<Edge>& edges, std::vector<Stretch>& stretches) const
{
	std::vector<int> places;
	for (const Edge e : edges)
		for (const Halfedge side : {e.halfedge(), e.halfedge().twin()})
			places.push_back(m_place[side]);
	std::sort(places.begin(), places.end());
	for (std::size_t i = 0; i < places.size();) {
		const int first = places[i];
		int end = first;
		for (; i < places.size() && places[i] == end; ++i)
			++end;
		beginAt(first, stretches);
		beginAt(end, stretches);
		const auto at = std::upper_bound(stretches.begin(), stretches.end(), first, isBefore) - 1;
		at->circle = -1;
		stretches.erase(at + 1, std::upper_bound(at, stretches.end(), end - 1, isBefore));
	}
}

int CutSegments::splitCircles(const std::vector<Edge>& removed)
{
	m_loneMarks.resize(m_wholeLoneMarks);
	for (const Edge e : removed)
		for (const Vertex v : m_t.ends(e))
			noteLoneMark(v);
	m_stretches = m_whole;
	takeOut(removed, m_stretches);
	int count = 0, longest = 0, most = 0;
	for (std::size_t first = 0; first < m_stretches.size(); ++first) {
		if (m_stretches[first].circle != kOpen)
			continue;
		int sides = 0;
		for (std::size_t i = first; m_stretches[i].circle == kOpen;) {
			m_stretches[i].circle = count;
			sides += endOf(i) - m_stretches[i].first;
			i = stretchOf(m_place[sideFrom(m_t.next(m_sides[positionOf(endOf(i)) - 1]))]);
		}
		if (sides > most) {
			most = sides;
			longest = count;
		}
		++count;
	}
	for (Stretch& stretch : m_stretches)
		if (stretch.circle == 0 || stretch.circle == longest)
			stretch.circle = longest - stretch.circle;
	for (auto& [v, circle] : m_loneMarks)
		circle = count++;
	return count;
}

/// The place after the last one of a stretch.
int CutSegments::endOf(std::size_t stretch) const
{
	return stretch + 1 < m_stretches.size() ? m_stretches[stretch + 1].first
											: static_cast<int>(m_sides.size());
}

/// The stretch with a place.
std::size_t CutSegments::stretchOf(int place) const
{
	const auto after = std::upper_bound(m_stretches.begin(), m_stretches.end(), place, isBefore);
	return static_cast<std::size_t>(after - m_stretches.begin()) - 1;
}

void CutSegments::noteLoneMark(Vertex v)
{
	const auto isSame = [&](const auto& mark) { return mark.first == v; };
	if (m_marked[v] && !m_boundary[v] && m_degree[v] == 0 &&
		std::none_of(
			m_loneMarks.begin() + static_cast<std::ptrdiff_t>(m_wholeLoneMarks),
			m_loneMarks.end(),
			isSame))
		m_loneMarks.emplace_back(v, -1);
}

/// Those of the whole cut.
void CutSegments::findLoneMarks()
{
	m_loneMarks.clear();
	m_wholeLoneMarks = 0;
	for (const Vertex v : m_marks)
		noteLoneMark(v);
	m_wholeLoneMarks = m_loneMarks.size();
}

void CutSegments::joinCircles(int number)
{
	for (Stretch& stretch : m_stretches)
		if (stretch.circle == number)
			stretch.circle = 0;
}

void CutSegments::addDepartures(const std::vector<int>& places, std::vector<Departure>& found) const
{
	const auto before = [&](Halfedge h) { return m_t.next(m_t.next(h)).twin(); };
	std::size_t stretch = 0;
	for (const int place : places) {
		if (place < m_stretches[stretch].first || place >= endOf(stretch))
			stretch = stretchOf(place);
		if (const int circle = m_stretches[stretch].circle; circle > 0)
			for (Halfedge h = before(m_sides[positionOf(place)]); !isBorder(h.edge());
				 h = before(h))
				found.push_back({m_t.origin(m_sides[positionOf(place)]), h, circle});
	}
}

void CutSegments::addDeparturesOfMarks(std::vector<Departure>& found) const
{
	for (const auto& [v, circle] : m_loneMarks)
		if (circle > 0)
			for (const Halfedge h : around(v))
				found.push_back({v, h, circle});
}

int CutSegments::place(Halfedge h) const
{
	const Halfedge side = sideFrom(h);
	return side.isValid() ? m_place[side] : -1;
}

int CutSegments::circle(Halfedge h) const
{
	const Halfedge side = sideFrom(h);
	if (!side.isValid()) {
		for (const auto& [v, circle] : m_loneMarks)
			if (v == m_t.origin(h))
				return circle;
		return -1;
	}
	// What has been put onto the cut since belongs to a path to circle 0.
	const int circle = m_place[side] < 0 ? -1 : m_stretches[stretchOf(m_place[side])].circle;
	return std::max(circle, 0);
}

} // namespace ricci
