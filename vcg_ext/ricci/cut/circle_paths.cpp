// SPDX-License-Identifier: GPL-3.0-or-later
#include "circle_paths.h"

#include <algorithm>
#include <array>
#include <limits>

namespace ricci {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

} // namespace

CirclePaths::CirclePaths(CutSegments& cut, const CoarseSurface* parts) :
		m_t(cut.triangulation()), m_cost(cut.cost()), m_cut(cut), m_parts(parts),
		m_isNear(parts ? parts->triangulation().vertexCount() : 0, 0),
		m_fronts(3, Front(m_t.vertexCount()))
{
	if (parts)
		m_members = Adjacency<Vertex, Vertex>(m_isNear.size(), [&](const auto& add) {
			for (const Vertex v : m_t.vertices())
				if (parts->centreOf(v).isValid())
					add(parts->centreOf(v), v);
		});
}

void CirclePaths::findNear(const std::vector<Edge>& removed)
{
	if (!m_parts)
		return;
	for (const Vertex part : m_near)
		m_isNear[part] = 0;
	m_near.clear();
	const auto add = [&](Vertex part) {
		if (!m_isNear[part])
			m_near.push_back(part);
		m_isNear[part] = 1;
	};
	Vertex last;
	for (const Edge e : removed)
		for (const Vertex v : m_t.ends(e))
			if (const Vertex part = m_parts->centreOf(v); part != last) {
				last = part;
				add(part);
				for (const Halfedge h : m_parts->triangulation().around(part))
					add(m_parts->triangulation().target(h));
			}
}

/// Whether paths may run through \p v.
bool CirclePaths::isOpen(Vertex v) const
{
	return !m_cut.isOnGraph(v) && (!m_parts || m_isNear[m_parts->centreOf(v)]);
}

int CirclePaths::splitCircles(const std::vector<Edge>& removed)
{
	const int count = m_cut.splitCircles(removed);
	findStarts();
	return count;
}

void CirclePaths::findStarts()
{
	m_starts.clear();
	const auto addFrom = [&](Vertex v) {
		int circle = -1; // of the halfedges up to the next side
		for (const Halfedge h : m_cut.around(v)) {
			if (m_cut.isBorder(h.edge()))
				circle = -1;
			else if (
				m_cut.isFree(h.edge()) &&
				(isOpen(m_t.target(h)) || m_cut.isOnGraph(m_t.target(h)))) {
				if (circle < 0)
					circle = m_cut.circle(h);
				m_starts.push_back({h, circle});
			}
		}
	};
	if (!m_parts)
		for (const Vertex v : m_t.vertices())
			if (m_cut.isOnGraph(v))
				addFrom(v);
	for (const Vertex part : m_near)
		for (const Vertex v : m_members[part]) {
			if (m_cut.isOnGraph(v)) {
				addFrom(v);
				continue;
			}
			for (const Halfedge h : m_t.around(v)) {
				const Vertex beyond = m_t.target(h);
				if (m_cut.isOnGraph(beyond) && !m_isNear[m_parts->centreOf(beyond)] &&
					m_cut.isFree(h.edge()))
					m_starts.push_back({h.twin(), m_cut.circle(h.twin())});
			}
		}
}

/// Lets \p front begin at the circles for which \p chosen(circle) holds.
template<class Chosen>
void CirclePaths::startFrom(const Chosen& chosen, double bound, Front& front) const
{
	front.clear();
	for (const auto& [h, circle] : m_starts)
		if (chosen(circle) && isOpen(m_t.target(h)) && m_cost[h.edge()] < bound)
			front.offer(m_t.target(h), m_cost[h.edge()], h);
}

void CirclePaths::appendPath(const Front& front, Vertex v, std::vector<Edge>& edges) const
{
	while (!m_cut.isOnGraph(v)) {
		const Halfedge h = front.parent(v);
		edges.push_back(h.edge());
		v = m_t.origin(h);
	}
}

/// By searches from both ends. Of these the one that has seen less goes on, so that a path to a point
/// does not cost a search from all of a long cut.
std::vector<Edge> CirclePaths::shortestBridge(double bound)
{
	const auto isStart = [](int circle) { return circle == 0; };
	const auto isEnd = [](int circle) { return circle > 0; };
	Halfedge middle; // where the searches met
	const auto offer = [&](Halfedge h, double length) {
		if (length < bound) {
			bound = length;
			middle = h;
		}
	};
	for (const auto& [h, circle] : m_starts)
		if (m_cost[h.edge()] < bound && !isOpen(m_t.target(h)) &&
			isStart(circle) != isStart(m_cut.circle(h.twin())))
			offer(isStart(circle) ? h : h.twin(), m_cost[h.edge()]);
	Front &from = m_fronts[0], &to = m_fronts[1];
	startFrom(isStart, bound, from);
	startFrom(isEnd, bound, to);
	const auto step = [&](Front& own, const Front& other, auto isOther, auto towards) {
		const Vertex v = own.next(bound);
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
			if (!(d < bound) || !isOpen(w))
				continue;
			own.offer(w, d, h);
			offer(towards(h), d + other[w]);
		}
	};
	while (from.nearest() + to.nearest() < bound)
		if (from.reached().size() <= to.reached().size())
			step(from, to, isEnd, [](Halfedge h) { return h; });
		else
			step(to, from, isStart, [](Halfedge h) { return h.twin(); });
	std::vector<Edge> path;
	if (!middle.isValid())
		return path;
	path.push_back(middle.edge());
	appendPath(from, m_t.origin(middle), path);
	appendPath(to, m_t.target(middle), path);
	Halfedge last = middle.twin();
	while (!m_cut.isOnGraph(m_t.origin(last)))
		last = to.parent(m_t.origin(last));
	m_arrival = m_cut.circle(last);
	return path;
}

std::vector<Edge> CirclePaths::joinCircles(int circles, double bound)
{
	std::vector<Edge> edges;
	bool found = true;
	for (; found && circles > 1; --circles) {
		const std::vector<Edge> bridge = shortestBridge(bound - costOf(edges));
		found = !bridge.empty();
		m_cut.add(bridge);
		edges.insert(edges.end(), bridge.begin(), bridge.end());
		m_cut.joinCircles(m_arrival);
		findStarts();
	}
	m_cut.remove(edges);
	if (!found)
		edges.clear();
	return edges;
}

/// No search starts from the longest circle: the sums of the distances from the two others are continued
/// until they arrive there.
std::vector<Edge> CirclePaths::bestTripod(double bound)
{
	std::array<int, 3> starts{};
	for (const Start& start : m_starts)
		++starts[positionOf(start.circle)];
	const int last =
		static_cast<int>(std::max_element(starts.begin(), starts.end()) - starts.begin());
	searchFromBoth((last + 1) % 3, (last + 2) % 3, last, bound);
	Front& sums = m_fronts[2];
	sums.clear();
	for (const Vertex v : m_fronts[0].reached())
		if (const double sum = m_fronts[0][v] + m_fronts[1][v]; sum < bound)
			sums.offer(v, sum);
	Halfedge arrival;
	for (Vertex v; (v = sums.next(bound)).isValid();)
		if (const auto [length, h] = goOn(sums, v, last, bound); length < bound) {
			bound = length;
			arrival = h;
		}
	std::vector<Edge> edges;
	if (!arrival.isValid())
		return edges;
	Vertex centre = m_t.origin(arrival);
	edges.push_back(arrival.edge());
	for (Halfedge h; (h = sums.parent(centre)).isValid(); centre = m_t.origin(h))
		edges.push_back(h.edge());
	appendPath(m_fronts[0], centre, edges);
	appendPath(m_fronts[1], centre, edges);
	return touch(edges, centre) ? std::vector<Edge>() : edges;
}

/// Searches from two circles, in the fronts 0 and 1, as far as a vertex may lie at which paths
/// from them and from the circle \p last meet that are shorter than \p bound together.
void CirclePaths::searchFromBoth(int first, int second, int last, double bound)
{
	const std::array<int, 2> circle{first, second};
	std::array<double, 2> toLast{kFar, kFar};
	for (std::size_t k = 0; k < 2; ++k)
		startFrom([&](int c) { return c == circle[k]; }, bound, m_fronts[k]);
	for (const auto& [h, from] : m_starts)
		for (std::size_t k = 0; k < 2; ++k)
			if (from == circle[k] && m_cost[h.edge()] < toLast[k] && m_cut.circle(h.twin()) == last)
				toLast[k] = m_cost[h.edge()];
	for (;;) {
		// Two of the paths join their circles, so the third has at most the rest of the bound.
		const double r[2] = {m_fronts[0].nearest(), m_fronts[1].nearest()};
		const double limit[2] = {
			bound - std::min(toLast[1], r[1]), bound - std::min(toLast[0], r[0])};
		if (!(r[0] < limit[0]) && !(r[1] < limit[1]))
			return;
		const std::size_t k = r[0] < limit[0] && (r[0] <= r[1] || !(r[1] < limit[1])) ? 0 : 1;
		const auto [length, h] = goOn(m_fronts[k], m_fronts[k].next(), last, limit[k]);
		toLast[k] = std::min(toLast[k], length);
	}
}

/// Continues a search from \p v as far as \p limit. \return the shortest arrival at \p circle, and
/// its length; infinite if there is none
std::pair<double, Halfedge>
CirclePaths::goOn(Front& front, Vertex v, int circle, double limit) const
{
	std::pair<double, Halfedge> arrival{kFar, Halfedge()};
	for (const Halfedge h : m_cut.around(v)) {
		const double d = front[v] + m_cost[h.edge()];
		if (!m_cut.isFree(h.edge()))
			continue;
		if (isOpen(m_t.target(h))) {
			if (d < limit)
				front.offer(m_t.target(h), d, h);
		}
		else if (m_cut.circle(h.twin()) == circle && d < arrival.first)
			arrival = {d, h};
	}
	return arrival;
}

/// Whether paths to \p centre touch before it: they would enclose something.
bool CirclePaths::touch(const std::vector<Edge>& paths, Vertex centre) const
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

double CirclePaths::costOf(const std::vector<Edge>& edges) const
{
	double sum = 0.0;
	for (const Edge e : edges)
		sum += m_cost[e];
	return sum;
}

std::size_t CirclePaths::reached() const
{
	std::size_t count = m_starts.size();
	for (const Front& front : m_fronts)
		count += front.reached().size();
	return count;
}

} // namespace ricci
