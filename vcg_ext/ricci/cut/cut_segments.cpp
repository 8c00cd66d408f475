// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut_segments.h"

#include <algorithm>

namespace ricci {

CutSegments::CutSegments(
	const Triangulation& t,
	const VertexArray<char>& marked,
	const EdgeArray<char>& forbidden,
	EdgeArray<char>& isCut) :
		m_t(t),
		m_marked(marked), m_forbidden(forbidden), m_isCut(isCut), m_boundary(t.boundaryVertices()),
		m_first(t.vertexCount()), m_degree(t.vertexCount(), 0), m_onGraph(t.vertexCount()),
		m_free(t.edgeCount()), m_circle(t.halfedgeCount(), -1)
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
	m_free[e] = !isBorder(e) && (m_forbidden.empty() || !m_forbidden[e]);
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

int CutSegments::labelCircles()
{
	for (const Halfedge h : m_labelled)
		m_circle[h] = -1;
	m_labelled.clear();
	tidy();
	int count = 0;
	for (const std::vector<Edge>* edges : {&m_cutEdges, &m_boundaryEdges})
		for (const Edge e : *edges)
			for (const Halfedge side : {e.halfedge(), e.halfedge().twin()})
				if (!m_t.isExterior(side) && m_circle[side] < 0)
					labelCircleOf(side, count++);
	for (const Vertex v : m_marks)
		if (m_degree[v] == 0) {
			for (const Halfedge h : around(v)) {
				m_circle[h] = count;
				m_labelled.push_back(h);
			}
			++count;
		}
	return count;
}

/// Goes once round the circle with the border halfedge \p side.
void CutSegments::labelCircleOf(Halfedge side, int number)
{
	const auto label = [&](Halfedge h) {
		m_circle[h] = number;
		m_labelled.push_back(h);
	};
	Halfedge h = side;
	do {
		h = m_t.next(h);
		while (!isBorder(h.edge())) {
			label(h);
			h = m_t.next(h.twin());
		}
		label(h);
	} while (h != side);
}

} // namespace ricci
