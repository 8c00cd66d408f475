// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MOVABLE_PARTS_H
#define RICCI_MOVABLE_PARTS_H

#include "../base/box_tree.h"
#include "../layout/flat_mesh.h"
#include "chart_overlap.h"

#include <array>
#include <cstddef>
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
	/// \param all of the boxes of all triangles, if no point lies in many of them: it saves trees for the parts.
	/// It must outlive this.
	MovableParts(
		const FlatMesh& chart,
		const std::vector<std::vector<int>>& parts,
		const BoxTree* all = nullptr);

	int count() const { return m_area.size(); }
	bool isEmpty(int part) const { return m_first[part] < 0; }
	std::vector<int> trianglesOf(int part) const;
	int partOf(int triangle) const { return m_part[triangle]; }
	/// Number of triangles.
	int size(int part) const { return m_size[part]; }
	/// On the surface.
	double area(int part) const { return m_area[part]; }
	double areaOf(int triangle) const;
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
	Motion across(Corner side) const;

	/// Whether \p motion brings a side to the place of the one across.
	bool fits(const Motion& motion, Corner side) const;

	/// Whether a side and the one across are at one place in one part.
	bool isJoined(Corner side) const;

	/// Groups of triangles of one part, see groupsNear().
	struct Groups
	{
		std::vector<int> numbers;
		BoxTree tree; ///< of their boxes
	};

	/// The groups of the other part that come near \p part at its new place: others it does not cover.
	Groups groupsNear(int part, const Place& place) const;

	/// Calls isEnough(g) for the triangles g of the other part that those of the part cover at its new place,
	/// flipped ones left out, once for each of these, until it is.
	/// \return whether it was
	template<class IsEnough>
	bool covering(int part, const Place& place, const IsEnough& isEnough) const
	{
		const Groups near = groupsNear(part, place);
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
	bool covers(int triangle, const Motion& motion, const Groups& near) const
	{
		return m_isProper[triangle] &&
			   coveredBy(motion(m_plane[triangle]), near, [](int) { return true; });
	}

	/// Adds an empty part. \return its number
	int addPart();

	/// Moves triangles of one part to another.
	void move(const std::vector<int>& triangles, const Place& place);

	/// Forgets how to undo what was done.
	void commit();

	/// Undoes all since commit().
	void undo();

private:
	static constexpr std::size_t kStride = 31;

	/// A part as it was in the beginning: parts that lie over each other are not looked through together.
	struct Origin
	{
		std::vector<int> triangles;
		BoxTree tree; ///< of these
	};

	/// Triangles of one part that were moved alike.
	struct Group
	{
		int origin;          ///< -1: its triangles are in m_all
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

	void append(int triangle, int part);
	int remove(int triangle);
	void insertBehind(int before, int triangle, int part);

	template<class IsFound>
	bool coveredBy(const Triangle2& p, const Groups& groups, const IsFound& isFound) const
	{
		return groups.tree.meetsAny(boxOf(p), [&](int k) {
			const int group = groups.numbers[positionOf(k)];
			const int number = m_groups[group].origin;
			const Origin* origin = number >= 0 ? &m_origins[number] : nullptr;
			const BoxTree& tree = origin ? origin->tree : *m_all;
			return tree.meetsAny(boxOf(m_groups[group].back(p)), [&](int i) {
				const int g = origin ? origin->triangles[positionOf(i)] : i;
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
	const BoxTree* m_all; // of all triangles where they were in the beginning, or none
	double m_onePlace = 0.0, m_touching = 0.0;
	Array<Triangle2> m_plane; // [triangle] where it is
	Array<char> m_isProper;   // [triangle] counter-clockwise
	Array<int> m_part;        // [triangle]
	Array<int> m_group;       // [triangle]
	Array<Origin> m_origins;
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
