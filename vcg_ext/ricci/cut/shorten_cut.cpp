// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut_graph.h"

#include "../base/graphs.h"
#include "../base/task.h"

#include <algorithm>
#include <utility>

namespace ricci {

namespace {

/// Vertices that the searches reach in all before they end: each may reach much of a large surface, and of some
/// surfaces there are thousands.
constexpr std::size_t kMaxReached = 1500000;

/// What a vertex counts that is a node however many cut edges meet there.
constexpr int kNode = 3;

class CutShortener
{
public:
	CutShortener(
		const Triangulation& t,
		const EdgeArray<double>& cost,
		const VertexArray<char>& marked,
		EdgeArray<char>& isCut) :
			m_t(t),
			m_cost(cost), m_isCut(isCut), m_degree(t.vertexCount(), 0),
			m_place(t.halfedgeCount(), -1), m_front(t.vertexCount())
	{
		const VertexArray<char> boundary = t.boundaryVertices();
		for (const Vertex v : t.vertices())
			m_degree[v] = marked[v] || boundary[v] ? kNode : 0;
		for (const Halfedge h : t.halfedges())
			m_degree[t.origin(h)] += isCut[h.edge()];
		const auto first = std::find(isCut.begin(), isCut.end(), 1);
		Halfedge side = Edge(first - isCut.begin()).halfedge();
		do {
			append(side);
			side = sideFrom(t.next(side));
		} while (m_place[side] < 0);
	}

	void run()
	{
		for (const auto& [minusLength, e] : segments())
			if (m_isCut[e] && m_reached < kMaxReached) {
				checkpoint();
				exchange(segmentAt(m_place[e.halfedge()]));
			}
	}

private:
	/// Edges from node to node: as many places from \p there and from \p back on, along both sides of them.
	struct Segment
	{
		int there, back, count;
		double length;
	};

	/// A boundary of the annulus: its sides' places from \p first on, or a marked vertex where there are none.
	struct Circle
	{
		int first, count;
		Vertex mark;
	};

	bool isNode(Vertex v) const { return m_degree[v] != 2; }
	bool isBorder(Edge e) const { return m_isCut[e] || m_t.isBoundary(e); }

	/// The place \p steps from \p place round the disk.
	int after(int place, int steps) const
	{
		const auto n = static_cast<int>(m_sides.size());
		return (place + steps + n) % n;
	}
	Halfedge side(int place) const { return m_sides[positionOf(after(place, 0))]; }

	/// The first side that leaves the vertex of \p h, clockwise from it; none if the vertex has no side.
	Halfedge sideFrom(Halfedge h) const
	{
		for (const Halfedge side : Triangulation::Around(m_t, h))
			if (isBorder(side.edge()))
				return side;
		return Halfedge();
	}

	void append(Halfedge side)
	{
		m_place[side] = static_cast<int>(m_sides.size());
		m_sides.push_back(side);
	}

	/// That of the side at \p place.
	Segment segmentAt(int place) const
	{
		Segment s{place, 0, 0, 0.0};
		while (!isNode(m_t.origin(side(s.there))))
			s.there = after(s.there, -1);
		do
			s.length += m_cost[side(s.there + s.count++).edge()];
		while (!isNode(m_t.target(side(s.there + s.count - 1))));
		s.back = m_place[side(s.there + s.count - 1).twin()];
		return s;
	}

	/// One edge of every segment, and less its length: the longest first.
	std::vector<std::pair<double, Edge>> segments() const
	{
		std::vector<std::pair<double, Edge>> found;
		for (const Halfedge h : m_sides)
			if (m_isCut[h.edge()] && isNode(m_t.origin(h)))
				if (const Segment s = segmentAt(m_place[h]); s.there < s.back)
					found.push_back({-s.length, h.edge()});
		std::sort(found.begin(), found.end());
		return found;
	}

	void set(Edge e, bool cut)
	{
		m_isCut[e] = cut;
		for (const Vertex v : m_t.ends(e))
			m_degree[v] += cut ? 1 : -1;
	}

	/// Replaces a segment by the shortest path that opens the annulus, if that is shorter.
	void exchange(const Segment& s)
	{
		const auto n = static_cast<int>(m_sides.size());
		Circle from{after(s.there, s.count), 0, m_t.origin(side(s.back))};
		Circle to{after(s.back, s.count), 0, m_t.origin(side(s.there))};
		from.count = after(s.back, -from.first);
		to.count = n - 2 * s.count - from.count;
		if (to.count < from.count)
			std::swap(from, to);
		const auto setAll = [&](bool cut) {
			for (int i = 0; i < s.count; ++i)
				set(side(s.there + i).edge(), cut);
		};
		setAll(false);
		const std::vector<Halfedge> path = shortestPath(from, to, s.length);
		if (path.empty())
			setAll(true);
		else
			join(from, to, path);
	}

	/// Whether \p h leaves this circle between two of its sides. \pre it leaves one of the two
	bool leaves(Halfedge h, const Circle& circle) const
	{
		const Halfedge side = sideFrom(h);
		return side.isValid() ? after(m_place[side], -circle.first) < circle.count
							  : m_t.origin(h) == circle.mark;
	}

	/// Calls visit(h) for the halfedges that leave a circle.
	template<class Visit>
	void forDepartures(const Circle& circle, const Visit& visit) const
	{
		if (circle.count == 0)
			for (const Halfedge h : m_t.around(circle.mark))
				visit(h);
		for (int i = 0; i < circle.count; ++i)
			for (Halfedge h = m_t.previous(side(circle.first + i)).twin(); !isBorder(h.edge());
				 h = m_t.previous(h).twin())
				visit(h);
	}

	/// Halfedges of the shortest path from one circle to the other, none if it is not shorter than \p bound.
	/// The search begins at the one with fewer sides: a path from a point does not cost a search from all of
	/// a long cut.
	std::vector<Halfedge> shortestPath(const Circle& from, const Circle& to, double bound)
	{
		Halfedge last;
		const auto goOn = [&](Halfedge h, double length) {
			if (!(length < bound))
				return;
			const Vertex v = m_t.target(h);
			if (m_degree[v] == 0)
				m_front.offer(v, length, h);
			else if (leaves(h.twin(), to)) {
				bound = length;
				last = h;
			}
		};
		m_front.clear();
		forDepartures(from, [&](Halfedge h) { goOn(h, m_cost[h.edge()]); });
		for (Vertex v; (v = m_front.next(bound)).isValid();) {
			for (const Halfedge h : m_t.around(v))
				goOn(h, m_front[v] + m_cost[h.edge()]);
			checkpointNowAndThen(++m_reached);
		}
		std::vector<Halfedge> path;
		for (Halfedge h = last; h.isValid(); h = m_front.parent(m_t.origin(h)))
			path.push_back(h);
		std::reverse(path.begin(), path.end());
		return path;
	}

	/// Adds a path from one circle to the other to the cut: the disk's border goes along it, round the one, back
	/// along it, and round the other.
	void join(const Circle& from, const Circle& to, const std::vector<Halfedge>& path)
	{
		const Halfedge firstThere = sideFrom(m_t.next(path.back())),
					   firstBack = sideFrom(m_t.next(path.front().twin()));
		std::vector<Halfedge> before;
		before.swap(m_sides);
		const auto goRound = [&](const Circle& circle, Halfedge first) {
			const auto at = [&](int i) {
				return before[positionOf(circle.first + i) % before.size()];
			};
			int start = 0;
			while (start < circle.count && at(start) != first)
				++start;
			for (int i = 0; i < circle.count; ++i)
				append(at((start + i) % circle.count));
		};
		for (const Halfedge h : path) {
			set(h.edge(), true);
			append(h);
		}
		goRound(to, firstThere);
		for (auto h = path.rbegin(); h != path.rend(); ++h)
			append(h->twin());
		goRound(from, firstBack);
	}

	const Triangulation& m_t;
	const EdgeArray<double>& m_cost;
	EdgeArray<char>& m_isCut;
	VertexArray<int> m_degree;     // cut edges, and kNode where that is a node in any case
	std::vector<Halfedge> m_sides; // of the cut and the boundary, in order round the disk
	HalfedgeArray<int> m_place;    // in m_sides
	SearchFront<Vertex, Halfedge> m_front;
	std::size_t m_reached = 0;
};

} // namespace

void shortenCut(
	const Triangulation& t,
	const EdgeArray<double>& cost,
	const VertexArray<char>& marked,
	EdgeArray<char>& isCut)
{
	if (std::find(isCut.begin(), isCut.end(), 1) != isCut.end())
		CutShortener(t, cost, marked, isCut).run();
}

} // namespace ricci
