// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CHORD_ARRANGEMENT_H
#define RICCI_CHORD_ARRANGEMENT_H

#include "../base/graphs.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace ricci {

/// The faces into which two families of straight chords divide a convex polygon. No two chords of
/// one family cross, though they may share ends; a chord of the one crosses a chord of the other at
/// most once. All that is needed are the places where chords end: on the border, counted
/// counter-clockwise. Time and memory are in proportion to the places and crossings, except for the
/// logarithms of sorting; the arrays are kept from one polygon to the next.
///
///          4-----3          0 .. 5: places
///         / :   / \         0-3: line of a chord of the first family
///        /   : /   \        4-1: line of a chord of the second family
///       5     x     2       x: crossing number 0, node 6 (the number of places + 0)
///        \   / :   /
///         \ /   : /         Four faces. The side from x to 3 is forward along its line if the
///          0-----1          chord was given as {0, 3}; its segment is the second of the line.
///
/// A line consists of segments: crossings divide it, and each segment is a side of two faces.
class ChordArrangement
{
public:
	using Chord = std::array<int, 2>; ///< different places

	/// Chords that join the same two places are one line, in the direction of the first family's.
	struct Line
	{
		int from, to;
		std::array<int, 2> chord{-1, -1}; ///< [family] number as given to divide(), or -1
		bool secondReversed = false;      ///< the second family's chord runs from 'to' to 'from'
		int firstCrossing = 0, crossingCount = 0;
		int firstSegment = 0;
		int rankAtFrom = 0, rankAtTo = 0; ///< in linesAt()
	};

	/// A line of the first family meets one of the second.
	struct Crossing
	{
		int first, second;     ///< lines
		int onFirst, onSecond; ///< index along either, from its 'from'
	};

	/// A side of a face, which lies on its left.
	struct Side
	{
		int node; ///< where it begins: a place, or the number of places plus that of a crossing
		/// The place where a side of the border begins; else the number of places plus that of the
		/// line's segment, common to the two faces there.
		int name;
		int line; ///< -1: on the border
		bool forward;
	};

	/// Divides a polygon with \p places on its border by the chords of both families.
	/// \pre places >= 3; the chords of one family do not cross, and no two of them are one line
	void divide(int places, const std::vector<Chord>& first, const std::vector<Chord>& second)
	{
		m_places = places;
		makeLines(first, second);
		findCrossings();
		traceFaces();
	}

	int faceCount() const { return m_firstSide.size() - 1; }
	/// Sides of a face, counter-clockwise, are numbers firstSide(face) .. firstSide(face + 1) - 1.
	int firstSide(int face) const { return m_firstSide[face]; }
	const Side& side(int i) const { return m_sides[i]; }
	const Line& line(int i) const { return m_lines[i]; }
	const std::vector<Crossing>& crossings() const { return m_crossings.values(); }
	int segmentCount() const { return m_segments; }

	/// The lines that end at a place, counter-clockwise, beginning at the border's side that leaves
	/// it.
	ItemRange<const int> linesAt(int place) const
	{
		return {m_lineAt.data() + m_firstLineAt[place], m_lineAt.data() + m_firstLineAt[place + 1]};
	}

	/// Index of the side's line in linesAt() the place where it begins; -1 on the border.
	int rank(const Side& side) const
	{
		return side.line < 0  ? -1
			   : side.forward ? m_lines[side.line].rankAtFrom
							  : m_lines[side.line].rankAtTo;
	}

private:
	/// Places from one to another, counter-clockwise.
	int offset(int place, int from) const
	{
		return place >= from ? place - from : place - from + m_places;
	}

	static bool isFirst(const Line& line) { return line.chord[0] >= 0; }
	int farEnd(int line, int place) const
	{
		return m_lines[line].from == place ? m_lines[line].to : m_lines[line].from;
	}

	void makeLines(const std::vector<Chord>& first, const std::vector<Chord>& second)
	{
		m_lines.clear();
		const auto add = [&](const Chord& chord, std::size_t family, std::size_t index) {
			Line line;
			line.from = chord[0];
			line.to = chord[1];
			line.chord[family] = static_cast<int>(index);
			m_lines.push_back(line);
		};
		for (std::size_t i = 0; i < first.size(); ++i)
			add(first[i], 0, i);
		gatherLinesAtPlaces();
		for (std::size_t i = 0; i < second.size(); ++i) {
			const auto [from, to] = second[i];
			int same = -1;
			const ItemRange<const int> here = linesAt(from), there = linesAt(to);
			if (here.size() <= there.size()) {
				for (int line : here)
					same = farEnd(line, from) == to ? line : same;
			}
			else
				for (int line : there)
					same = farEnd(line, to) == from ? line : same;
			if (same < 0) {
				add(second[i], 1, i);
				continue;
			}
			m_lines[same].chord[1] = static_cast<int>(i);
			m_lines[same].secondReversed = m_lines[same].from != from;
		}
		if (!second.empty())
			gatherLinesAtPlaces();
	}

	void gatherLinesAtPlaces()
	{
		m_firstLineAt.assign(m_places + 1, 0);
		for (const Line& line : m_lines) {
			++m_firstLineAt[line.from + 1];
			++m_firstLineAt[line.to + 1];
		}
		std::partial_sum(m_firstLineAt.begin(), m_firstLineAt.end(), m_firstLineAt.begin());
		m_fill.values().assign(m_firstLineAt.begin(), m_firstLineAt.end());
		m_lineAt.resize(2 * m_lines.size());
		for (int i = 0; i < m_lines.size(); ++i)
			for (int place : {m_lines[i].from, m_lines[i].to})
				m_lineAt[m_fill[place]++] = i;
		for (int place = 0; place < m_places; ++place) {
			const int begin = m_firstLineAt[place], end = m_firstLineAt[place + 1];
			if (end - begin > 1)
				std::sort(m_lineAt.begin() + begin, m_lineAt.begin() + end, [&](int a, int b) {
					return offset(farEnd(a, place), place) < offset(farEnd(b, place), place);
				});
			for (int k = begin; k < end; ++k) {
				Line& line = m_lines[m_lineAt[k]];
				(line.from == place ? line.rankAtFrom : line.rankAtTo) = k - begin;
			}
		}
	}

	void findCrossings()
	{
		m_crossings.clear();
		// Next place, from each on, where a line of the second family alone ends.
		m_nextSecondEnd.assign(m_places + 1, m_places);
		for (int place = m_places - 1; place >= 0; --place) {
			m_nextSecondEnd[place] = m_nextSecondEnd[place + 1];
			for (int line : linesAt(place))
				if (!isFirst(m_lines[line]))
					m_nextSecondEnd[place] = place;
		}
		for (int i = 0; i < m_lines.size(); ++i) {
			m_lines[i].firstCrossing = m_crossings.size();
			m_lines[i].crossingCount = 0;
			if (isFirst(m_lines[i])) {
				findCrossingsOf(i);
				m_lines[i].crossingCount = m_crossings.size() - m_lines[i].firstCrossing;
			}
		}
		orderCrossingsOnSecond();
		m_segments = 0;
		for (Line& line : m_lines) {
			line.firstSegment = m_segments;
			m_segments += line.crossingCount + 1;
		}
	}

	/// Goes along the border on one side of a line of the first family and gathers the lines of the
	/// second that end there and on the other side. A line with both ends on the way encloses places
	/// from where no other line can leave: these are passed over.
	void findCrossingsOf(int index)
	{
		const Line& line = m_lines[index];
		const bool shorter = offset(line.to, line.from) <= offset(line.from, line.to);
		const int begin = shorter ? line.from : line.to, end = shorter ? line.to : line.from;
		const int span = offset(end, begin);
		const int firstFound = m_crossings.size();
		for (int reached = 1; reached < span;) {
			const int from =
				begin + reached < m_places ? begin + reached : begin + reached - m_places;
			int place = m_nextSecondEnd[from];
			if (place == m_places)
				place = m_nextSecondEnd[0];
			if (place == m_places)
				break;
			const int here = offset(place, begin);
			if (here < reached || here >= span) // beyond the line
				break;
			reached = here + 1;
			const int found = m_crossings.size();
			for (int other : linesAt(place)) {
				const int there = offset(farEnd(other, place), begin);
				if (isFirst(m_lines[other]) || there < here)
					continue;
				if (there > span)
					m_crossings.push_back({index, other, 0, 0});
				else
					reached = there;
			}
			// The lines of one place meet this one in the order opposite to that of the way.
			std::reverse(m_crossings.begin() + found, m_crossings.end());
		}
		const auto own = m_crossings.begin() + firstFound;
		if (!shorter)
			std::reverse(own, m_crossings.end());
		for (int k = firstFound; k < m_crossings.size(); ++k)
			m_crossings[k].onFirst = k - firstFound;
	}

	void orderCrossingsOnSecond()
	{
		for (const Crossing& x : m_crossings)
			++m_lines[x.second].crossingCount;
		int sum = 0;
		for (Line& line : m_lines)
			if (!isFirst(line)) {
				line.firstCrossing = sum;
				sum += line.crossingCount;
				line.crossingCount = 0;
			}
		m_onSecond.resize(m_crossings.size());
		for (int k = 0; k < m_crossings.size(); ++k) {
			Line& line = m_lines[m_crossings[k].second];
			m_onSecond[line.firstCrossing + line.crossingCount++] = k;
		}
		for (const Line& line : m_lines) {
			if (isFirst(line) || line.crossingCount == 0)
				continue;
			const int span = offset(line.to, line.from);
			// Ends of a crossing line, on either side of this one, as distances from its beginning.
			const auto ends = [&](int crossing) {
				const Line& other = m_lines[m_crossings[crossing].first];
				const int a = offset(other.from, line.from), b = offset(other.to, line.from);
				return a < span ? std::array<int, 2>{a, -b} : std::array<int, 2>{b, -a};
			};
			const auto begin = m_onSecond.begin() + line.firstCrossing;
			std::sort(
				begin, begin + line.crossingCount, [&](int a, int b) { return ends(a) < ends(b); });
			for (int k = 0; k < line.crossingCount; ++k)
				m_crossings[m_onSecond[line.firstCrossing + k]].onSecond = k;
		}
	}

	void traceFaces()
	{
		m_sides.clear();
		m_firstSide.assign(1, 0);
		const std::size_t places = positionOf(m_places);
		m_traced.assign(places + 2 * positionOf(m_segments), 0);
		const auto mark = [&](const Side& side) -> char& {
			if (side.line < 0)
				return m_traced[positionOf(side.name)];
			const std::size_t segment = positionOf(side.name - m_places);
			return m_traced[places + 2 * segment + (side.forward ? 0 : 1)];
		};
		const auto trace = [&](const Side& begin) {
			if (mark(begin))
				return;
			for (Side side = begin; !mark(side); side = after(side)) {
				mark(side) = 1;
				m_sides.push_back(side);
			}
			m_firstSide.push_back(m_sides.size());
		};
		for (int place = 0; place < m_places; ++place)
			trace({place, place, -1, true});
		for (int i = 0; i < m_lines.size(); ++i) {
			const Line& line = m_lines[i];
			for (int k = 0; k <= line.crossingCount; ++k) {
				const int name = m_places + line.firstSegment + k;
				const auto node = [&](int crossing) {
					return m_places + (isFirst(line) ? line.firstCrossing + crossing
													 : m_onSecond[line.firstCrossing + crossing]);
				};
				trace({k == 0 ? line.from : node(k - 1), name, i, true});
				trace({k == line.crossingCount ? line.to : node(k), name, i, false});
			}
		}
	}

	/// The next side of the same face: the leftmost turn.
	Side after(const Side& side) const
	{
		if (side.line < 0) {
			const int place = side.node + 1 == m_places ? 0 : side.node + 1;
			return leaving(place, linesAt(place).size() - 1);
		}
		const Line& line = m_lines[side.line];
		const int segment = side.name - m_places - line.firstSegment;
		const int crossing = side.forward ? segment : segment - 1; // at the side's end
		if (crossing < 0 || crossing == line.crossingCount)
			return side.forward ? leaving(line.to, line.rankAtTo - 1)
								: leaving(line.from, line.rankAtFrom - 1);
		const int number = isFirst(line) ? line.firstCrossing + crossing
										 : m_onSecond[line.firstCrossing + crossing];
		const Crossing& x = m_crossings[number];
		const int next = isFirst(line) ? x.second : x.first;
		const int index = isFirst(line) ? x.onSecond : x.onFirst;
		const Line& other = m_lines[next];
		// On the left are the places between where this line leads and where it comes from.
		const int to = side.forward ? line.to : line.from,
				  from = side.forward ? line.from : line.to;
		const bool forward = offset(other.to, to) < offset(from, to);
		return {
			m_places + number,
			m_places + other.firstSegment + (forward ? index + 1 : index),
			next,
			forward};
	}

	Side leaving(int place, int rank) const
	{
		if (rank < 0)
			return {place, place, -1, true};
		const int index = m_lineAt[m_firstLineAt[place] + rank];
		const Line& line = m_lines[index];
		const bool forward = line.from == place;
		const int segment = line.firstSegment + (forward ? 0 : line.crossingCount);
		return {place, m_places + segment, index, forward};
	}

	int m_places = 0, m_segments = 0;
	Array<Line> m_lines;         // of the first family, then of the second alone
	Array<int> m_firstLineAt;    // [place] into m_lineAt
	Array<int> m_lineAt;         // lines by place
	Array<int> m_fill;           // [place] end of what is filled of m_lineAt
	Array<int> m_nextSecondEnd;  // [place] next from there on where a line of the second alone ends
	Array<Crossing> m_crossings; // in order along the lines of the first family
	Array<int> m_onSecond;       // the same along those of the second
	Array<Side> m_sides;         // by face
	Array<int> m_firstSide;      // [face] into m_sides
	std::vector<char> m_traced;  // [side of the border, then two for each segment]
};

} // namespace ricci

#endif
