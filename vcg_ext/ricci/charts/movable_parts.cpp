// SPDX-License-Identifier: GPL-3.0-or-later
#include "movable_parts.h"

#include "../base/points.h"
#include "../base/tolerances.h"
#include "../metric/area.h"

#include <map>
#include <utility>

namespace ricci {

MovableParts::MovableParts(
	const FlatMesh& chart, const std::vector<std::vector<int>>& parts, const BoxTree* all) :
		m_chart(chart),
		m_all(all), m_plane(chart.corners()), m_isProper(chart.size()), m_part(chart.size(), -1),
		m_group(chart.size(), -1), m_before(chart.size(), -1), m_next(chart.size(), -1)
{
	Box2 whole;
	for (const int f : m_plane.indices())
		m_isProper[f] = orientation(m_plane[f]) > 0;
	for (const std::vector<int>& triangles : parts) {
		const int part = addPart();
		m_groupsOf[part].push_back(m_groups.size());
		Group group{m_all ? -1 : m_origins.size(), {}, {}, {}};
		std::vector<Box2> boxes;
		boxes.reserve(triangles.size());
		for (const int f : triangles) {
			append(f, part);
			m_group[f] = m_groups.size();
			m_area[part] += areaOf(f);
			boxes.push_back(boxOf(m_plane[f]));
			group.box.add(boxes.back());
			whole.add(boxes.back());
		}
		m_groups.push_back(group);
		if (!m_all)
			m_origins.push_back({triangles, BoxTree(boxes)});
	}
	m_onePlace = kTiny * whole.extent();
	m_touching = kTiny * whole.extent();
	commit();
}

std::vector<int> MovableParts::trianglesOf(int part) const
{
	std::vector<int> triangles;
	for (int f = m_first[part]; f >= 0; f = m_next[f])
		triangles.push_back(f);
	return triangles;
}

Motion MovableParts::across(Corner side) const
{
	const auto own = endsOf(side), other = endsOf(m_chart.across[side]);
	const auto vector = [](const Point2& p, const Point2& q) {
		return asComplex(q) - asComplex(p);
	};
	const auto middle = [](const std::array<Point2, 2>& p) {
		return 0.5 * (asComplex(p[1]) + asComplex(p[0]));
	};
	const std::complex<double> turn =
		vector(other[1], other[0]) * std::conj(vector(own[0], own[1]));
	Motion motion;
	if (const double size = std::abs(turn); size > 0.0)
		motion.turn = turn / size;
	motion.shift = middle(other) - motion.turn * middle(own);
	return motion;
}

bool MovableParts::fits(const Motion& motion, Corner side) const
{
	const auto own = endsOf(side), other = endsOf(m_chart.across[side]);
	return distance(motion(own[0]), other[1]) <= m_onePlace &&
		   distance(motion(own[1]), other[0]) <= m_onePlace;
}

bool MovableParts::isJoined(Corner side) const
{
	const Corner across = m_chart.across[side];
	if (m_part[side.face()] != m_part[across.face()])
		return false;
	const auto own = endsOf(side), other = endsOf(across);
	return (own[0] == other[1] && own[1] == other[0]) || fits({}, side);
}

MovableParts::Groups MovableParts::groupsNear(int part, const Place& place) const
{
	Box2 moved;
	for (const int group : m_groupsOf[part]) {
		const Box2& box = m_groups[group].box;
		for (const double x : {box.min[0], box.max[0]})
			for (const double y : {box.min[1], box.max[1]})
				moved.add(place.motion(Point2{x, y}));
	}
	std::vector<int> near;
	std::vector<Box2> boxes;
	for (const int group : m_groupsOf[place.other])
		if (const Box2& box = m_groups[group].box; box.meets(moved)) {
			near.push_back(group);
			boxes.push_back(box);
		}
	return {std::move(near), BoxTree(boxes)};
}

int MovableParts::addPart()
{
	m_first.push_back(-1);
	m_last.push_back(-1);
	m_groupsOf.push_back({});
	m_area.push_back(0.0);
	m_size.push_back(0);
	return count() - 1;
}

void MovableParts::move(const std::vector<int>& triangles, const Place& place)
{
	const int from = m_part[triangles.front()], to = place.other;
	Move done{from, to, m_area[from], m_area[to], {}, m_groupsOf[to].size()};
	std::map<int, int> groups; // from the old to the new
	for (const int f : triangles) {
		const auto [group, isNew] = groups.try_emplace(m_group[f], m_groups.size());
		if (isNew) {
			const Group& old = m_groups[m_group[f]];
			const Motion motion = place.motion.after(old.motion);
			m_groups.push_back({old.origin, motion, motion.inverse(), Box2()});
			m_groupsOf[to].push_back(group->second);
		}
		m_area[from] -= areaOf(f);
		m_area[to] += areaOf(f);
		Triangle2& plane = m_plane[f];
		done.changes.push_back({f, m_group[f], remove(f), plane});
		append(f, to);
		m_group[f] = group->second;
		plane = place.motion(plane);
		for (const Point2& p : plane)
			m_groups[m_group[f]].box.add(p);
	}
	m_moves.push_back(std::move(done));
}

void MovableParts::commit()
{
	m_moves.clear();
	m_committedParts = count();
	m_committedGroups = m_groups.size();
}

void MovableParts::undo()
{
	for (; !m_moves.empty(); m_moves.pop_back()) {
		const Move& move = m_moves.back();
		for (auto change = move.changes.rbegin(); change != move.changes.rend(); ++change) {
			remove(change->triangle);
			insertBehind(change->before, change->triangle, move.from);
			m_group[change->triangle] = change->group;
			m_plane[change->triangle] = change->plane;
		}
		m_groupsOf[move.to].resize(move.groups);
		m_area[move.from] = move.fromArea;
		m_area[move.to] = move.toArea;
	}
	m_groups.resize(m_committedGroups);
	m_groupsOf.resize(m_committedParts);
	m_area.resize(m_committedParts);
	m_size.resize(m_committedParts);
	m_first.resize(m_committedParts);
	m_last.resize(m_committedParts);
}

double MovableParts::areaOf(int triangle) const
{
	return euclideanArea(m_chart.lengths[triangle]);
}

void MovableParts::append(int triangle, int part)
{
	insertBehind(m_last[part], triangle, part);
}

/// \return the triangle before it in its part, or -1
int MovableParts::remove(int triangle)
{
	const int before = m_before[triangle], next = m_next[triangle], part = m_part[triangle];
	--m_size[part];
	(before >= 0 ? m_next[before] : m_first[part]) = next;
	(next >= 0 ? m_before[next] : m_last[part]) = before;
	return before;
}

void MovableParts::insertBehind(int before, int triangle, int part)
{
	const int next = before >= 0 ? m_next[before] : m_first[part];
	m_part[triangle] = part;
	++m_size[part];
	m_before[triangle] = before;
	m_next[triangle] = next;
	(before >= 0 ? m_next[before] : m_first[part]) = triangle;
	(next >= 0 ? m_before[next] : m_last[part]) = triangle;
}

} // namespace ricci
