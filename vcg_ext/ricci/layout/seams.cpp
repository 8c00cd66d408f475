// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams.h"

#include "../numbers.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <utility>

namespace ricci {

namespace {

/// Rounds over all segments and nodes.
constexpr int kMostRounds = 12;

/// A move must lower the cost of what it replaces by this share.
constexpr double kLeastGain = 1e-9;

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Halfedges that are labelled, or take as long, between two ticks; and in all, after which the cut
/// stays as it is: every move labels the whole cut, so that thousands of loops would take hours.
constexpr std::size_t kWorkBetweenTicks = 1 << 21, kMostWork = 2000000000;

/// What a vertex reached by a search takes, in halfedges labelled.
constexpr std::size_t kWorkOfVertex = 16;

/// Distances on the open surface from one of its boundaries.
class Distances
{
public:
	explicit Distances(int vertexCount) :
			m_distance(at(vertexCount), kFar), m_parent(at(vertexCount), -1)
	{
	}

	void clear()
	{
		for (int v : m_reached) {
			m_distance[at(v)] = kFar;
			m_parent[at(v)] = -1;
		}
		m_reached.clear();
		m_queue = Queue();
	}

	/// Offers \p distance to the vertex at which \p halfedge ends.
	void offer(int v, double distance, int halfedge)
	{
		if (!(distance < m_distance[at(v)]))
			return;
		if (m_distance[at(v)] == kFar)
			m_reached.push_back(v);
		m_distance[at(v)] = distance;
		m_parent[at(v)] = halfedge;
		m_queue.push({distance, v});
	}

	/// Distance of the vertex whose turn is next, infinite if none is left.
	double nearest()
	{
		while (!m_queue.empty() && m_queue.top().first != m_distance[at(m_queue.top().second)])
			m_queue.pop();
		return m_queue.empty() ? kFar : m_queue.top().first;
	}

	/// The next vertex, whose distance is final, or -1 if none nearer than \p bound is left.
	int next(double bound)
	{
		if (!(nearest() < bound))
			return -1;
		const int v = m_queue.top().second;
		m_queue.pop();
		return v;
	}

	double operator[](int v) const { return m_distance[at(v)]; }
	int parent(int v) const { return m_parent[at(v)]; } ///< halfedge that arrives
	const std::vector<int>& reached() const { return m_reached; }

private:
	using Entry = std::pair<double, int>; // ties by vertex, so that the paths are always the same
	using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>>;
	std::vector<double> m_distance;
	std::vector<int> m_parent, m_reached;
	Queue m_queue;
};

class Shortener
{
public:
	Shortener(
		const Triangulation& t,
		const std::vector<double>& cost,
		const std::vector<char>& marked,
		const std::vector<char>& forbidden,
		std::vector<char>& isCut) :
			m_t(t),
			m_cost(cost), m_marked(marked), m_forbidden(forbidden), m_isCut(isCut),
			m_boundary(t.boundaryVertices()), m_degree(at(t.vertexCount()), 0),
			m_any(at(t.vertexCount()), -1), m_circle(at(t.halfedgeCount()), -1)
	{
		for (int h = t.halfedgeCount() - 1; h >= 0; --h) {
			if (!t.isOuter(h))
				m_any[at(t.origin(h))] = h;
			m_degree[at(t.origin(h))] += m_isCut[at(Triangulation::edge(h))];
		}
		for (int e = 0; e < t.edgeCount(); ++e)
			if (m_isCut[at(e)])
				m_cutEdges.push_back(e);
			else if (t.isBoundaryEdge(e))
				m_boundaryEdges.push_back(e);
		for (int v = 0; v < t.vertexCount(); ++v)
			if (marked[at(v)] && !m_boundary[at(v)] && m_any[at(v)] >= 0)
				m_marks.push_back(v);
		m_distances.assign(3, Distances(t.vertexCount()));
		m_onGraph.resize(at(t.vertexCount()));
		for (int v = 0; v < t.vertexCount(); ++v)
			noteVertex(v);
		m_usable.resize(at(t.edgeCount()));
		for (int e = 0; e < t.edgeCount(); ++e)
			noteEdge(e);
	}

	void run(const std::function<void()>& tick)
	{
		tick();
		std::size_t work = 0, heard = 0;
		std::map<int, int> failedExchange, failedRebuild; // by edge and vertex: changes until then
		int changes = 0;
		for (int round = 0; round < kMostRounds; ++round) {
			const int before = changes;
			const auto attempt =
				[&](std::map<int, int>& failed, int element, bool (Shortener::*move)(int)) {
					const auto [at, first] = failed.try_emplace(element, -1);
					if (at->second == changes || work > kMostWork)
						return; // nothing has changed since it failed
					if ((this->*move)(element))
						++changes;
					else
						at->second = changes;
					work += m_labelled.size();
					for (const Distances& distances : m_distances)
						work += kWorkOfVertex * distances.reached().size();
					if (work < heard + kWorkBetweenTicks)
						return;
					heard = work;
					tick();
				};
			for (int e : representatives())
				if (m_isCut[at(e)])
					attempt(failedExchange, e, &Shortener::exchange);
			for (int v : joints())
				if (m_degree[at(v)] > 1)
					attempt(failedRebuild, v, &Shortener::rebuild);
			if (changes == before)
				return;
		}
	}

private:
	bool isNode(int v) const
	{
		return m_marked[at(v)] || m_boundary[at(v)] || m_degree[at(v)] != 2;
	}

	/// Whether \p v lies on the cut or the boundary, or must be reached by the cut.
	bool onGraph(int v) const { return m_onGraph[at(v)]; }
	bool isBorder(int e) const { return m_isCut[at(e)] || m_t.isBoundaryEdge(e); }
	bool usable(int e) const { return m_usable[at(e)]; }

	void noteVertex(int v)
	{
		m_onGraph[at(v)] = m_degree[at(v)] > 0 || m_marked[at(v)] || m_boundary[at(v)];
	}
	void noteEdge(int e)
	{
		m_usable[at(e)] = !isBorder(e) && (m_forbidden.empty() || !m_forbidden[at(e)]);
	}

	/// Halfedges that leave \p v, each once.
	template<class Visit>
	void around(int v, Visit visit) const
	{
		const int first = m_any[at(v)];
		if (first < 0)
			return;
		int h = first;
		do {
			visit(h);
			h = m_t.next(Triangulation::twin(h));
		} while (h != first);
	}

	void set(int e, char cut)
	{
		m_isCut[at(e)] = cut;
		if (cut)
			m_cutEdges.push_back(e);
		const int by = cut ? 1 : -1;
		for (int v : {m_t.origin(2 * e), m_t.target(2 * e)}) {
			m_degree[at(v)] += by;
			noteVertex(v);
		}
		noteEdge(e);
	}

	/// Appends the cut edges from halfedge \p h on to the next node, \p h included. \return the node
	int walk(int h, std::vector<int>& edges) const
	{
		const int first = h;
		for (;;) {
			edges.push_back(Triangulation::edge(h));
			if (isNode(m_t.target(h)))
				return m_t.target(h);
			int onward = -1;
			around(m_t.target(h), [&](int k) {
				if (m_isCut[at(Triangulation::edge(k))] && k != Triangulation::twin(h))
					onward = k;
			});
			h = onward;
			if (h == first || h < 0)
				return m_t.origin(first);
		}
	}

	std::vector<int> segmentOf(int e) const
	{
		std::vector<int> edges;
		walk(2 * e, edges);
		std::vector<int> backward;
		if (!isNode(m_t.origin(2 * e)))
			walk(2 * e + 1, backward);
		if (!backward.empty())
			edges.insert(edges.end(), backward.begin() + 1, backward.end());
		return edges;
	}

	/// Brings the list of cut edges up to date.
	void tidy()
	{
		std::sort(m_cutEdges.begin(), m_cutEdges.end());
		m_cutEdges.erase(std::unique(m_cutEdges.begin(), m_cutEdges.end()), m_cutEdges.end());
		m_cutEdges.erase(
			std::remove_if(
				m_cutEdges.begin(), m_cutEdges.end(), [&](int e) { return !m_isCut[at(e)]; }),
			m_cutEdges.end());
	}

	/// Nodes inside at which several segments meet.
	std::vector<int> joints()
	{
		tidy();
		std::vector<int> vertices;
		for (int e : m_cutEdges)
			for (int v : {m_t.origin(2 * e), m_t.target(2 * e)})
				if (m_degree[at(v)] > 1 && isNode(v) && !m_boundary[at(v)])
					vertices.push_back(v);
		std::sort(vertices.begin(), vertices.end());
		vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
		return vertices;
	}

	/// One edge of every segment.
	std::vector<int> representatives()
	{
		tidy();
		std::vector<int> edges;
		std::vector<char> seen(m_isCut.size(), 0);
		for (int e : m_cutEdges) {
			if (seen[at(e)])
				continue;
			edges.push_back(e);
			for (int k : segmentOf(e))
				seen[at(k)] = 1;
		}
		return edges;
	}

	/// Takes \p edges out of the cut, and the dead ends that are left. \return all that was removed
	std::vector<int> remove(const std::vector<int>& edges)
	{
		std::vector<int> removed, ends;
		const auto drop = [&](int e) {
			set(e, 0);
			removed.push_back(e);
			ends.push_back(m_t.origin(2 * e));
			ends.push_back(m_t.target(2 * e));
		};
		for (int e : edges)
			if (m_isCut[at(e)])
				drop(e);
		while (!ends.empty()) {
			const int v = ends.back();
			ends.pop_back();
			if (m_degree[at(v)] != 1 || m_marked[at(v)] || m_boundary[at(v)])
				continue;
			int last = -1;
			around(v, [&](int h) {
				if (m_isCut[at(Triangulation::edge(h))])
					last = Triangulation::edge(h);
			});
			drop(last);
		}
		return removed;
	}

	double costOf(const std::vector<int>& edges) const
	{
		double sum = 0.0;
		for (int e : edges)
			sum += m_cost[at(e)];
		return sum;
	}

	/// Numbers the boundaries of the surface opened along the cut; marked vertices that the cut
	/// does not reach count as boundaries. Sets m_circle of the halfedges that leave them.
	int labelCircles()
	{
		for (int h : m_labelled)
			m_circle[at(h)] = -1;
		m_labelled.clear();
		tidy();
		int count = 0;
		const auto label = [&](int h) {
			m_circle[at(h)] = count;
			m_labelled.push_back(h);
		};
		const auto follow = [&](int s) {
			if (m_t.isOuter(s) || m_circle[at(s)] >= 0)
				return;
			int h = s;
			do {
				int n = m_t.next(h);
				while (!isBorder(Triangulation::edge(n))) {
					label(n);
					n = m_t.next(Triangulation::twin(n));
				}
				label(n);
				h = n;
			} while (h != s);
			++count;
		};
		for (const std::vector<int>* edges : {&m_cutEdges, &m_boundaryEdges})
			for (int e : *edges) {
				follow(2 * e);
				follow(2 * e + 1);
			}
		for (int v : m_marks)
			if (m_degree[at(v)] == 0) {
				around(v, label);
				++count;
			}
		return count;
	}

	/// Distances from the circles for which \p chosen(circle) holds.
	template<class Chosen>
	void startFrom(Chosen chosen, double bound, Distances& distances)
	{
		distances.clear();
		for (int h : m_labelled)
			if (chosen(m_circle[at(h)]) && usable(Triangulation::edge(h)) &&
				!onGraph(m_t.target(h)) && m_cost[at(Triangulation::edge(h))] < bound)
				distances.offer(m_t.target(h), m_cost[at(Triangulation::edge(h))], h);
	}

	/// Edges of the path from the boundary to \p v.
	void appendPath(const Distances& distances, int v, std::vector<int>& edges) const
	{
		while (!onGraph(v)) {
			const int h = distances.parent(v);
			edges.push_back(Triangulation::edge(h));
			v = m_t.origin(h);
		}
	}

	bool exchange(int representative)
	{
		const std::vector<int> removed = remove(segmentOf(representative));
		std::vector<int> path;
		if (labelCircles() == 2)
			path = shortestBridge((1.0 - kLeastGain) * costOf(removed));
		for (int e : path.empty() ? removed : path)
			set(e, 1);
		return !path.empty();
	}

	/// A shortest path between circles of two sets.
	struct Bridge
	{
		double length;
		int halfedge = -1; // where the searches from both ends met, or -1
	};

	/// Shortest path from a circle with \p isStart to one with \p isEnd, shorter than \p bound, by
	/// searches from both ends. Of these the one that has seen less goes on, so that a path to a
	/// point does not cost a search from all of a long cut.
	template<class IsStart, class IsEnd>
	Bridge shortestPath(IsStart isStart, IsEnd isEnd, double bound)
	{
		Bridge best{bound};
		const auto offer = [&](int h, double length) {
			if (length < best.length)
				best = {length, h};
		};
		for (int h : m_labelled)
			if (isStart(m_circle[at(h)]) && usable(Triangulation::edge(h)) &&
				m_circle[at(Triangulation::twin(h))] >= 0 &&
				isEnd(m_circle[at(Triangulation::twin(h))]))
				offer(h, m_cost[at(Triangulation::edge(h))]);
		Distances &from = m_distances[0], &to = m_distances[1];
		startFrom(isStart, best.length, from);
		startFrom(isEnd, best.length, to);
		const auto step = [&](Distances& own, const Distances& other, auto isOther, auto towards) {
			const int v = own.next(best.length);
			around(v, [&](int h) {
				const int e = Triangulation::edge(h), w = m_t.target(h);
				if (!usable(e))
					return;
				const double d = own[v] + m_cost[at(e)];
				if (onGraph(w)) {
					if (isOther(m_circle[at(Triangulation::twin(h))]))
						offer(towards(h), d);
					return;
				}
				if (!(d < best.length))
					return;
				own.offer(w, d, h);
				offer(towards(h), d + other[w]);
			});
		};
		while (from.nearest() + to.nearest() < best.length)
			if (from.reached().size() <= to.reached().size())
				step(from, to, isEnd, [](int h) { return h; });
			else
				step(to, from, isStart, [](int h) { return Triangulation::twin(h); });
		return best;
	}

	/// Shortest path from circle 0 to another, empty if none is shorter than \p bound.
	std::vector<int> shortestBridge(double bound)
	{
		const Bridge bridge = shortestPath(
			[](int circle) { return circle == 0; }, [](int circle) { return circle > 0; }, bound);
		std::vector<int> path;
		if (bridge.halfedge < 0)
			return path;
		path.push_back(Triangulation::edge(bridge.halfedge));
		appendPath(m_distances[0], m_t.origin(bridge.halfedge), path);
		appendPath(m_distances[1], m_t.target(bridge.halfedge), path);
		return path;
	}

	/// Takes out all segments at node \p v and joins what they joined anew.
	bool rebuild(int v)
	{
		std::vector<int> star;
		int segments = 0;
		bool loop = false;
		around(v, [&](int h) {
			if (!m_isCut[at(Triangulation::edge(h))])
				return;
			const int last = walk(h, star);
			loop |= last == v;
			++segments;
		});
		if (loop)
			return false;
		// The open surface then has as many boundaries as it can have: it lies in a sphere, and
		// any paths that join the boundaries make it a disk.
		const std::vector<int> removed = remove(star);
		const int circles = segments + (m_marked[at(v)] ? 1 : 0);
		std::vector<int> joins;
		if (labelCircles() == circles) {
			double bound = (1.0 - kLeastGain) * costOf(removed);
			if (circles == 3) {
				joins = bestTripod(bound);
				if (!joins.empty())
					bound = costOf(joins);
			}
			std::vector<int> bridges = joinCircles(circles, bound);
			if (!bridges.empty())
				joins = std::move(bridges);
		}
		for (int e : joins.empty() ? removed : joins)
			set(e, 1);
		return !joins.empty();
	}

	/// Joins the circles one after another by shortest bridges. \return their edges, none if they
	/// are not shorter than \p bound together; the cut is left as it is
	std::vector<int> joinCircles(int circles, double bound)
	{
		std::vector<int> edges;
		bool found = true;
		while (found && circles > 1) {
			const std::vector<int> bridge = shortestBridge(bound - costOf(edges));
			found = !bridge.empty();
			for (int e : bridge) {
				set(e, 1);
				edges.push_back(e);
			}
			found = found && labelCircles() == --circles;
		}
		for (int e : edges)
			set(e, 0);
		if (!found)
			edges.clear();
		return edges;
	}

	/// Three paths from the circles 0, 1, 2 that meet in one vertex, empty if they are not shorter
	/// than \p bound together.
	std::vector<int> bestTripod(double bound)
	{
		// Two of the paths join their circles, so the third has at most the rest of the bound.
		std::array<double, 3> longest;
		for (int circle = 0; circle < 3; ++circle) {
			const int second = (circle + 1) % 3, third = (circle + 2) % 3;
			const Bridge opposite = shortestPath(
				[&](int c) { return c == second; }, [&](int c) { return c == third; }, bound);
			longest[at(circle)] = bound - opposite.length;
		}
		for (int circle = 0; circle < 3; ++circle) {
			Distances& distances = m_distances[at(circle)];
			const double limit = longest[at(circle)];
			startFrom([&](int c) { return c == circle; }, limit, distances);
			for (int v; (v = distances.next(limit)) >= 0;)
				around(v, [&](int h) {
					const double d = distances[v] + m_cost[at(Triangulation::edge(h))];
					if (usable(Triangulation::edge(h)) && !onGraph(m_t.target(h)) && d < limit)
						distances.offer(m_t.target(h), d, h);
				});
		}
		double least = bound;
		int centre = -1;
		for (int v : m_distances[0].reached()) {
			const double sum = m_distances[0][v] + m_distances[1][v] + m_distances[2][v];
			if (sum < least || (sum == least && v < centre)) {
				least = sum;
				centre = v;
			}
		}
		std::vector<int> edges;
		if (centre < 0)
			return edges;
		for (int circle = 0; circle < 3; ++circle)
			appendPath(m_distances[at(circle)], centre, edges);
		// Paths that touch before the centre would enclose something.
		std::vector<int> ends;
		for (int e : edges)
			for (int v : {m_t.origin(2 * e), m_t.target(2 * e)})
				if (v != centre && !onGraph(v))
					ends.push_back(v);
		std::sort(ends.begin(), ends.end());
		for (std::size_t i = 2; i < ends.size(); ++i)
			if (ends[i] == ends[i - 2])
				return {};
		return edges;
	}

	const Triangulation& m_t;
	const std::vector<double>& m_cost;
	const std::vector<char>& m_marked;
	const std::vector<char>& m_forbidden;
	std::vector<char>& m_isCut;
	std::vector<char> m_boundary;
	std::vector<int> m_degree;   // [vertex] cut edges
	std::vector<char> m_onGraph; // [vertex] the searches end there, see onGraph()
	std::vector<char> m_usable;  // [edge] a path may run there
	std::vector<int> m_any;      // [vertex] a halfedge that leaves it
	std::vector<int> m_circle;   // [halfedge] boundary of the open surface at its origin, or -1
	std::vector<int> m_labelled; // halfedges with a circle
	std::vector<int> m_cutEdges; // all of them, and some that are no longer; see tidy()
	std::vector<int> m_boundaryEdges;
	std::vector<int> m_marks; // marked vertices inside
	std::vector<Distances> m_distances;
};

} // namespace

void shortenCut(
	const Triangulation& t,
	const std::vector<double>& cost,
	const std::vector<char>& marked,
	const std::vector<char>& forbidden,
	std::vector<char>& isCut,
	const std::function<void()>& tick)
{
	if (std::find(isCut.begin(), isCut.end(), 1) != isCut.end())
		Shortener(t, cost, marked, forbidden, isCut).run(tick);
}

} // namespace ricci
