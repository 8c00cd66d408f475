// SPDX-License-Identifier: GPL-3.0-or-later
#include "shorten_cut.h"

#include "../base/tolerances.h"
#include "../math/shortest_paths.h"
#include "cut_segments.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

namespace ricci {

namespace {

/// Rounds over all segments and nodes.
constexpr int kMaxRounds = 12;

/// Halfedges that are labelled, or take as long, between two ticks.
constexpr std::size_t kWorkBetweenTicks = 1 << 21;

/// The same in all, after which the cut stays as it is: every move labels the whole cut, so that
/// thousands of loops would take hours.
constexpr std::size_t kMaxWork = 2000000000;

/// What a vertex reached by a search takes, in halfedges labelled.
constexpr std::size_t kWorkOfVertex = 16;

using Front = SearchFront<Vertex, Halfedge>;

class CutShortener
{
public:
	CutShortener(
		const Triangulation& t,
		const EdgeArray<double>& cost,
		const VertexArray<char>& marked,
		const EdgeArray<char>& forbidden,
		EdgeArray<char>& isCut,
		const Tick& tick) :
			m_t(t),
			m_cost(cost), m_cut(t, marked, forbidden, isCut), m_tick(tick),
			m_fronts(3, Front(t.vertexCount()))
	{
	}

	void run()
	{
		m_tick();
		Failures<Edge> exchanges;
		Failures<Vertex> rebuilds;
		for (int round = 0; round < kMaxRounds; ++round) {
			const int before = m_changes;
			for (const Edge e : m_cut.segments())
				if (m_cut.isCut(e))
					attempt(exchanges, e, &CutShortener::exchange);
			for (const Vertex v : m_cut.branchNodes())
				if (m_cut.degree(v) > 1)
					attempt(rebuilds, v, &CutShortener::rebuild);
			if (m_changes == before)
				return;
		}
	}

private:
	/// How many changes the cut had seen when the last move at an element failed.
	template<class Element>
	using Failures = std::map<Element, int>;

	template<class Element>
	void attempt(Failures<Element>& failures, Element element, bool (CutShortener::*move)(Element))
	{
		int& failedAt = failures.try_emplace(element, -1).first->second;
		if (failedAt == m_changes || m_work > kMaxWork)
			return; // nothing has changed since it failed
		if ((this->*move)(element))
			++m_changes;
		else
			failedAt = m_changes;
		m_work += m_cut.labelled().size();
		for (const Front& front : m_fronts)
			m_work += kWorkOfVertex * front.reached().size();
		if (m_work < m_workAtTick + kWorkBetweenTicks)
			return;
		m_workAtTick = m_work;
		m_tick();
	}

	/// Replaces the segment of \p representative by the shortest path that opens the annulus.
	/// \return whether the cut is shorter now; else it is what it was
	bool exchange(Edge representative)
	{
		const std::vector<Edge> removed = m_cut.removeWithDeadEnds(m_cut.segmentOf(representative));
		std::vector<Edge> path;
		if (m_cut.labelCircles() == 2)
			path = shortestBridge((1.0 - kMinCutGain) * costOf(removed));
		m_cut.add(path.empty() ? removed : path);
		return !path.empty();
	}

	/// Takes out all segments at \p node and joins what they joined anew.
	/// \return whether the cut is shorter now; else it is what it was
	bool rebuild(Vertex node)
	{
		const CutSegments::Star star = m_cut.starOf(node);
		if (star.hasLoop)
			return false;
		// The open surface then has as many boundaries as it can have: it lies in a sphere, and
		// any paths that join the boundaries make it a disk.
		const std::vector<Edge> removed = m_cut.removeWithDeadEnds(star.edges);
		const int circles = star.segments + (m_cut.isMarked(node) ? 1 : 0);
		std::vector<Edge> joins;
		if (m_cut.labelCircles() == circles) {
			double bound = (1.0 - kMinCutGain) * costOf(removed);
			if (circles == 3) {
				joins = bestTripod(bound);
				if (!joins.empty())
					bound = costOf(joins);
			}
			std::vector<Edge> bridges = joinCircles(circles, bound);
			if (!bridges.empty())
				joins = std::move(bridges);
		}
		m_cut.add(joins.empty() ? removed : joins);
		return !joins.empty();
	}

	double costOf(const std::vector<Edge>& edges) const
	{
		double sum = 0.0;
		for (const Edge e : edges)
			sum += m_cost[e];
		return sum;
	}

	/// Lets \p front begin at the circles for which \p chosen(circle) holds.
	template<class Chosen>
	void startFrom(const Chosen& chosen, double bound, Front& front) const
	{
		front.clear();
		for (const Halfedge h : m_cut.labelled())
			if (chosen(m_cut.circle(h)) && m_cut.isFree(h.edge()) &&
				!m_cut.isOnGraph(m_t.target(h)) && m_cost[h.edge()] < bound)
				front.offer(m_t.target(h), m_cost[h.edge()], h);
	}

	/// Appends the edges of the path from the circles to \p v.
	void appendPath(const Front& front, Vertex v, std::vector<Edge>& edges) const
	{
		while (!m_cut.isOnGraph(v)) {
			const Halfedge h = front.parent(v);
			edges.push_back(h.edge());
			v = m_t.origin(h);
		}
	}

	/// A shortest path between circles of two sets.
	struct Bridge
	{
		double length;
		Halfedge halfedge; // where the searches from both ends met, if they did
	};

	/// Shortest path from a circle with \p isStart to one with \p isEnd, shorter than \p bound, by
	/// searches from both ends. Of these the one that has seen less goes on, so that a path to a
	/// point does not cost a search from all of a long cut.
	template<class IsStart, class IsEnd>
	Bridge shortestPath(const IsStart& isStart, const IsEnd& isEnd, double bound)
	{
		Bridge best{bound, Halfedge()};
		const auto offer = [&](Halfedge h, double length) {
			if (length < best.length)
				best = {length, h};
		};
		for (const Halfedge h : m_cut.labelled()) {
			const int there = m_cut.circle(h.twin());
			if (isStart(m_cut.circle(h)) && m_cut.isFree(h.edge()) && there >= 0 && isEnd(there))
				offer(h, m_cost[h.edge()]);
		}
		Front &from = m_fronts[0], &to = m_fronts[1];
		startFrom(isStart, best.length, from);
		startFrom(isEnd, best.length, to);
		const auto step = [&](Front& own, const Front& other, auto isOther, auto towards) {
			const Vertex v = own.next(best.length);
			for (const Halfedge h : m_cut.around(v)) {
				const Edge e = h.edge();
				const Vertex w = m_t.target(h);
				if (!m_cut.isFree(e))
					continue;
				const double d = own[v] + m_cost[e];
				if (m_cut.isOnGraph(w)) {
					if (isOther(m_cut.circle(h.twin())))
						offer(towards(h), d);
					continue;
				}
				if (!(d < best.length))
					continue;
				own.offer(w, d, h);
				offer(towards(h), d + other[w]);
			}
		};
		while (from.nearest() + to.nearest() < best.length)
			if (from.reached().size() <= to.reached().size())
				step(from, to, isEnd, [](Halfedge h) { return h; });
			else
				step(to, from, isStart, [](Halfedge h) { return h.twin(); });
		return best;
	}

	/// Shortest path from circle 0 to another, empty if none is shorter than \p bound.
	std::vector<Edge> shortestBridge(double bound)
	{
		const Bridge bridge = shortestPath(
			[](int circle) { return circle == 0; }, [](int circle) { return circle > 0; }, bound);
		std::vector<Edge> path;
		if (!bridge.halfedge.isValid())
			return path;
		path.push_back(bridge.halfedge.edge());
		appendPath(m_fronts[0], m_t.origin(bridge.halfedge), path);
		appendPath(m_fronts[1], m_t.target(bridge.halfedge), path);
		return path;
	}

	/// Joins the circles one after another by shortest bridges. \return their edges, none if they
	/// are not shorter than \p bound together; the cut is left as it is
	std::vector<Edge> joinCircles(int circles, double bound)
	{
		std::vector<Edge> edges;
		bool found = true;
		while (found && circles > 1) {
			const std::vector<Edge> bridge = shortestBridge(bound - costOf(edges));
			m_cut.add(bridge);
			edges.insert(edges.end(), bridge.begin(), bridge.end());
			found = !bridge.empty() && m_cut.labelCircles() == --circles;
		}
		m_cut.remove(edges);
		if (!found)
			edges.clear();
		return edges;
	}

	/// Three paths from the circles 0, 1, 2 that meet in one vertex, empty if they are not shorter
	/// than \p bound together.
	std::vector<Edge> bestTripod(double bound)
	{
		// Two of the paths join their circles, so the third has at most the rest of the bound.
		std::array<double, 3> limit;
		for (int circle = 0; circle < 3; ++circle) {
			const int second = (circle + 1) % 3, third = (circle + 2) % 3;
			const Bridge opposite = shortestPath(
				[&](int c) { return c == second; }, [&](int c) { return c == third; }, bound);
			limit[positionOf(circle)] = bound - opposite.length;
		}
		for (int circle = 0; circle < 3; ++circle)
			searchFrom(circle, limit[positionOf(circle)], m_fronts[positionOf(circle)]);
		double minSum = bound;
		Vertex centre;
		for (const Vertex v : m_fronts[0].reached()) {
			const double sum = m_fronts[0][v] + m_fronts[1][v] + m_fronts[2][v];
			if (sum < minSum || (sum == minSum && v < centre)) {
				minSum = sum;
				centre = v;
			}
		}
		std::vector<Edge> edges;
		if (!centre.isValid())
			return edges;
		for (const Front& front : m_fronts)
			appendPath(front, centre, edges);
		return touch(edges, centre) ? std::vector<Edge>() : edges;
	}

	/// Finds all vertices nearer than \p limit to a circle.
	void searchFrom(int circle, double limit, Front& front) const
	{
		startFrom([&](int c) { return c == circle; }, limit, front);
		for (Vertex v; (v = front.next(limit)).isValid();)
			for (const Halfedge h : m_cut.around(v)) {
				const double d = front[v] + m_cost[h.edge()];
				if (m_cut.isFree(h.edge()) && !m_cut.isOnGraph(m_t.target(h)) && d < limit)
					front.offer(m_t.target(h), d, h);
			}
	}

	/// Whether paths to \p centre touch before it: they would enclose something.
	bool touch(const std::vector<Edge>& paths, Vertex centre) const
	{
		std::vector<Vertex> ends;
		for (const Edge e : paths)
			for (const Vertex v : m_t.ends(e))
				if (v != centre && !m_cut.isOnGraph(v))
					ends.push_back(v);
		std::sort(ends.begin(), ends.end());
		for (std::size_t i = 2; i < ends.size(); ++i)
			if (ends[i] == ends[i - 2])
				return true;
		return false;
	}

	const Triangulation& m_t;
	const EdgeArray<double>& m_cost;
	CutSegments m_cut;
	const Tick& m_tick;
	std::vector<Front> m_fronts; // of the searches from up to three circles
	int m_changes = 0;           // moves that gained
	std::size_t m_work = 0, m_workAtTick = 0;
};

} // namespace

void shortenCut(
	const Triangulation& t,
	const EdgeArray<double>& cost,
	const VertexArray<char>& marked,
	const EdgeArray<char>& forbidden,
	EdgeArray<char>& isCut,
	const Tick& tick)
{
	if (std::find(isCut.begin(), isCut.end(), 1) != isCut.end())
		CutShortener(t, cost, marked, forbidden, isCut, tick).run();
}

} // namespace ricci
