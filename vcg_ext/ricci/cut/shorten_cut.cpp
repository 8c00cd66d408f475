// SPDX-License-Identifier: GPL-3.0-or-later
#include "shorten_cut.h"

#include "../base/tolerances.h"
#include "../math/shortest_paths.h"
#include "cone_wedges.h"
#include "cut_segments.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
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
		const Tick& tick,
		const HalfedgeArray<double>& corners) :
			m_t(t),
			m_cost(cost), m_cut(t, marked, forbidden, isCut), m_wedges(t, m_cut, corners),
			m_tick(tick), m_fronts(3, Front(t.vertexCount()))
	{
	}

	void run()
	{
		m_tick();
		shorten();
		m_keepsWedges = true;
		if (divideWedges())
			shorten();
	}

private:
	void shorten()
	{
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
		countWork();
	}

	void countWork()
	{
		m_work += m_cut.labelled().size();
		for (const Front& front : m_fronts)
			m_work += kWorkOfVertex * front.reached().size();
		if (m_work < m_workAtTick + kWorkBetweenTicks)
			return;
		m_workAtTick = m_work;
		m_tick();
	}

	/// Puts \p added in place of \p removed, which has been taken out, unless a wedge becomes too wide
	/// by it.
	/// \param excess of the wedges before
	/// \return whether it did
	bool replace(const std::vector<Edge>& removed, const std::vector<Edge>& added, double excess)
	{
		m_cut.add(added);
		if (!m_keepsWedges || m_wedges.excess() <= excess)
			return true;
		m_cut.remove(added);
		m_cut.add(removed);
		return false;
	}

	double wedgeExcess() const { return m_keepsWedges ? m_wedges.excess() : 0.0; }

	/// Replaces the segment of \p representative by the shortest path that opens the annulus.
	/// \return whether the cut is shorter now; else it is what it was
	bool exchange(Edge representative)
	{
		const double excess = wedgeExcess();
		const std::vector<Edge> removed = m_cut.removeWithDeadEnds(m_cut.segmentOf(representative));
		std::vector<Edge> path;
		if (m_cut.labelCircles() == 2)
			path = shortestBridge((1.0 - kMinCutGain) * costOf(removed));
		if (!path.empty())
			return replace(removed, path, excess);
		m_cut.add(removed);
		return false;
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
		const double excess = wedgeExcess();
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
		if (!joins.empty())
			return replace(removed, joins, excess);
		m_cut.add(removed);
		return false;
	}

	/// Divides the wedges that are too wide. \return whether the cut has changed
	bool divideWedges()
	{
		const int before = m_changes;
		m_place.assign(m_t.halfedgeCount(), -1);
		m_segment.assign(m_t.edgeCount(), -1);
		for (const Vertex v : m_wedges.cones())
			while (m_work <= kMaxWork && m_wedges.excess(v) > 0.0 && divideWedge(v))
				++m_changes;
		return m_changes > before;
	}

	/// A segment that may be taken out when a wedge is divided.
	struct Candidate
	{
		Edge edge; ///< one of its edges
		double length = 0.0;
		int edges = 0, passed = 0; ///< in all; and sides that the walk round the disk has seen
		bool mayGo = true;

		/// Whether one of its sides has been passed, and the other one not begun.
		bool isOpen() const { return mayGo && passed == edges; }
	};

	/// The segments of the cut, and m_segment.
	std::vector<Candidate> candidates(Vertex cone)
	{
		std::vector<Candidate> found;
		for (const Edge e : m_cut.segments()) {
			const std::vector<Edge> edges = m_cut.segmentOf(e);
			Candidate s{e, costOf(edges), static_cast<int>(edges.size()), 0, true};
			for (const Edge k : edges) {
				m_segment[k] = static_cast<int>(found.size());
				for (const Halfedge h : {k.halfedge(), k.halfedge().twin()})
					s.mayGo =
						s.mayGo && m_t.origin(h) != cone && m_wedges.canLose(m_t.origin(h), h);
			}
			found.push_back(s);
		}
		return found;
	}

	/// Divides the widest wedge at \p cone. \return whether it did; else the cut is what it was
	bool divideWedge(Vertex cone)
	{
		const std::vector<Halfedge> starts = m_wedges.dividing(cone);
		if (starts.empty() || m_cut.labelCircles() != 1)
			return false;
		// Once round the disk: which segment is the longest between its wedge and each place.
		std::vector<Candidate> segments = candidates(cone);
		const std::vector<Halfedge>& circle = m_cut.labelled();
		for (std::size_t i = 0; i < circle.size(); ++i)
			m_place[circle[i]] = static_cast<int>(i);
		std::vector<int> longest(circle.size(), -1);
		double maxLength = 0.0;
		std::set<std::pair<double, int>> open;
		for (std::size_t i = 1; i < circle.size(); ++i) {
			const std::size_t at = (positionOf(m_place[starts.front()]) + i) % circle.size();
			if (!open.empty()) {
				longest[at] = open.rbegin()->second;
				maxLength = std::max(maxLength, open.rbegin()->first);
			}
			if (const Edge e = circle[at].edge(); m_cut.isCut(e)) {
				Candidate& s = segments[positionOf(m_segment[e])];
				const std::pair<double, int> entry{s.length, m_segment[e]};
				if (s.isOpen())
					open.erase(entry);
				++s.passed;
				if (s.isOpen())
					open.insert(entry);
			}
		}
		const double excess = m_wedges.excess();
		const auto [last, segment] = bestDivision(cone, starts, segments, longest, maxLength);
		for (const Halfedge h : circle)
			m_place[h] = -1;
		if (!last.isValid())
			return false;
		std::vector<Edge> path{last.edge()};
		if (m_t.origin(last) != cone)
			appendPath(m_fronts[0], m_t.origin(last), path);
		const std::vector<Edge> removed =
			m_cut.removeWithDeadEnds(m_cut.segmentOf(segments[positionOf(segment)].edge));
		m_cut.add(path);
		const bool isDivided = m_cut.labelCircles() == 1 && m_wedges.excess() < excess;
		if (!isDivided) {
			m_cut.remove(path);
			m_cut.add(removed);
		}
		countWork();
		return isDivided;
	}

	/// The last halfedge of the path from \p cone, and the number of the segment to take out.
	std::pair<Halfedge, int> bestDivision(
		Vertex cone,
		const std::vector<Halfedge>& starts,
		const std::vector<Candidate>& segments,
		const std::vector<int>& longest,
		double maxLength)
	{
		std::pair<Halfedge, int> best{Halfedge(), -1};
		double minGrowth = std::numeric_limits<double>::infinity();
		Front& front = m_fronts[0];
		front.clear();
		const auto goOn = [&](Halfedge h, double distance) {
			const Vertex v = m_t.target(h);
			if (!m_cut.isFree(h.edge()) || v == cone)
				return;
			if (!m_cut.isOnGraph(v)) {
				front.offer(v, distance, h);
				return;
			}
			const int place = m_place[h.twin()];
			const int segment = place < 0 ? -1 : longest[positionOf(place)];
			if (segment < 0)
				return;
			const double growth = distance - segments[positionOf(segment)].length;
			if (growth < minGrowth) {
				minGrowth = growth;
				best = {h, segment};
			}
		};
		for (const Halfedge h : starts)
			goOn(h, m_cost[h.edge()]);
		for (Vertex v; (v = front.next(minGrowth + maxLength)).isValid();)
			for (const Halfedge h : m_cut.around(v))
				goOn(h, front[v] + m_cost[h.edge()]);
		return best;
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
	ConeWedges m_wedges;
	bool m_keepsWedges = false;
	const Tick& m_tick;
	std::vector<Front> m_fronts; // of the searches from up to three circles
	int m_changes = 0;           // moves that gained
	std::size_t m_work = 0, m_workAtTick = 0;
	HalfedgeArray<int> m_place; // on the circle of the disk, while a wedge is divided
	EdgeArray<int> m_segment;   // number of its segment, at cut edges, while a wedge is divided
};

} // namespace

void shortenCut(
	const Triangulation& t,
	const EdgeArray<double>& cost,
	const VertexArray<char>& marked,
	const EdgeArray<char>& forbidden,
	EdgeArray<char>& isCut,
	const Tick& tick,
	const HalfedgeArray<double>& corners)
{
	if (std::find(isCut.begin(), isCut.end(), 1) != isCut.end())
		CutShortener(t, cost, marked, forbidden, isCut, tick, corners).run();
}

} // namespace ricci
