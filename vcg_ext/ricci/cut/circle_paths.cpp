// SPDX-License-Identifier: GPL-3.0-or-later
#include "circle_paths.h"

#include <algorithm>
#include <array>

namespace ricci {

CirclePaths::CirclePaths(CutSegments& cut, const CoarseSurface* parts) :
		m_t(cut.triangulation()), m_cost(cut.cost()), m_cut(cut), m_parts(parts),
		m_isNear(partCount(), 1), m_fronts(3, Front(m_t.vertexCount()))
{
	for (const Vertex part : m_isNear.indices())
		m_near.push_back(part);
}

int CirclePaths::labelCircles()
{
	const int count = m_cut.labelCircles();
	m_places.assign(partCount(), {});
	addPlaces(0);
	return count;
}

std::size_t CirclePaths::update(const std::vector<Edge>& removed, const std::vector<Edge>& added)
{
	const int first = m_cut.update(removed, added);
	if (m_cut.isFragmented()) {
		labelCircles();
		return m_cut.sides().size();
	}
	addPlaces(first);
	return m_cut.sides().size() - positionOf(first);
}

/// Enters those from \p first on.
void CirclePaths::addPlaces(int first)
{
	for (std::size_t i = positionOf(first); i < m_cut.sides().size(); ++i)
		m_places[partOf(m_t.origin(m_cut.sides()[i]))].push_back(static_cast<int>(i));
}

void CirclePaths::findNear(const std::vector<Edge>& removed)
{
	m_reached = 0;
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
			if (const Vertex part = partOf(v); part != last) {
				last = part;
				add(part);
				for (const Halfedge h : m_parts->triangulation().around(part))
					add(m_parts->triangulation().target(h));
			}
}

/// Whether paths may run through \p v.
bool CirclePaths::isOpen(Vertex v) const
{
	return !m_cut.isOnGraph(v) && m_isNear[partOf(v)];
}

int CirclePaths::splitCircles(const std::vector<Edge>& removed)
{
	const int count = m_cut.splitCircles(removed);
	m_starts.clear();
	for (const Vertex part : m_near) {
		m_cut.addDepartures(m_places[part], m_starts);
		m_reached += m_places[part].size();
	}
	m_cut.addDeparturesOfMarks(m_starts);
	// Of equally short paths the first is taken: that does not depend on the changes before.
	using Departure = CutSegments::Departure;
	std::sort(m_starts.begin(), m_starts.end(), [](const Departure& a, const Departure& b) {
		return a.origin != b.origin ? a.origin < b.origin : a.halfedge < b.halfedge;
	});
	return count;
}

/// Lets \p front begin at \p circle, or at all but circle 0 if that is 0.
/// \return the shortest arrival at circle 0 by a single edge
CirclePaths::Arrival CirclePaths::startFrom(int circle, double bound, Front& front) const
{
	front.clear();
	Arrival arrival{kFar, Halfedge()};
	for (const CutSegments::Departure& start : m_starts)
		if (circle == 0 || start.circle == circle)
			goOn(start.halfedge, m_cost[start.halfedge.edge()], bound, front, arrival);
	return arrival;
}

/// Continues a search by \p h to a path of this length, if that is below the bound, and below \p arrival if it
/// arrives at circle 0.
void CirclePaths::goOn(
	Halfedge h, double length, double bound, Front& front, Arrival& arrival) const
{
	if (!(length < bound) || !m_cut.isFree(h.edge()))
		return;
	const Vertex v = m_t.target(h);
	if (isOpen(v))
		front.offer(v, length, h);
	else if (length < arrival.first && m_cut.isOnGraph(v) && m_cut.circle(h.twin()) == 0)
		arrival = {length, h};
}

/// Continues a search from \p v. \return the shortest arrival at circle 0
CirclePaths::Arrival CirclePaths::goOn(Front& front, Vertex v, double bound) const
{
	Arrival arrival{kFar, Halfedge()};
	for (const Halfedge h : m_cut.around(v))
		goOn(h, front[v] + m_cost[h.edge()], bound, front, arrival);
	return arrival;
}

void CirclePaths::appendPath(const Front& front, Vertex v, std::vector<Edge>& edges) const
{
	while (!m_cut.isOnGraph(v)) {
		const Halfedge h = front.parent(v);
		edges.push_back(h.edge());
		v = m_t.origin(h);
	}
}

/// The search begins at the other circles, each of which has fewer sides: a path from a point does not cost a
/// search from all of a long cut.
std::vector<Edge> CirclePaths::shortestBridge(double bound)
{
	Front& front = m_fronts[0];
	Arrival best{bound, Halfedge()};
	const auto offer = [&](const Arrival& arrival) {
		if (arrival.first < best.first)
			best = arrival;
	};
	offer(startFrom(0, bound, front));
	for (Vertex v; (v = front.next(best.first)).isValid();)
		offer(goOn(front, v, best.first));
	m_reached += front.reached().size();
	std::vector<Edge> path;
	if (!best.second.isValid())
		return path;
	Halfedge h = best.second;
	for (; !m_cut.isOnGraph(m_t.origin(h)); h = front.parent(m_t.origin(h)))
		path.push_back(h.edge());
	path.push_back(h.edge());
	m_joined = m_cut.circle(h);
	return path;
}

std::vector<Edge> CirclePaths::joinCircles(int circles, double bound)
{
	std::vector<Edge> edges;
	bool found = true;
	for (; circles > 1; --circles) {
		const std::vector<Edge> bridge = shortestBridge(bound - costOf(edges));
		found = !bridge.empty();
		if (!found)
			break;
		m_cut.add(bridge);
		edges.insert(edges.end(), bridge.begin(), bridge.end());
		m_cut.joinCircles(m_joined);
		m_starts.erase(
			std::remove_if(
				m_starts.begin(),
				m_starts.end(),
				[&](const auto& start) { return start.circle == m_joined; }),
			m_starts.end());
	}
	m_cut.remove(edges);
	if (!found)
		edges.clear();
	return edges;
}

/// No search starts from circle 0, which has the most sides: the sums of the distances from the two others are
/// continued until they arrive there.
std::vector<Edge> CirclePaths::bestTripod(double bound)
{
	searchFromBoth(bound);
	Front& sums = m_fronts[2];
	sums.clear();
	for (const Vertex v : m_fronts[0].reached())
		if (const double sum = m_fronts[0][v] + m_fronts[1][v]; sum < bound)
			sums.offer(v, sum);
	Halfedge arrival;
	for (Vertex v; (v = sums.next(bound)).isValid();)
		if (const auto [length, h] = goOn(sums, v, bound); length < bound) {
			bound = length;
			arrival = h;
		}
	for (const Front& front : m_fronts)
		m_reached += front.reached().size();
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

/// Searches from the circles 1 and 2, in the fronts 0 and 1, as far as a vertex may lie at which paths from
/// them and from circle 0 meet that are shorter than \p bound together.
void CirclePaths::searchFromBoth(double bound)
{
	std::array<double, 2> toLast{};
	for (std::size_t k = 0; k < 2; ++k)
		toLast[k] = startFrom(static_cast<int>(k) + 1, bound, m_fronts[k]).first;
	for (;;) {
		// Two of the paths join their circles, so the third has at most the rest of the bound.
		const double r[2] = {m_fronts[0].nearest(), m_fronts[1].nearest()};
		const double limit[2] = {
			bound - std::min(toLast[1], r[1]), bound - std::min(toLast[0], r[0])};
		if (!(r[0] < limit[0]) && !(r[1] < limit[1]))
			return;
		const std::size_t k = r[0] < limit[0] && (r[0] <= r[1] || !(r[1] < limit[1])) ? 0 : 1;
		toLast[k] = std::min(toLast[k], goOn(m_fronts[k], m_fronts[k].next(), limit[k]).first);
	}
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

} // namespace ricci
