// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CHORD_ARRANGEMENT_H
#define RICCI_CHORD_ARRANGEMENT_H

#include "../base/graphs.h"

#include <array>
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
	struct Chord
	{
		int from, to; ///< different places
	};

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
	void divide(int places, const std::vector<Chord>& first, const std::vector<Chord>& second);

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

	void becomeOneFace();
	void makeLines(const std::vector<Chord>& first, const std::vector<Chord>& second);
	void gatherLinesAtPlaces();
	void findCrossings();
	void findCrossingsOf(int line);
	void orderCrossingsOnSecond();
	void traceFaces();
	Side after(const Side& side) const;
	Side leaving(int place, int rank) const;

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
