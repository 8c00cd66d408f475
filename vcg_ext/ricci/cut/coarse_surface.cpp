// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse_surface.h"

#include "../base/task.h"
#include "../metric/area.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ricci {

namespace {

/// Centres between two checkpoints.
constexpr int kCentresBetweenTicks = 1 << 6;

/// Share of the surface's area, as a square, that a centre has: measured on smooth meshes.
constexpr double kRadiusOfShare = 1.15;

/// Area of a surface with the costs for lengths.
double areaOf(const Triangulation& t, const EdgeArray<double>& cost)
{
	double area = 0.0;
	for (const Face f : t.faces()) {
		const auto h = t.halfedges(f);
		const double base = cost[h[0].edge()];
		if (base > 0.0)
			area += 0.5 * base * triangleApex(base, cost[h[2].edge()], cost[h[1].edge()]).height;
	}
	return area;
}

/// A closed surface of triangles from which sides are taken out.
class Collapse
{
public:
	explicit Collapse(const Triangulation& t) :
			m_t(t), m_partner(t.halfedgeCount()), m_path(t.halfedgeCount()),
			m_isCollapsed(t.halfedgeCount(), 0), m_isGone(t.faceCount(), 0)
	{
		for (const Halfedge h : t.halfedges()) {
			m_partner[h] = h.twin();
			m_path[h] = h;
		}
	}

	bool isGone(Face f) const { return m_isGone[f]; }
	/// The side that is glued to \p h.
	Halfedge partner(Halfedge h) const { return m_partner[h]; }
	/// The halfedge of the cheapest path beside \p h, in its direction.
	Halfedge path(Halfedge h) const { return m_path[h]; }

	void collapse(Halfedge side)
	{
		if (m_t.isExterior(side) || m_isCollapsed[side])
			return;
		m_isCollapsed[side] = 1;
		m_next.push_back(m_t.face(side));
	}

	/// Takes out what has a collapsed side. \param isCheaper (a, b) of two halfedges
	template<class IsCheaper>
	void finish(const IsCheaper& isCheaper)
	{
		while (!m_next.empty()) {
			const Face f = m_next.back();
			m_next.pop_back();
			if (m_isGone[f])
				continue;
			m_isGone[f] = 1;
			std::array<Halfedge, 3> side = m_t.halfedges(f);
			const auto left = std::remove_if(
				side.begin(), side.end(), [&](Halfedge h) { return m_isCollapsed[h]; });
			if (left - side.begin() == 1)
				collapse(m_partner[side[0]]); // a loop round nothing
			else if (left - side.begin() == 2)
				join(side[0], side[1], isCheaper);
		}
	}

private:
	/// Glues what lies on the other sides of \p a and \p b, between which nothing is left.
	template<class IsCheaper>
	void join(Halfedge a, Halfedge b, const IsCheaper& isCheaper)
	{
		const Halfedge beyondA = m_partner[a], beyondB = m_partner[b];
		m_partner[beyondA] = beyondB;
		m_partner[beyondB] = beyondA;
		if (isCheaper(m_path[a], m_path[beyondB]))
			m_path[beyondB] = m_path[a];
		m_path[beyondA] = m_path[beyondB].twin();
	}

	const Triangulation& m_t;
	HalfedgeArray<Halfedge> m_partner, m_path;
	HalfedgeArray<char> m_isCollapsed;
	FaceArray<char> m_isGone;
	std::vector<Face> m_next; // with a collapsed side
};

} // namespace

CoarseSurface::CoarseSurface(
	const Triangulation& t,
	const EdgeArray<double>& cost,
	const VertexArray<char>& marked,
	int vertexCount) :
		m_t(t),
		m_fineCost(cost), m_centre(t.vertexCount())
{
	chooseCentres(marked, vertexCount);
	checkpoint();
	drawTogether();
}

/// Lets the paths grow from new centres.
void CoarseSurface::grow(double radius, Front& front) const
{
	std::size_t reached = 0;
	for (Vertex v; (v = front.next()).isValid();) {
		for (const Halfedge h : m_t.around(v)) {
			const double distance = front[v] + m_fineCost[h.edge()];
			if (distance < radius && !m_t.isBoundary(h.edge()))
				front.offer(m_t.target(h), distance, h);
		}
		checkpointNowAndThen(++reached);
	}
}

void CoarseSurface::chooseCentres(const VertexArray<char>& marked, int vertexCount)
{
	const double radius = kRadiusOfShare * std::sqrt(areaOf(m_t, m_fineCost) / vertexCount);
	Front front(m_t.vertexCount());
	int count = 0;
	const auto draw = [&](Vertex v, int centre) {
		m_centre[v] = Vertex(centre);
		front.offer(v, 0.0);
	};
	for (const Halfedge first : m_t.boundaryLoops()) {
		for (const Halfedge h : m_t.loop(first))
			draw(m_t.origin(h), count);
		++count;
	}
	for (const Vertex v : m_t.vertices())
		if (marked[v] && !m_centre[v].isValid() && m_t.halfedge(v).isValid())
			draw(v, count++);
	m_marked.assign(count, 1);
	grow(radius, front);
	for (const Vertex v : m_t.vertices())
		if (front[v] == kFar && m_t.halfedge(v).isValid()) {
			draw(v, count++);
			grow(radius, front);
			if (count % kCentresBetweenTicks == 0)
				checkpoint();
		}
	m_marked.resize(count, 0);
	m_paths = front.release();
	std::vector<Vertex> way;
	for (const Vertex v : m_t.vertices()) {
		Vertex u = v;
		for (; !m_centre[u].isValid() && m_paths.parent[u].isValid();
			 u = m_t.origin(m_paths.parent[u]))
			way.push_back(u);
		for (const Vertex w : way)
			m_centre[w] = m_centre[u];
		way.clear();
	}
}

double CoarseSurface::pathCost(Halfedge h) const
{
	return m_paths.distance[m_t.origin(h)] + m_fineCost[h.edge()] + m_paths.distance[m_t.target(h)];
}

void CoarseSurface::drawTogether()
{
	Collapse collapse(m_t);
	for (const Halfedge h : m_paths.parent)
		if (h.isValid()) {
			collapse.collapse(h);
			collapse.collapse(h.twin());
		}
	for (const Halfedge h : m_t.exteriorHalfedges())
		collapse.collapse(h.twin());
	collapse.finish([&](Halfedge a, Halfedge b) {
		const double costA = pathCost(a), costB = pathCost(b);
		return costA != costB ? costA < costB : a.edge() < b.edge();
	});
	HalfedgeArray<Corner> side(m_t.halfedgeCount());
	CornerArray<Halfedge> sides;
	std::vector<Triangle> triangles;
	for (const Face f : m_t.faces())
		if (!collapse.isGone(f)) {
			Triangle corners;
			for (std::size_t k = 0; k < 3; ++k) {
				const Halfedge h = m_t.halfedges(f)[k];
				side[h] = Corner(sides.size());
				sides.push_back(h);
				corners[k] = m_centre[m_t.origin(h)].number();
			}
			triangles.push_back(corners);
		}
	CornerArray<Corner> glued;
	glued.reserve(sides.size());
	for (const Halfedge h : sides)
		glued.push_back(side[collapse.partner(h)]);
	m_coarse = Triangulation(m_marked.size(), triangles, glued);
	m_cost.resize(m_coarse.edgeCount());
	m_middle.resize(m_coarse.edgeCount());
	for (const Face f : m_coarse.faces())
		for (const Corner c : cornersOf(f.number())) {
			const Halfedge h = m_coarse.halfedges(f)[c.index()];
			const Halfedge middle = collapse.path(sides[c]);
			m_middle[h.edge()] = middle.edge();
			m_cost[h.edge()] = pathCost(middle);
		}
}

EdgeArray<char> CoarseSurface::lifted(const EdgeArray<char>& isCut) const
{
	EdgeArray<char> fine(m_t.edgeCount(), 0);
	for (const Edge e : m_coarse.edges()) {
		if (!isCut[e])
			continue;
		fine[m_middle[e]] = 1;
		for (const Vertex v : m_t.ends(m_middle[e]))
			for (Halfedge h = m_paths.parent[v]; h.isValid() && !fine[h.edge()];
				 h = m_paths.parent[m_t.origin(h)])
				fine[h.edge()] = 1;
	}
	return fine;
}

} // namespace ricci
