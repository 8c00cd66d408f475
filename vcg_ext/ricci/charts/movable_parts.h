// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MOVABLE_PARTS_H
#define RICCI_MOVABLE_PARTS_H

#include "../base/box_tree.h"
#include "../base/points.h"
#include "../base/tolerances.h"
#include "../layout/flat_mesh.h"
#include "../metric/area.h"
#include "chart_overlap.h"

#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace ricci {

/// A place for a part beside another one.
struct Place
{
	int other; ///< part
	Motion motion;
	double length; ///< of the common border, on the surface
};

/// Parts of a chart whose triangles move from one to another. Moves can be undone; each costs what it
/// moves.
class MovableParts
{
public:
	/// \param parts triangles
	MovableParts(const FlatMesh& chart, const Parts& parts) :
			m_chart(chart), m_plane(chart.corners()), m_isProper(chart.size()),
			m_part(chart.size(), -1), m_group(chart.size(), -1), m_before(chart.size(), -1),
			m_next(chart.size(), -1)
	{
		Box2 whole;
		for (const int f : m_plane.indices())
			m_isProper[f] = orientation(m_plane[f]) > 0;
		for (const std::vector<int>& triangles : parts) {
			const int part = addPart();
			m_groupsOf[part].push_back(m_groups.size());
			Group group{m_origins.size(), {}, {}, {}};
			std::vector<Box2> boxes;
			boxes.reserve(triangles.size());
			for (const int f : triangles) {
				append(f, part);
				m_group[f] = m_groups.size();
				m_area[part] += areaOf(f);
				boxes.push_back(boxAround(m_plane[f]));
				group.box.add(boxes.back());
				whole.add(boxes.back());
			}
			m_groups.push_back(group);
			m_origins.push_back({triangles, BoxTree(boxes)});
		}
		m_touching = kTiny * whole.extent();
		commit();
	}

	int count() const { return m_area.size(); }
	bool isEmpty(int part) const { return m_first[part] < 0; }
	std::vector<int> trianglesOf(int part) const
	{
		std::vector<int> triangles;
		for (int f = m_first[part]; f >= 0; f = m_next[f])
			triangles.push_back(f);
		return triangles;
	}

	int partOf(int triangle) const { return m_part[triangle]; }
	/// Number of triangles.
	int size(int part) const { return m_size[part]; }
	/// On the surface.
	double area(int part) const { return m_area[part]; }
	double areaOf(int triangle) const { return euclideanArea(m_chart.lengths[triangle]); }

	/// Where a triangle is.
	const Triangle2& at(int triangle) const { return m_plane[triangle]; }

	/// Calls visit(side, other) for the sides of \p triangle with a side of another one across.
	template<class Visit>
	void forSides(int triangle, const Visit& visit) const
	{
		for (const Corner side : cornersOf(triangle))
			if (const Corner other = m_chart.across[side]; other.isValid())
				visit(side, other);
	}

	/// The motion of a side to the one across.
	Motion across(Corner side) const
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

	/// Whether \p motion brings a side to the place of the one across.
	bool fits(const Motion& motion, Corner side) const
	{
		const auto own = endsOf(side), other = endsOf(m_chart.across[side]);
		return distance(motion(own[0]), other[1]) <= m_touching &&
			   distance(motion(own[1]), other[0]) <= m_touching;
	}

	/// Whether a side and the one across are at one place in one part.
	bool isJoined(Corner side) const
	{
		const Corner across = m_chart.across[side];
		if (m_part[side.face()] != m_part[across.face()])
			return false;
		const auto own = endsOf(side), other = endsOf(across);
		return (own[0] == other[1] && own[1] == other[0]) || fits({}, side);
	}

	/// Triangles, or groups of them, by the boxes round them.
	struct ByBox
	{
		std::vector<int> numbers;
		BoxTree tree; ///< of their boxes
	};

	/// The groups of the other part that come near \p part at its new place: others it does not cover.
	ByBox groupsNear(int part, const Place& place) const
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

	/// Calls isEnough(g) for the triangles g of the other part that those of the part cover at its new place,
	/// flipped ones left out, once for each of these, until it is.
	/// \return whether it was
	template<class IsEnough>
	bool covering(int part, const Place& place, const IsEnough& isEnough) const
	{
		const ByBox near = groupsNear(part, place);
		if (near.numbers.empty())
			return false;
		// Some all over the part first, for neighbours give about the same answer.
		const std::vector<int> triangles = trianglesOf(part);
		for (std::size_t first = 0; first < kStride; ++first)
			for (std::size_t i = first; i < triangles.size(); i += kStride)
				if (const int f = triangles[i];
					m_isProper[f] && coveredBy(place.motion(m_plane[f]), near, isEnough))
					return true;
		return false;
	}

	/// Whether one triangle covers some of \p near at its new place.
	bool covers(int triangle, const Motion& motion, const ByBox& near) const
	{
		return m_isProper[triangle] &&
			   coveredBy(motion(m_plane[triangle]), near, [](int) { return true; });
	}

	/// Adds an empty part. \return its number
	int addPart()
	{
		m_first.push_back(-1);
		m_last.push_back(-1);
		m_groupsOf.push_back({});
		m_area.push_back(0.0);
		m_size.push_back(0);
		return count() - 1;
	}

	/// Moves triangles of one part to another.
	void move(const std::vector<int>& triangles, const Place& place)
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

	/// Forgets how to undo what was done.
	void commit()
	{
		m_moves.clear();
		m_committedParts = count();
		m_committedGroups = m_groups.size();
	}

	/// Undoes all since commit().
	void undo()
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

private:
	static constexpr std::size_t kStride = 31;

	/// Triangles of one part that were moved alike.
	struct Group
	{
		int origin;
		Motion motion, back; ///< since the beginning, and its inverse
		Box2 box;            ///< round the triangles where they are now, at least
	};

	struct Change
	{
		int triangle, group, before; ///< before: the triangle in front of it in its part
		Triangle2 plane;
	};
	struct Move
	{
		int from, to;
		double fromArea, toArea;
		std::vector<Change> changes;
		std::size_t groups; ///< of the part to
	};
	void append(int triangle, int part) { insertBehind(m_last[part], triangle, part); }

	/// \return the triangle before it in its part, or -1
	int remove(int triangle)
	{
		const int before = m_before[triangle], next = m_next[triangle], part = m_part[triangle];
		--m_size[part];
		(before >= 0 ? m_next[before] : m_first[part]) = next;
		(next >= 0 ? m_before[next] : m_last[part]) = before;
		return before;
	}

	void insertBehind(int before, int triangle, int part)
	{
		const int next = before >= 0 ? m_next[before] : m_first[part];
		m_part[triangle] = part;
		++m_size[part];
		m_before[triangle] = before;
		m_next[triangle] = next;
		(before >= 0 ? m_next[before] : m_first[part]) = triangle;
		(next >= 0 ? m_before[next] : m_last[part]) = triangle;
	}

	template<class IsFound>
	bool coveredBy(const Triangle2& p, const ByBox& groups, const IsFound& isFound) const
	{
		return groups.tree.meetsAny(boxAround(p), [&](int k) {
			const int group = groups.numbers[positionOf(k)];
			const ByBox& origin = m_origins[m_groups[group].origin];
			return origin.tree.meetsAny(boxAround(m_groups[group].back(p)), [&](int i) {
				const int g = origin.numbers[positionOf(i)];
				return m_group[g] == group && m_isProper[g] && overlap(p, m_plane[g], m_touching) &&
					   isFound(g);
			});
		});
	}

	std::array<Point2, 2> endsOf(Corner side) const
	{
		return {m_plane[side], m_plane[side.next()]};
	}

	const FlatMesh& m_chart;
	double m_touching = 0.0;  // what is nearer is at one place
	Array<Triangle2> m_plane; // [triangle] where it is
	Array<char> m_isProper;   // [triangle] counter-clockwise
	Array<int> m_part;        // [triangle]
	Array<int> m_group;       // [triangle]
	/// Parts in the beginning: those that lie over each other are not looked through together.
	Array<ByBox> m_origins;
	Array<Group> m_groups;
	Array<std::vector<int>> m_groupsOf; // [part]
	Array<double> m_area;               // [part]
	Array<int> m_size;                  // [part]
	// The triangles of a part are a list: those before and behind a triangle, and its ends.
	Array<int> m_before, m_next, m_first, m_last;
	// Since commit().
	std::vector<Move> m_moves;
	int m_committedParts = 0, m_committedGroups = 0;
};

} // namespace ricci

#endif
