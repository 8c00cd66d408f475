// SPDX-License-Identifier: GPL-3.0-or-later
#include "shorten_cut.h"

#include "../base/task.h"
#include "../base/tolerances.h"
#include "circle_paths.h"
#include "cone_wedges.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace ricci {

namespace {

/// Rounds over all segments and nodes.
constexpr int kMaxRounds = 12;

/// Sides of the cut that are numbered, or what takes as long, between two checkpoints.
constexpr std::size_t kWorkBetweenTicks = 1 << 21;

/// The same in all, after which the cut stays as it is: moves look through much of the surface, and there are
/// as many as loops, so that thousands of these would take hours.
constexpr std::size_t kMaxWork = 2000000000;

/// What a vertex reached by a search takes, in sides numbered.
constexpr std::size_t kWorkOfVertex = 16;

using Front = CirclePaths::Front;

class CutShortener
{
public:
	CutShortener(
		CutSegments& cut, const HalfedgeArray<double>& corners, const CoarseSurface* parts) :
			m_t(cut.triangulation()),
			m_cut(cut), m_wedges(m_t, cut, corners), m_paths(cut, parts),
			m_changedAt(m_paths.partCount(), 0), m_front(0)
	{
	}

	/// \return whether it has ended before it was done
	bool run()
	{
		checkpoint();
		orderSides();
		shorten();
		m_keepsWedges = true;
		if (divideWedges())
			shorten();
		return m_work > kMaxWork;
	}

private:
	void shorten()
	{
		for (int round = 0; round < kMaxRounds; ++round) {
			const int before = m_changes;
			for (const Edge e : m_cut.segments())
				if (m_cut.isCut(e))
					attempt(m_exchanges, e, &CutShortener::exchange);
			for (const Vertex v : m_cut.branchNodes())
				if (m_cut.degree(v) > 1)
					attempt(m_rebuilds, v, &CutShortener::rebuild);
			if (m_changes == before)
				return;
		}
	}

	/// The last failure of a move at an element.
	struct Failure
	{
		int at = -1;              ///< how many changes the cut had seen
		std::vector<Vertex> near; ///< the parts that the move saw
	};
	template<class Element>
	using Failures = std::map<Element, Failure>;

	/// Whether nothing has changed since, as far as the move could see.
	bool isUpToDate(const Failure& failure) const
	{
		return failure.at >= 0 &&
			   std::none_of(failure.near.begin(), failure.near.end(), [&](Vertex part) {
				   return m_changedAt[part] > failure.at;
			   });
	}

	template<class Element>
	void attempt(Failures<Element>& failures, Element element, bool (CutShortener::*move)(Element))
	{
		Failure& failure = failures[element];
		if (m_work > kMaxWork || isUpToDate(failure))
			return;
		if (!(this->*move)(element)) {
			failure.at = m_changes;
			failure.near = m_paths.near();
		}
		countWork(kWorkOfVertex * m_paths.reached());
	}

	/// Numbers the sides of the cut in order, if they are not.
	/// \return whether it opens the surface to a disk
	bool orderSides()
	{
		if (!m_isOrdered) {
			m_isOrdered = true;
			m_isDisk = m_paths.labelCircles() == 1;
			countWork(m_cut.sides().size());
		}
		return m_isDisk;
	}

	/// Counts a change of the cut at these edges.
	void noteChange(const std::vector<Edge>& removed, const std::vector<Edge>& added)
	{
		++m_changes;
		for (const std::vector<Edge>* edges : {&removed, &added})
			for (const Edge e : *edges)
				for (const Vertex v : m_t.ends(e))
					m_changedAt[m_paths.partOf(v)] = m_changes;
	}

	void countWork(std::size_t work)
	{
		m_work += work;
		if (m_work < m_workAtTick + kWorkBetweenTicks)
			return;
		m_workAtTick = m_work;
		checkpoint();
	}

	/// Puts \p added in place of \p removed, which has been taken out, unless wedges become wider by it.
	/// \return whether it did
	bool replace(const std::vector<Edge>& removed, const std::vector<Edge>& added)
	{
		m_cut.add(added);
		const double after = m_keepsWedges ? excessAt(removed, added) : 0.0;
		if (after > 0.0) {
			m_cut.remove(added);
			m_cut.add(removed);
			if (after > excessAt(removed, added))
				return false;
			m_cut.remove(removed);
			m_cut.add(added);
		}
		noteChange(removed, added);
		countWork(m_paths.update(removed, added));
		m_isOrdered = false;
		return true;
	}

	/// By how much the wedges are too wide at the ends of these edges.
	double excessAt(const std::vector<Edge>& some, const std::vector<Edge>& others) const
	{
		std::vector<Vertex> ends;
		for (const std::vector<Edge>* edges : {&some, &others})
			for (const Edge e : *edges)
				for (const Vertex v : m_t.ends(e))
					if (m_cut.isMarked(v))
						ends.push_back(v);
		std::sort(ends.begin(), ends.end());
		ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
		double sum = 0.0;
		for (const Vertex v : ends)
			sum += m_wedges.excess(v);
		return sum;
	}

	/// Replaces the segment of \p representative by the shortest path that opens the annulus.
	/// \return whether the cut is shorter now; else it is what it was
	bool exchange(Edge representative)
	{
		const std::vector<Edge> removed = m_cut.removeWithDeadEnds(m_cut.segmentOf(representative));
		m_paths.findNear(removed);
		std::vector<Edge> path;
		if (m_paths.splitCircles(removed) == 2)
			path = m_paths.shortestBridge((1.0 - kMinCutGain) * m_paths.costOf(removed));
		if (!path.empty())
			return replace(removed, path);
		m_cut.add(removed);
		return false;
	}

	/// Takes out all segments at \p node and joins what they joined anew.
	/// \return whether the cut is shorter now; else it is what it was
	bool rebuild(Vertex node)
	{
		const CutSegments::Star star = m_cut.starOf(node);
		m_paths.findNear(star.edges);
		if (star.hasLoop)
			return false;
		// The open surface then has as many boundaries as it can have: it lies in a sphere, and
		// any paths that join the boundaries make it a disk.
		const std::vector<Edge> removed = m_cut.removeWithDeadEnds(star.edges);
		const int circles = star.segments + (m_cut.isMarked(node) ? 1 : 0);
		std::vector<Edge> joins;
		if (m_paths.splitCircles(removed) == circles) {
			double bound = (1.0 - kMinCutGain) * m_paths.costOf(removed);
			if (circles == 3) {
				joins = m_paths.bestTripod(bound);
				if (!joins.empty())
					bound = m_paths.costOf(joins);
			}
			std::vector<Edge> bridges = m_paths.joinCircles(circles, bound);
			if (!bridges.empty())
				joins = std::move(bridges);
		}
		if (!joins.empty())
			return replace(removed, joins);
		m_cut.add(removed);
		return false;
	}

	/// Divides the wedges that are too wide. \return whether the cut has changed
	bool divideWedges()
	{
		const int before = m_changes;
		m_segment.assign(m_t.edgeCount(), -1);
		m_front = Front(m_t.vertexCount());
		for (const Vertex v : m_wedges.cones())
			while (m_work <= kMaxWork && m_wedges.excess(v) > 0.0)
				if (!divideWedge(v))
					break;
		orderSides();
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
			Candidate s{e, m_paths.costOf(edges), static_cast<int>(edges.size()), 0, true};
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
		if (starts.empty() || !orderSides())
			return false;
		// Once round the disk: which segment is the longest between its wedge and each place.
		std::vector<Candidate> segments = candidates(cone);
		const std::vector<Halfedge>& circle = m_cut.sides();
		std::vector<int> longest(circle.size(), -1);
		double maxLength = 0.0;
		std::set<std::pair<double, int>> open;
		for (std::size_t i = 0; i < circle.size(); ++i) {
			const std::size_t at = (positionOf(m_cut.place(starts.front())) + i) % circle.size();
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
		const auto [last, segment] = bestDivision(cone, starts, segments, longest, maxLength);
		if (!last.isValid())
			return false;
		std::vector<Edge> path{last.edge()};
		if (m_t.origin(last) != cone)
			m_paths.appendPath(m_front, m_t.origin(last), path);
		const double excess = m_wedges.excess();
		const std::vector<Edge> removed =
			m_cut.removeWithDeadEnds(m_cut.segmentOf(segments[positionOf(segment)].edge));
		m_cut.add(path);
		m_isOrdered = false;
		const bool isDivided = orderSides() && m_wedges.excess() < excess;
		if (isDivided)
			noteChange(removed, path);
		else {
			m_cut.remove(path);
			m_cut.add(removed);
			m_isOrdered = false;
		}
		countWork(kWorkOfVertex * m_front.reached().size());
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
		double minGrowth = kFar;
		m_front.clear();
		const auto goOn = [&](Halfedge h, double distance) {
			const Vertex v = m_t.target(h);
			if (!m_cut.isFree(h.edge()) || v == cone)
				return;
			if (!m_cut.isOnGraph(v)) {
				m_front.offer(v, distance, h);
				return;
			}
			const int place = m_cut.place(h.twin());
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
			goOn(h, m_cut.cost()[h.edge()]);
		for (Vertex v; (v = m_front.next(minGrowth + maxLength)).isValid();)
			for (const Halfedge h : m_cut.around(v))
				goOn(h, m_front[v] + m_cut.cost()[h.edge()]);
		return best;
	}

	const Triangulation& m_t;
	CutSegments& m_cut;
	ConeWedges m_wedges;
	CirclePaths m_paths;
	bool m_keepsWedges = false;
	Failures<Edge> m_exchanges;
	Failures<Vertex> m_rebuilds;
	int m_changes = 0;            // moves that gained
	VertexArray<int> m_changedAt; // [part] which of them was the last in it
	bool m_isOrdered = false;     // see orderSides()
	bool m_isDisk = false;        // when they were
	std::size_t m_work = 0, m_workAtTick = 0;
	Front m_front;            // of the search from a wedge that is divided
	EdgeArray<int> m_segment; // number of its segment, at cut edges, while a wedge is divided
};

} // namespace

bool shortenCut(CutSegments& cut, const HalfedgeArray<double>& corners, const CoarseSurface* parts)
{
	return !cut.segments().empty() && CutShortener(cut, corners, parts).run();
}

} // namespace ricci
